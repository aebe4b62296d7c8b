#pragma once

#include "pointfront/Store/GridBounds.h"
#include "pointfront/Store/StoredCloud.h"
#include "pointfront/Tiles/CollectedTile.h"
#include "pointfront/Tiles/TileDescription.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// A node of the tree of heads: some tiles' points, or one root of a tile, which has none here.
struct HeadNode
{
  std::optional<std::pair<std::uint32_t, std::uint32_t>> root; ///< tile and which of its roots
  GridBounds bounds; ///< bounds and ranges of the points, not of a root
  std::vector<ColumnRange> ranges;
};

/// A change of the set of tiles, as it is undone.
struct CollectionChange
{
  std::string what; ///< "add 3 tiles"
  std::vector<std::uint32_t> added; ///< ids
  std::vector<TileName> removed;
};

/// A tree of heads has one layer of the whole, and the tiles of one epoch.
struct HeadTreeKey
{
  std::uint16_t layer = 0;
  std::string epoch; ///< "": the tiles that have none

  friend bool operator<(const HeadTreeKey& a, const HeadTreeKey& b)
  {
    return a.epoch != b.epoch ? a.epoch < b.epoch : a.layer < b.layer;
  }
};

/// All that a collection's file holds besides the heads' points.
/// Format  docs/formats/pfcollection.md
struct CollectionRecord
{
  std::uint64_t state = 0; ///< grows by one with each change
  std::uint32_t nextId = 1;
  StoreDescription whole; ///< all tiles together; its path is empty
  std::vector<StoreDescription> kinds; ///< facts that tiles share: schema, system, layers ...
  std::vector<CollectedTile> tiles;
  std::vector<HeadNode> heads; ///< in the order of the node table
  std::vector<CollectionChange> history; ///< oldest first, since the last compact

  /// A description as that of the open tile, with `path`.
  StoreDescription description(std::size_t tile, const std::string& path) const;
  /// Number in the whole of a layer of a tile. The whole lacks it: as many as the whole has.
  std::uint16_t layerOf(const CollectedTile& tile, std::uint16_t own) const;
  /// The tree that a root of a tile hangs in.
  HeadTreeKey treeOf(const CollectedTile& tile, std::size_t root) const;
  /// The tiles, all or those of one epoch, by their kinds, in the order in which tiles have them
  /// first. `places` gets the place of each kind; behind all where no tile has it.
  std::vector<AlikeTiles> alikeTiles(
    const std::optional<std::string>& epoch, std::vector<std::size_t>& places) const;
  /// Those of all tiles, ascending; "" where some tiles have none.
  std::vector<std::string> epochs() const;
  /// Whether the collection at `path` may name its tiles as it does, and those that it had, since a
  /// change may be taken back. Errors  those of fileNamedBy() and refuseSettings().
  Result<void> checkAddresses(const std::string& path) const;

  std::vector<std::byte> encode() const;
  /// Nothing: the bytes contradict themselves, or each other. A record of a newer version gives a
  /// record without tiles and its version.
  static std::optional<CollectionRecord> decode(const std::byte* data, std::size_t size);
  std::uint32_t version = newest;
  static constexpr std::uint32_t newest = 2; ///< 2: trees of epochs; they are written as 2 only
};

/// The column of the heads' store, behind those of the whole, with the id of each point's tile.
constexpr const char* tileColumn = "pointfront:tile";

} // namespace pointfront
