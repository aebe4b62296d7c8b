#pragma once

#include "pointfront/Base/Progress.h"
#include "pointfront/Collection/TileIntake.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pointfront
{

struct CollectionOptions
{
  /// Points of all heads together, about.
  std::uint64_t overviewPoints = std::uint64_t(1) << 21;
  /// Besides equal texts; none: no others are the same.
  SameSystem sameSystem = {};
  ProgressFunction progress = {};
};

/// The outcome of a change.
struct CollectionReport
{
  std::uint64_t state = 0;
  std::uint64_t tiles = 0;
  std::uint64_t points = 0;
  std::uint64_t added = 0;
  std::uint64_t removed = 0;
  std::uint64_t headPoints = 0;
  std::uint64_t bytesWritten = 0;
  std::vector<std::string> warnings; ///< about the tiles together
};

// Each change writes the next state beside the collection's file and gives it its name: whoever has
// the file open keeps the state that it opened, and a process that dies or a full disk leaves the
// state before.
// Errors  those of openTiles() and checkSystems(); Unwritable: the disk, or another process is
//         changing the collection; NotFound: no tile of that name; BadArgument: a name twice, no
//         tile left, nothing to undo; Cancelled.
// Threads a crew of their own; one change at a time.

// Links  a change follows a symbolic link to a collection. A file counts once: BadArgument where it
//         is a tile already, or is named twice, by whatever path.

/// A collection of tiles. What is at `path` is replaced.
Result<CollectionReport> createCollection(
  const std::string& path, const std::vector<TileRequest>& tiles, const CollectionOptions& options);
Result<CollectionReport> addTiles(
  const std::string& path, const std::vector<TileRequest>& tiles, const CollectionOptions& options);
/// Each in place of the tile that it names, else of that of its path, else of that of its name,
/// whose epoch it keeps unless it has one.
Result<CollectionReport> replaceTiles(
  const std::string& path, const std::vector<TileRequest>& tiles, const CollectionOptions& options);
/// By their names or their addresses.
Result<CollectionReport> removeTiles(
  const std::string& path, const std::vector<std::string>& names, const CollectionOptions& options);
/// The tiles of the state before the last change, with the files that they were made of.
Result<CollectionReport> undoCollection(const std::string& path, const CollectionOptions& options);
/// The same tiles with heads and attributes as if it were created now, and without a history.
Result<CollectionReport> compactCollection(
  const std::string& path, const CollectionOptions& options);

} // namespace pointfront
