#pragma once

#include "pointfront/Store/Hierarchy.h"
#include "pointfront/Tiles/CollectionTiles.h"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace pointfront
{

class CollectionRows;

/// The tree of heads and, below it, the tables of all tiles, as one.
/// Nodes    first those of the tree of heads: groups of tiles, whose points are some of the first
///          points of those tiles' roots, and for each root of a tile a leaf, which stands for the
///          root's other points. Then the nodes of each tile but its roots. All rows of the first
///          kind are in memory; those of a tile come once it is open.
/// Numbers  points are numbered in that order.
/// Tiles    are opened by who reads missing rows, when somebody looks below a tile's root.
class CollectionTable final : public Hierarchy
{
public:
  /// A node of the table in what it is a part of.
  struct TileNode
  {
    std::size_t tile = 0;
    NodeIndex node = noNode; ///< in the tile's own table
    std::uint32_t head = 0; ///< so many of its first points are in groups
  };

  /// `heads` is the table of the heads' store, of as many nodes as the record has. With an `epoch`
  /// the roots are those of its tiles alone; nodes keep their numbers.
  /// Errors  Corrupt: the tree of heads contradicts itself or the record; NoMemory: 2^32 nodes and
  ///         more; NotFound: no tile has that epoch; Unsupported: an older version put several
  ///         epochs into one tree.
  static Result<std::shared_ptr<const CollectionTable>> make(const std::string& path,
    const Hierarchy& heads, std::shared_ptr<const CollectionTiles> tiles,
    const std::optional<std::string>& epoch);
  ~CollectionTable() override;

  /// Nothing: a group, which has the same number in the heads' store.
  std::optional<TileNode> tileNodeOf(NodeIndex node) const;
  /// The row of a tile's node as it stands in this table.
  Node shifted(const TileNode& at, Node row) const;
  NodeIndex headCount() const { return static_cast<NodeIndex>(rows_.size()); }
  /// The first node behind those of a tile, without its roots.
  NodeIndex nodesBehind(std::size_t tile) const { return firstNodes_[tile + 1]; }
  std::size_t tileOf(NodeIndex node) const; ///< the tile of a node behind the heads

  NodeIndex nodeCount() const override { return firstNodes_.back(); }
  Node node(NodeIndex index) const override;
  const std::vector<NodeIndex>& roots() const override { return roots_; }
  Refinement refinement() const override { return Refinement::Add; }
  Node childOf(NodeIndex parent, const Node& row, std::uint8_t child) const override;
  RowState peek(NodeIndex index, Node& row) const override;
  RowState peekChild(
    NodeIndex parent, const Node& row, std::uint8_t child, Node& found) const override;
  std::pair<NodeIndex, NodeIndex> nodesAround(std::uint64_t point) const override;
  MissingRows* missingRows() const override;
  std::uint64_t arrivals() const override;
  using Hierarchy::waitForArrival;
  bool waitForArrival(std::uint64_t seen, std::chrono::steady_clock::time_point end) const override;
  std::optional<Error> fault() const override;
  std::vector<Error> takeFaults() const override;

  /// The tile, opened now if it is closed. A failure is the table's fault, too.
  Result<const CollectionTiles::Tile*> openTile(std::size_t tile) const;

private:
  explicit CollectionTable(std::shared_ptr<const CollectionTiles> tiles);
  std::string takeHeads(const Hierarchy& heads);
  std::string nameTrees();
  Result<void> chooseRoots(const std::string& path, const std::string& epoch);
  std::string joinRoots();
  Result<void> number(const std::string& path);
  const CollectedTile& known(std::size_t tile) const { return tiles_->record().tiles[tile]; }
  NodeIndex indexOf(std::size_t tile, NodeIndex own) const;
  Node parentOf(NodeIndex firstChild, const Node& child) const;
  const Node& leafOfLayer(std::size_t tile, std::uint16_t layer) const;

  std::shared_ptr<const CollectionTiles> tiles_;
  std::vector<Node> rows_; ///< rows of the tree of heads, as they stand in this table
  std::vector<std::vector<NodeIndex>> leaves_; ///< by tile and root
  std::vector<NodeIndex> firstNodes_; ///< by tile; the last entry is behind all
  std::vector<std::uint64_t> firstPoints_; ///< by tile; the last entry is behind all
  std::vector<NodeIndex> roots_;
  std::vector<std::string> epochs_; ///< by root
  bool mixesEpochs_ = false; ///< some tree has tiles of several epochs
  std::unique_ptr<CollectionRows> missing_;
};

} // namespace pointfront
