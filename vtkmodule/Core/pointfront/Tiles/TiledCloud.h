#pragma once

#include "pointfront/Ingest/CommonSchema.h"
#include "pointfront/Store/StoredCloud.h"
#include "pointfront/Tiles/TileTable.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// Several stored clouds as one: the tiles of a survey. Nothing is copied; all of them stay open.
/// Attributes  of all tiles, by the rule of a build (CommonSchema): one name is one column, of the
///             smallest type that holds all; points of a tile that lacks it have zeros there.
/// Grid        of the finest tile; where another one does not lie on it, its positions are rounded,
///             by half a step at most.
/// Layers      of all tiles, in the order of their classes; one tree for each tile and layer.
/// Differences are in description().warnings: attributes, grids, systems, and how many tiles.
/// Limits      a file descriptor a tile: the process's soft limit is raised as far as it may be.
/// Threads     all functions are safe from any thread.
class TiledCloud final : public StoredCloud
{
public:
  using Tiles = std::vector<std::shared_ptr<const StoredCloud>>;

  /// `path` names the whole: the list or the folder.
  /// Errors  BadArgument: no tile; tiles with subsets beside tiles with representatives; columns
  ///         of one name with different numbers of components; NoMemory: 2^32 nodes and more.
  static Result<std::shared_ptr<const StoredCloud>> make(
    const std::string& path, Tiles tiles, std::vector<std::string> warnings = {});
  /// Opens them all, in parallel. Errors: those that cannot be opened, the first three by name.
  static Result<std::shared_ptr<const StoredCloud>> open(const std::string& path,
    const std::vector<std::string>& files, std::vector<std::string> warnings = {});

  const StoreDescription& description() const override { return description_; }
  const std::shared_ptr<const Hierarchy>& hierarchy() const override { return hierarchy_; }
  std::vector<std::string> files() const override;
  Result<FetchedNode> fetch(NodeIndex node, const ColumnSelection& columns) const override;
  Result<NodeColumns> decode(const FetchedNode& fetched) const override;
  std::size_t decodedBytes(
    NodeIndex node, std::uint32_t points, const ColumnSelection& columns) const override;
  std::size_t storedBytes(NodeIndex node, const ColumnSelection& columns) const override;
  std::uint64_t disk() const override { return tiles_.front().cloud->disk(); }
  MissingRows* missingRows() const override { return table_->missingRows(); }
  /// Of all tiles, one after the other.
  Result<VerifyReport> verify(const ProgressFunction& progress = {}) const override;

private:
  struct Tile
  {
    std::shared_ptr<const StoredCloud> cloud;
    std::vector<ColumnMapping> columns; ///< by common column
    /// Nothing: positions are rounded to the common grid. Else common = steps * ratio + shift.
    struct Placing
    {
      GridPosition ratio{ 1 };
      GridPosition shift{ 0 };
    };
    std::optional<Placing> placing;
    std::optional<std::array<std::byte, 256>> radii; ///< codes, where their base is another one
  };

  TiledCloud() = default;
  Result<void> describe(const std::string& path, std::vector<std::string> warnings);
  Result<void> chooseColumns();
  void chooseGrid();
  void addRanges(const Tile& tile);
  void compareSystems();
  Result<void> makeTable();
  /// Its own numbers of those of the common columns that it has.
  static ColumnSelection ownColumns(const Tile& tile, const ColumnSelection& columns);
  Result<void> place(const Tile& tile, NodeColumns& node) const;

  std::vector<Tile> tiles_;
  StoreDescription description_;
  std::shared_ptr<const TileTable> table_;
  std::shared_ptr<const Hierarchy> hierarchy_; ///< the same
};

} // namespace pointfront
