#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Points/PointSource.h"
#include "pointfront/Points/QuantisationGrid.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

struct GridChoice
{
  QuantisationGrid grid;
  GridPosition low{ 0 }; ///< of the declared extent, in steps; a hint
  GridPosition high{ 0 };
  std::vector<std::string> warnings; ///< which source is rounded, by how much at most
};

/// The one grid of a store (FRONT-1: one uniform coordinate system, one defined precision).
/// Lossless   when all sources lie on the grid of the finest of them: same scale or whole
///            multiples, offsets apart by whole steps. The first such offset is taken.
/// Rounded    otherwise, to at most half a step of the finest scale, with a warning.
/// `precision` world units a step on every axis, > 0 and finite; BadArgument otherwise.
/// Sources without a grid (floating point) and without `precision` get a millionth of the power of
/// ten below their declared extent: 0.1 mm for 100 m; a millimetre if the extent is not known.
/// Heights that extend farther than the plane may be of another unit: the plane then has a step by
/// its own extent. Where a few points lie a thousand times farther away than nine tenths of the
/// others reach (some chunks are read for that), the finest decimal step is taken that holds all;
/// if it does not tell those others apart, that is BadArgument: nothing collapses without being
/// asked.
Result<GridChoice> chooseGrid(
  const std::vector<std::unique_ptr<PointSource>>& sources, const std::optional<double>& precision);

} // namespace pointfront
