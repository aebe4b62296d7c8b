#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Codec/ByteStream.h"
#include "pointfront/Store/StoredCloud.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pointfront
{

/// The parts of a tile that must not change: its size, its first 64 KiB and its last 256 KiB. In a
/// store these hold the description, the footer and the checksums of (the last 1,200 nodes')
/// blocks.
struct TileIdentity
{
  std::uint64_t bytes = 0;
  std::uint32_t head = 0; ///< checksums
  std::uint32_t tail = 0;

  /// Errors  those of ByteSource.
  static Result<TileIdentity> of(const std::string& path);
  friend bool operator==(const TileIdentity& a, const TileIdentity& b)
  {
    return a.bytes == b.bytes && a.head == b.head && a.tail == b.tail;
  }
};

/// A root of a tile's own table, which the collection knows without the tile.
struct TileRoot
{
  NodeIndex node = noNode; ///< in the tile's table
  Node row; ///< the same there
  std::uint32_t head = 0; ///< its first points, which the collection holds
};

/// How a tile is found again, and what users call it.
struct TileName
{
  std::uint32_t id = 0; ///< this tile's alone, in all states
  std::string address; ///< relative to the collection's folder, absolute, or "https://..."
  std::string name; ///< unique in a state
  std::string epoch; ///< a date or a name; may be empty
  TileIdentity identity;

  void put(ByteWriter& out) const;
  static TileName take(ByteReader& in);
};

/// All that is known of a tile while it is closed.
struct CollectedTile
{
  TileName is;
  std::uint32_t kind = 0; ///< index of a description that it shares with others
  QuantisationGrid grid;
  Bounds bounds;
  std::uint64_t pointCount = 0;
  std::uint64_t wholeCount = 0;
  std::uint64_t fileBytes = 0;
  std::uint32_t levels = 0;
  NodeIndex nodes = 0;
  std::uint64_t ownPoints = 0; ///< own points of all its nodes
  std::vector<std::array<double, 2>> ranges; ///< each component of each column, as stored
  std::vector<std::pair<std::uint64_t, std::uint32_t>> layers; ///< points and nodes of each
  std::vector<TileRoot> roots; ///< ascending

  void put(ByteWriter& out) const;
  static CollectedTile take(ByteReader& in);
  /// False: it contradicts itself, or the kind of it.
  bool isSound(const std::vector<StoreDescription>& kinds) const;
};

/// A count of things that take `least` bytes each; 0, and the reader is not ok(), if so many are
/// not there.
std::size_t takeCount(ByteReader& in, std::size_t least);
void putBounds(ByteWriter& out, const Bounds& bounds);
Bounds takeBounds(ByteReader& in);

double diagonalOf(const Bounds& bounds);

/// Stores that differ in no more than counts, bounds, ranges and grids, described as one: counts
/// added up, bounds and ranges of all of them. Its path is that of the first.
struct AlikeTiles
{
  StoreDescription together;
  std::size_t count = 0;
  double lengths = 0.0; ///< diagonals of their boxes, added up

  void begin(const StoreDescription& first);
  void add(const CollectedTile& tile); ///< one of the same kind
};

} // namespace pointfront
