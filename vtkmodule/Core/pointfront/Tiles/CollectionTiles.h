#pragma once

#include "pointfront/Tiles/CollectionRecord.h"
#include "pointfront/Tiles/TileDescription.h"

#include <memory>
#include <string>

namespace pointfront
{

/// The tiles of a collection, each opened when somebody needs more of it than its head, and open
/// from then on.
/// Errors   of open(): those of the tile's kind; Unreadable: it is not the file that the collection
///          was made of. A tile that failed is not tried again.
/// Threads  all functions from any thread.
class CollectionTiles
{
public:
  /// An open tile, and how it becomes a part of the whole.
  struct Tile
  {
    std::shared_ptr<const StoredCloud> cloud;
    TileDescription::Part part;
  };

  /// `path` is that of the collection.
  CollectionTiles(std::string path, std::shared_ptr<const CollectionRecord> record);
  ~CollectionTiles();

  const CollectionRecord& record() const { return *record_; }
  /// Path or address of a tile.
  std::string addressOf(std::size_t tile) const;
  /// Makes a description of the whole that of the tiles of one epoch: counts, bounds, layers, the
  /// kind of GPS times, and what differs among them. Columns and ranges stay those of all tiles;
  /// columns that no tile of the epoch has become computed ones.
  /// Errors  those of TileDescription::of().
  Result<void> describeEpoch(const std::string& epoch, StoreDescription& whole) const;

  /// May wait for the disk.
  Result<const Tile*> open(std::size_t tile) const;
  /// Null: it is closed.
  const Tile* opened(std::size_t tile) const;
  bool failed(std::size_t tile) const;

private:
  struct Slot;
  Result<std::unique_ptr<const Tile>> openNow(std::size_t tile) const;
  std::string rowsFault(std::size_t tile, const StoredCloud& cloud) const;

  std::string path_;
  std::shared_ptr<const CollectionRecord> record_;
  std::unique_ptr<Slot[]> slots_;
};

} // namespace pointfront
