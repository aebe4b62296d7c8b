#pragma once

#include "pointfront/Store/NodeRanges.h"

#include <memory>
#include <vector>

namespace pointfront
{

/// Puts the ranges of tables, one behind the other, together as those of one table.
/// Marks    all that the tables have if they are 256 at most; else 256 of them with equally many
/// values between, and
///          ranges are rounded outwards to those.
class TileRanges
{
public:
  void add(const ValueRange& own, const ValueRange& below)
  {
    own_.push_back(own);
    below_.push_back(below);
  }
  /// A node of which nothing is known.
  void addUnknown();

  std::shared_ptr<const NodeRanges> together() const;

private:
  std::vector<ValueRange> own_;
  std::vector<ValueRange> below_;
};

} // namespace pointfront
