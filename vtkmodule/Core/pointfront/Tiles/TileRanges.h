#pragma once

#include "pointfront/Points/AttributeSchema.h"
#include "pointfront/Store/NodeRanges.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace pointfront
{

/// Which component of which column of the whole; of coordinates the axis alone.
struct WholeComponent
{
  std::uint32_t column = 0;
  std::uint32_t component = 0;
  const Attribute* attribute = nullptr; ///< null: a coordinate

  static WholeComponent of(std::uint32_t number, const AttributeSchema& schema);
};

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
