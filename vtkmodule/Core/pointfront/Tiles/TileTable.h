#pragma once

#include "pointfront/Store/Hierarchy.h"
#include "pointfront/Store/StoredCloud.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace pointfront
{

/// The node tables of several clouds, one behind the other, as one. Pages of each stay on its disk.
/// Roots    of all clouds, in their order.
/// Ranks    the points of a cloud follow those of the clouds before it.
/// Cost     finding the cloud of a node: the logarithm of their number.
class TileTable final : public Hierarchy
{
public:
  /// A cloud and which layers of the common list its own are.
  struct Tile
  {
    std::shared_ptr<const Hierarchy> table;
    std::vector<std::uint16_t> layers;
    std::uint64_t points = 0; ///< own points of all its nodes
  };

  /// All of one refinement; together less than noNode nodes.
  explicit TileTable(std::vector<Tile> tiles);
  ~TileTable() override;

  /// A node of one of the clouds.
  struct Place
  {
    std::size_t tile = 0;
    NodeIndex node = noNode; ///< in that cloud's own table
  };
  Place placeOf(NodeIndex node) const;
  /// A row of that cloud as it stands in this table.
  Node shifted(std::size_t tile, Node row) const;

  NodeIndex nodeCount() const override { return firstNodes_.back(); }
  Node node(NodeIndex index) const override;
  const std::vector<NodeIndex>& roots() const override { return roots_; }
  Refinement refinement() const override { return refinement_; }
  Node childOf(NodeIndex parent, const Node& row, std::uint8_t child) const override;
  RowState peek(NodeIndex index, Node& row) const override;
  RowState peekChild(
    NodeIndex parent, const Node& row, std::uint8_t child, Node& found) const override;
  MissingRows* missingRows() const override;
  std::uint64_t arrivals() const override;
  using Hierarchy::waitForArrival;
  bool waitForArrival(std::uint64_t seen, std::chrono::steady_clock::time_point end) const override;
  std::optional<Error> fault() const override;
  std::vector<Error> takeFaults() const override;

private:
  class Rows;
  Node unshifted(std::size_t tile, Node row) const;

  std::vector<Tile> tiles_;
  std::vector<NodeIndex> firstNodes_; ///< of each tile; the last entry is behind all
  std::vector<std::uint64_t> firstPoints_;
  std::vector<NodeIndex> roots_;
  Refinement refinement_ = Refinement::Add;
  std::unique_ptr<Rows> rows_; ///< null where all rows of all tiles are in memory
};

} // namespace pointfront
