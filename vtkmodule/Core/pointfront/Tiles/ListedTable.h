#pragma once

#include "pointfront/Store/Hierarchy.h"
#include "pointfront/Tiles/ListedTiles.h"
#include "pointfront/Tiles/WantedParts.h"

#include <memory>
#include <utility>
#include <vector>

namespace pointfront
{

/// The node tables of listed tiles, one behind the other, as one. A tile that was closed when the
/// table was made has a root without points, the box of which the list knows; below it is the
/// tile's own root, whose row comes when the tile is open.
/// Numbers   each tile has more numbers of nodes than it needs (ListedTiles::mostNodes). A number
///           that no node has is a hollow row.
/// Tiles     are opened by who reads missing rows, several at a time.
/// Threads   all functions are safe from any thread.
class ListedTable final : public Hierarchy
{
public:
  /// Errors  NoMemory: more nodes than 32 bits count.
  static Result<std::shared_ptr<const ListedTable>> make(std::shared_ptr<const ListedTiles> tiles);
  ~ListedTable() override;

  /// A node in its tile.
  struct TileNode
  {
    std::size_t tile = 0;
    NodeIndex node = noNode; ///< in the tile's own table; noNode: the box of a tile
  };
  TileNode tileNodeOf(NodeIndex node) const;
  /// The row of that node, as it stands in its tile, as it stands in this table.
  Node shifted(const TileNode& at, Node row) const;
  /// The tile, opened now if it is closed. A failure is a fault of this table.
  Result<const ListedTiles::Tile*> openTile(std::size_t tile) const;

  NodeIndex nodeCount() const override { return firstNodes_.back(); }
  Node node(NodeIndex index) const override;
  const std::vector<NodeIndex>& roots() const override { return roots_; }
  Refinement refinement() const override { return tiles_->whole().refinement; }
  Node childOf(NodeIndex parent, const Node& row, std::uint8_t child) const override;
  RowState peek(NodeIndex index, Node& row) const override;
  RowState peekChild(
    NodeIndex parent, const Node& row, std::uint8_t child, Node& found) const override;
  /// Those of one tile, so that the others need not be opened.
  std::pair<NodeIndex, NodeIndex> nodesAround(std::uint64_t point) const override;
  MissingRows* missingRows() const override;
  std::uint64_t arrivals() const override;
  using Hierarchy::waitForArrival;
  bool waitForArrival(std::uint64_t seen, std::chrono::steady_clock::time_point end) const override;
  std::optional<Error> fault() const override;
  std::vector<Error> takeFaults() const override;

private:
  explicit ListedTable(std::shared_ptr<const ListedTiles> tiles);
  std::size_t readTiles(
    const std::vector<std::size_t>& tiles, const WantedParts::Ended& ended) const;
  Node boxOf(std::size_t tile) const;
  /// Number of a tile's own node in this table.
  NodeIndex indexOf(std::size_t tile, NodeIndex own) const
  {
    return firstNodes_[tile] + (closed_[tile] ? 1 : 0) + own;
  }
  Node unshifted(const TileNode& at, Node row) const;
  Node hollow(std::size_t tile) const;

  std::shared_ptr<const ListedTiles> tiles_;
  std::vector<bool> closed_; ///< when this was made, by tile
  std::vector<NodeIndex> firstNodes_; ///< by tile; the last entry is behind all
  std::vector<std::uint64_t> firstPoints_; ///< by tile; the last entry is behind all
  std::vector<NodeIndex> roots_;
  std::unique_ptr<WantedParts> wanted_; ///< tiles: to be opened, or to read more of their tables
};

} // namespace pointfront
