#pragma once

#include "pointfront/Points/QuantisationGrid.h"
#include "pointfront/Store/NodeRanges.h"
#include "pointfront/Store/NodeReader.h"

#include <string>
#include <vector>

namespace pointfront
{

/// How the grid steps of one tile become steps of the grid that all tiles are shown on.
/// Exact    where every step of the tile is one of the common grid; else positions are rounded, by
///          half a common step at most.
/// Threads  const functions from any thread.
class TilePlacing
{
public:
  /// That of the finest step along each axis.
  static QuantisationGrid commonGrid(const std::vector<QuantisationGrid>& grids);

  TilePlacing(const QuantisationGrid& own, const QuantisationGrid& common);

  bool exact() const { return exact_; }
  /// Positions of a node of the tile, in place.
  /// Errors  Unsupported with `path`: wider than 32 bits of common steps.
  Result<void> place(NodeColumns& node, const std::string& path) const;
  /// Steps along one axis, as common ones.
  ValueRange placed(const ValueRange& steps, int axis) const;

private:
  GridPosition placed(const GridPosition& step) const;

  QuantisationGrid own_;
  QuantisationGrid common_;
  bool exact_ = true;
  GridPosition ratio_{ 1 }; ///< where exact: common = own * ratio + shift
  GridPosition shift_{ 0 };
};

} // namespace pointfront
