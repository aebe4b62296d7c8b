#pragma once

#include "pointfront/Store/Hierarchy.h"
#include "pointfront/Store/StoredCloud.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace pointfront
{

/// The node tables of several clouds, one behind the other, as one. Pages of each stay on its disk.
/// Roots    of all clouds, in their order.
/// Numbers  the points of a cloud follow those of the clouds before it.
/// Heads    where roots have many points and there are many of them, a root is cut in two: its
///          first points, a fair subset (NodeColumns), are the root, the others its only child. A
///          tile that is small on screen is in memory with its head alone.
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

  /// All that have nodes of one refinement; together, with a node more for each root, less than
  /// noNode nodes. Roots with twice `headPoints` points and more are cut, those of Refinement::Add.
  explicit TileTable(
    std::vector<Tile> tiles, std::uint32_t headPoints = std::numeric_limits<std::uint32_t>::max());
  ~TileTable() override;

  enum class Cut : std::uint8_t
  {
    Whole,
    Head, ///< the first headPoints() points of a root
    Body ///< the others
  };
  /// A node of one of the clouds.
  struct TileNode
  {
    std::size_t tile = 0;
    NodeIndex node = noNode; ///< in that cloud's own table
    Cut cut = Cut::Whole;
  };
  TileNode tileNodeOf(NodeIndex node) const;
  /// The first node behind those of a cloud.
  NodeIndex nodesBehind(std::size_t tile) const { return firstNodes_[tile + 1]; }
  /// The row of that node, as it stands in its cloud, as it stands in this table.
  Node shifted(const TileNode& at, Node row) const;
  std::uint32_t headPoints() const { return headPoints_; }
  NodeIndex headCount() const { return headCount_; }

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
  /// Ascending: roots that are cut.
  using CutRoots = std::vector<NodeIndex>;

  CutRoots rootsToCut(const Hierarchy& table) const;
  /// Number of a cloud's own node that is whole, or the head of it.
  NodeIndex indexOf(std::size_t tile, NodeIndex own) const;
  NodeIndex bodyIndexOf(std::size_t tile, NodeIndex own) const; ///< its own index if it is whole
  Node unshifted(const TileNode& at, Node row) const;
  RowState asked(RowState state) const; ///< the same; readers are told of a row that is coming

  std::vector<Tile> tiles_;
  std::vector<CutRoots> cut_; ///< by tile
  std::uint32_t headPoints_;
  NodeIndex headCount_ = 0;
  std::vector<NodeIndex> firstNodes_; ///< first node of each tile; the last entry is behind all
  std::vector<std::uint64_t> firstPoints_;
  std::vector<NodeIndex> roots_;
  Refinement refinement_ = Refinement::Add;
  std::unique_ptr<Rows> rows_; ///< null where all rows of all tiles are in memory
};

} // namespace pointfront
