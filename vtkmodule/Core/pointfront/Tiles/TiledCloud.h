#pragma once

#include "pointfront/Store/StoredCloud.h"
#include "pointfront/Tiles/TileDescription.h"
#include "pointfront/Tiles/TileTable.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>
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
/// Heads       of roots (TileTable), where there are many tiles: all of them from afar take as much
///             memory as `overviewPoints` points do, each tile 256 at least. What is behind a head
///             is read with it and decoded once more when it is drawn.
/// Limits      a file descriptor a tile: the process's soft limit is raised as far as it may be.
/// Threads     all functions are safe from any thread.
class TiledCloud final : public StoredCloud
{
public:
  static constexpr std::uint64_t defaultOverviewPoints = std::uint64_t(1) << 21;
  using Tiles = std::vector<std::shared_ptr<const StoredCloud>>;

  /// `path` names the whole: the list or the folder.
  /// Errors  BadArgument: no tile; tiles with subsets beside tiles with representatives; columns
  ///         of one name with different numbers of components; NoMemory: 2^32 nodes and more.
  static Result<std::shared_ptr<const StoredCloud>> make(const std::string& path, Tiles tiles,
    std::vector<std::string> warnings = {}, std::uint64_t overviewPoints = defaultOverviewPoints);
  /// Refuses the tile of that number among the files, or does not.
  using TileCheck = std::function<Result<void>(std::size_t tile, const StoreDescription& own)>;
  /// Opens them all, in parallel. Errors: those that cannot be opened or that the check refuses,
  /// the first three by name.
  static Result<std::shared_ptr<const StoredCloud>> open(const std::string& path,
    const std::vector<std::string>& files, std::vector<std::string> warnings = {},
    const TileCheck& check = {});

  const StoreDescription& description() const override { return described_.whole; }
  const std::shared_ptr<const Hierarchy>& hierarchy() const override { return hierarchy_; }
  std::vector<std::string> files() const override;
  Result<FetchedNode> fetch(NodeIndex node, const ColumnSelection& columns) const override;
  /// The wanted nodes of each tile together.
  std::vector<Result<FetchedNode>> fetchAll(
    const std::vector<WantedNode>& wanted, const ReadStop& stop) const override;
  Result<NodeColumns> decode(const FetchedNode& fetched) const override;
  std::size_t decodedBytes(
    NodeIndex node, std::uint32_t points, const ColumnSelection& columns) const override;
  std::size_t storedBytes(NodeIndex node, const ColumnSelection& columns) const override;
  /// That of the first far tile, if there is one.
  std::uint64_t disk() const override { return costliest().disk(); }
  ReadCost readCost() const override { return costliest().readCost(); }
  /// Ranges over all tiles, in common values. Nodes of a tile that knows none may have any value.
  Result<std::shared_ptr<const NodeRanges>> nodeRanges(
    std::uint32_t component, NodeIndex most = noNode) const override;
  MissingRows* missingRows() const override { return table_->missingRows(); }
  /// Verifies all tiles, one after the other.
  Result<VerifyReport> verify(const ProgressFunction& progress = {}) const override;

private:
  TiledCloud(Tiles tiles, TileDescription described)
    : tiles_(std::move(tiles))
    , described_(std::move(described))
  {
  }
  Result<void> makeTable(std::uint64_t overviewPoints);
  const StoredCloud& costliest() const { return *tiles_[costliest_]; }
  Result<FetchedNode> wrapped(
    NodeIndex node, const ColumnSelection& columns, Result<FetchedNode> inner) const;

  Tiles tiles_;
  std::size_t costliest_ = 0;
  TileDescription described_;
  std::shared_ptr<const TileTable> table_;
  std::shared_ptr<const Hierarchy> hierarchy_; ///< the same
};

} // namespace pointfront
