#pragma once

#include "pointfront/Points/AttributeSchema.h"
#include "pointfront/Points/QuantisationGrid.h"
#include "pointfront/Store/NodeReader.h"

#include <cstddef>
#include <cstdint>
#include <unordered_set>
#include <vector>

namespace pointfront
{

/// Points of heads while a collection is written: on the grid of the whole, with all its columns
/// and behind them the id of each point's tile.
/// Order  every prefix of a tile's points is a fair subset of them.
class HeadPoints
{
public:
  /// All points of a node with all columns of the whole, of one tile.
  static HeadPoints of(const NodeColumns& node, const AttributeSchema& whole, std::uint32_t tile);
  /// A node with the tiles' column behind those.
  static HeadPoints of(const NodeColumns& node, const AttributeSchema& whole);

  std::size_t size() const { return positions_.size(); }
  void append(const HeadPoints& other, std::size_t begin, std::size_t end);
  void append(const HeadPoints& other) { append(other, 0, other.size()); }
  /// Those of the tiles, or those of all others.
  HeadPoints ofTiles(const std::unordered_set<std::uint32_t>& tiles, bool others) const;
  /// Those behind the first `count`.
  HeadPoints behind(std::size_t count) const;

  /// In an order of which every prefix is a fair subset; wider than 32 bits of steps: false.
  bool asNode(const AttributeSchema& heads, NodeColumns& node) const;

private:
  struct Column
  {
    std::size_t bytes = 0; ///< size of one point
    std::vector<std::byte> values;
  };
  std::vector<GridPosition> positions_;
  std::vector<Column> columns_; ///< those of the whole
  std::vector<std::uint32_t> tiles_;
};

} // namespace pointfront
