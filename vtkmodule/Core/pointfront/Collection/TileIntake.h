#pragma once

#include "pointfront/Base/Progress.h"
#include "pointfront/Collection/HeadTree.h"
#include "pointfront/Tiles/CollectionRecord.h"
#include "pointfront/Tiles/TileDescription.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// A tile that a collection is to take in.
struct TileRequest
{
  std::string path; ///< path or address of a store, an index, COPC or EPT
  std::string name = {}; ///< empty: the file's name without its extension, or with its address
  std::string epoch = {};
  std::uint32_t id = 0; ///< 0: a new one
  std::optional<TileIdentity> identity = std::nullopt; ///< which it must have
  std::string address = {}; ///< how the collection names it; empty: by its path
};

/// An open tile on its way into a collection.
struct IncomingTile
{
  TileName is; ///< its address is relative to the collection's folder where that is possible
  std::shared_ptr<const StoredCloud> cloud;
  bool named = false; ///< the request has the name

  /// The facts that a collection keeps of it. `kinds` gets its kind unless it has it; layers are
  /// the tile's own.
  CollectedTile facts(std::vector<StoreDescription>& kinds) const;
};

/// Open tiles, and those that have no points.
struct OpenedTiles
{
  std::vector<IncomingTile> tiles;
  std::vector<std::string> empty; ///< their paths, which are in no tile of the collection

  /// A sentence about those without points; "": there are none.
  std::string warning() const;
};

/// How a collection names a path: relative to its folder; an address without what is secret in it.
std::string relativeAddress(const std::string& collection, const std::string& path);
/// The name of a tile by its file: "a/north_17.copc.laz" is "north_17".
std::string tileNameOf(const std::string& path);

/// Two texts that name the same coordinate reference system.
using SameSystem = std::function<bool(const std::string&, const std::string&)>;

/// Whether a collection's file can name what is to be taken in, for all who will read it.
/// Errors  BadArgument: an address with a user, a password, a query or settings, which
///         this process alone knows.
Result<void> checkAddresses(
  const std::string& collection, const std::vector<TileRequest>& requests);

/// Opens tiles beside each other.
/// Errors  those that cannot be opened, the first three by name; BadArgument: a collection, a
///         preview, a tile with representatives, and tiles of which none has points.
Result<OpenedTiles> openTiles(const std::string& collection,
  const std::vector<TileRequest>& requests, const ProgressFunction& progress);

/// Errors  BadArgument: tiles that name different systems, with two of them. `known` is the system
///         that they must have; empty: any.
Result<void> checkSystems(const std::string& collection, const std::vector<IncomingTile>& tiles,
  const std::string& known, const SameSystem& same);

/// How many points the collection takes of a tile.
struct HeadSizes
{
  std::uint32_t ofTile = 2048; ///< its share of the overview
};

/// Reads the heads of the roots of a tile: their first points, at most half of them.
/// Errors  those of reading its roots.
Result<std::vector<TileHead>> readHeads(const IncomingTile& tile,
  const std::vector<TileRoot>& roots, const TileDescription::Part& part,
  const AttributeSchema& whole);

/// Sets how many points of each root are its head.
void chooseHeads(CollectedTile& tile, const HeadSizes& sizes);

} // namespace pointfront
