#pragma once

#include "pointfront/Store/StoredCloud.h"
#include "pointfront/Tiles/ListedTable.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace pointfront
{

/// Tiles of which a list tells box and number of points (VPC, STAC) as one cloud. Opening it opens
/// a few of them; the others are opened when somebody looks into their boxes.
/// Points     those of all tiles, in the columns and on the grid of those that are open first
///            (ListedTiles); positions of others are rounded where they lie on another grid.
/// Layers     their numbers of nodes are not known, and are 0.
/// Damage     a tile that is missing, or is not what the list says, is a fault of the hierarchy:
///            pictures go on without it, queries that need it give the error.
/// Threads    all functions are safe from any thread.
class ListedCloud final : public StoredCloud
{
public:
  /// `path` is that of the list. Tiles with several trees are opened all at once (TiledCloud).
  /// Errors  those of ListedTiles, ListedTable and TiledCloud.
  static Result<std::shared_ptr<const StoredCloud>> open(
    const std::string& path, std::vector<ListedTile> tiles, std::vector<std::string> warnings);

  const ListedTiles& tiles() const { return *tiles_; }

  const StoreDescription& description() const override { return tiles_->whole(); }
  const std::shared_ptr<const Hierarchy>& hierarchy() const override { return hierarchy_; }
  std::vector<std::string> files() const override;
  Result<FetchedNode> fetch(NodeIndex node, const ColumnSelection& columns) const override;
  std::vector<Result<FetchedNode>> fetchAll(
    const std::vector<WantedNode>& wanted, const ReadStop& stop) const override;
  Result<NodeColumns> decode(const FetchedNode& fetched) const override;
  std::size_t decodedBytes(
    NodeIndex node, std::uint32_t points, const ColumnSelection& columns) const override;
  std::size_t storedBytes(NodeIndex node, const ColumnSelection& columns) const override;
  std::uint64_t disk() const override { return like_->disk(); }
  ReadCost readCost() const override { return like_->readCost(); }
  MissingRows* missingRows() const override { return table_->missingRows(); }
  /// Opens and verifies all tiles, one after the other.
  Result<VerifyReport> verify(const ProgressFunction& progress = {}) const override;

private:
  ListedCloud() = default;

  std::shared_ptr<const ListedTiles> tiles_;
  std::shared_ptr<const ListedTable> table_;
  std::shared_ptr<const Hierarchy> hierarchy_; ///< the same
  const StoredCloud* like_ = nullptr; ///< a tile that is open, a far one if there is one
};

} // namespace pointfront
