#pragma once

#include "pointfront/Points/AttributeSchema.h"
#include "pointfront/Store/Hierarchy.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace pointfront
{

/// The range of a node's values: as stored, before scale and offset; for coordinates, grid steps.
struct ValueRange
{
  double low = 0.0;
  double high = 0.0;

  bool empty() const { return low > high; } ///< no value, or NaN only
};

/// Ranges of one component of one column (or of one coordinate) in the first nodes of a table.
/// Guarantees  own() contains every value of a node's own points, below() every value of the node
///             and all nodes below it; both may be wider.
/// Size        4 bytes a node.
/// Threads     const functions from any thread.
class NodeRanges
{
public:
  /// One code is the number of a mark: low and high mark of the own points, then of all below.
  using Codes = std::array<std::uint8_t, 4>;

  NodeRanges(NodeIndex nodes, std::vector<double> marks, std::vector<Codes> codes)
    : nodes_(nodes)
    , marks_(std::move(marks))
    , codes_(std::move(codes))
  {
  }

  /// Number of nodes with known ranges.
  NodeIndex nodeCount() const { return nodes_; }
  ValueRange own(NodeIndex node) const { return range(node, 0); }
  ValueRange below(NodeIndex node) const { return range(node, 2); }

private:
  ValueRange range(NodeIndex node, std::size_t first) const
  {
    if (codes_.empty())
    {
      return marks_.empty() ? ValueRange{ 1.0, 0.0 } : ValueRange{ marks_.front(), marks_.back() };
    }
    const Codes& codes = codes_[node];
    if (codes[first] > codes[first + 1])
    {
      return { 1.0, 0.0 };
    }
    return { marks_[codes[first]], marks_[codes[first + 1]] };
  }

  NodeIndex nodes_;
  std::vector<double> marks_; ///< ascending
  std::vector<Codes> codes_; ///< empty: all nodes have all marks
};

/// Which component a range is of: coordinates come first, then the components of all columns in
/// their order.
constexpr std::uint32_t coordinateComponents = 3;
inline std::uint32_t rangeComponents(const AttributeSchema& schema)
{
  std::uint32_t count = coordinateComponents;
  for (const Attribute& attribute : schema)
  {
    count += attribute.components;
  }
  return count;
}
inline std::uint32_t rangeComponent(
  const AttributeSchema& schema, std::uint32_t column, std::uint32_t component)
{
  std::uint32_t number = coordinateComponents + component;
  for (std::uint32_t c = 0; c < column; ++c)
  {
    number += schema[c].components;
  }
  return number;
}

} // namespace pointfront
