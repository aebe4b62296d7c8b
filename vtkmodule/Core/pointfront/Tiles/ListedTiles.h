#pragma once

#include "pointfront/Tiles/TileDescription.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// The facts that a list tells about a tile, so that it need not be opened to be left out of a
/// view.
struct ListedTile
{
  std::string address; ///< path or address
  Bounds bounds; ///< box of all its points, world
  std::uint64_t points = 0;
  std::string system; ///< its coordinate reference system in the words of the list, if it says any
  std::string kind; ///< tiles of one kind have the same attributes

  /// A point beside `bounds` by so little is in them: lists round.
  glm::dvec3 rounding() const;
  /// Whether an opened file has the points and the box that the list tells. Errors  Unreadable.
  Result<void> compare(const StoreDescription& own) const;
  Error unlike(const std::string& what) const;
};

/// The tiles of a list that tells where they lie. Some are opened with the list, one of each kind
/// at least, for what the list does not tell: attributes, grid, ranges. The others are taken to be
/// like them, and opened when somebody needs their points; then they are compared with the list.
/// Errors   of open(tile): those of the tile's kind; NotFound, if nothing is there any more;
///          Unreadable: it is not what the list says. A tile that failed is not tried again; one
///          that was Cancelled is.
/// Threads  all functions from any thread.
class ListedTiles
{
public:
  /// An open tile, and how it becomes a part of the whole.
  struct Tile
  {
    std::shared_ptr<const StoredCloud> cloud;
    TileDescription::Part part;
  };

  /// So many are opened at the same time if they are behind addresses.
  static constexpr std::size_t openingsAtOnce = 16;

  /// `path` is that of the list.
  /// Errors  BadArgument: no tile; those of a tile, if none of its kind can be opened; Unsupported:
  ///         a tile has trees of classes, and each must be opened to know which.
  static Result<std::shared_ptr<const ListedTiles>> make(
    const std::string& path, std::vector<ListedTile> tiles, std::vector<std::string> warnings);
  ~ListedTiles();

  const StoreDescription& whole() const { return whole_; }
  std::size_t size() const { return tiles_.size(); }
  const ListedTile& listed(std::size_t tile) const { return tiles_[tile]; }
  /// Most nodes that a tile may have. More than there are in a tile of that many points.
  NodeIndex mostNodes(std::size_t tile) const;

  /// May wait for the disk or the server.
  Result<const Tile*> open(std::size_t tile) const;
  /// Null: it is closed.
  const Tile* opened(std::size_t tile) const;
  bool failed(std::size_t tile) const;

private:
  struct Slot;
  ListedTiles(std::string path, std::vector<ListedTile> tiles);
  using Kinds = std::map<std::string, std::vector<std::size_t>>; ///< tiles by kind
  std::vector<std::size_t> chosen(const Kinds& kinds) const;
  Result<void> openFirst(std::vector<std::string> warnings);
  Result<void> refuseFaults(const std::vector<std::size_t>& first);
  std::vector<StoreDescription> likeFirst(const std::vector<std::size_t>& first) const;
  void compareSystems();
  Result<void> describe(const std::vector<std::size_t>& first, std::vector<std::string> warnings);
  Result<std::shared_ptr<const StoredCloud>> openCloud(std::size_t tile) const;
  Result<TileDescription::Part> partOf(std::size_t tile, const StoredCloud& cloud) const;

  std::string path_;
  std::vector<ListedTile> tiles_;
  StoreDescription whole_;
  std::unique_ptr<Slot[]> slots_;
};

} // namespace pointfront
