#pragma once

#include "pointfront/Disk/Epoch.h"
#include "pointfront/Store/PointStore.h"
#include "pointfront/Store/StoredCloud.h"
#include "pointfront/Tiles/CollectionTable.h"
#include "pointfront/Tiles/EpochColumn.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pointfront
{

/// A collection of tiles (`.pfcollection`) as one cloud: one state of it, which stays what it is
/// while somebody has it open. The format: docs/formats/pfcollection.md.
/// Opening     reads the collection's file alone. A tile is opened when somebody reads more of it
///             than its head; until then it may be missing.
/// Points      those of all tiles, each once, in the columns and on the grid of the whole
///             (TiledCloud has the rules), and one that is computed, of epochs (EpochColumn).
/// Ranges      of nodes: those of groups, and of tiles as a whole. Nodes inside a tile may have any
///             value.
/// Errors      open: those of PointStore; Unsupported: a newer version; NotFound: no such epoch. Of
///             a tile: CollectionTiles.
/// Threads     all functions are safe from any thread.
class CollectionCloud final : public StoredCloud
{
public:
  /// `path` may name an epoch (EpochAddress): then the cloud's points are those of its tiles, with
  /// the numbers that they have among all. Ranges stay those of all tiles, so that colours by a
  /// range mean the same in each epoch, and so do attributes: those that none of its tiles has are
  /// computed, as zeros.
  static Result<std::shared_ptr<const CollectionCloud>> open(const std::string& path);
  /// The record in a collection's open file.
  static Result<CollectionRecord> recordOf(const PointStore& heads);

  const CollectionRecord& record() const { return tiles_->record(); }
  const CollectionTiles& tiles() const { return *tiles_; }
  /// Places in the record of the tiles that the cloud is made of: all, or the epoch's.
  std::vector<std::size_t> tileNumbers() const;

  const StoreDescription& description() const override { return description_; }
  const std::shared_ptr<const Hierarchy>& hierarchy() const override { return hierarchy_; }
  std::vector<std::string> files() const override;
  Result<FetchedNode> fetch(NodeIndex node, const ColumnSelection& columns) const override;
  std::vector<Result<FetchedNode>> fetchAll(
    const std::vector<WantedNode>& wanted, const ReadStop& stop) const override;
  Result<NodeColumns> decode(const FetchedNode& fetched) const override;
  std::size_t decodedBytes(
    NodeIndex node, std::uint32_t points, const ColumnSelection& columns) const override;
  /// An estimate where the node is a closed tile's.
  std::size_t storedBytes(NodeIndex node, const ColumnSelection& columns) const override;
  std::uint64_t disk() const override { return heads_->disk(); }
  /// That of the collection's file, or a guess where its tiles are farther away.
  ReadCost readCost() const override;
  Result<std::shared_ptr<const NodeRanges>> nodeRanges(
    std::uint32_t component, NodeIndex most = noNode) const override;
  MissingRows* missingRows() const override { return table_->missingRows(); }
  /// Verifies the collection's own file.
  Result<VerifyReport> verifyHeads(const ProgressFunction& progress = {}) const
  {
    return heads_->verify(progress);
  }
  /// Verifies the heads and the cloud's tiles.
  Result<VerifyReport> verify(const ProgressFunction& progress = {}) const override;

private:
  CollectionCloud() = default;
  Result<FetchedNode> wrapped(
    NodeIndex node, const ColumnSelection& columns, Result<FetchedNode> inner) const;
  std::vector<Result<FetchedNode>> fetchOf(const StoredCloud& cloud,
    const std::vector<WantedNode>& own, const std::vector<WantedNode>& wanted,
    const ReadStop& stop) const;
  ColumnSelection stored(const ColumnSelection& columns) const;
  ValueRange rangeOf(std::size_t tile, std::uint32_t component) const;
  std::shared_ptr<const NodeRanges> epochRanges(NodeIndex most) const;

  std::shared_ptr<const PointStore> heads_;
  std::shared_ptr<const CollectionTiles> tiles_;
  std::vector<TileColumns> columns_; ///< by kind
  std::shared_ptr<const CollectionTable> table_;
  std::shared_ptr<const Hierarchy> hierarchy_; ///< the same
  std::optional<EpochColumn> epochs_;
  std::optional<std::string> epoch_; ///< the path names it
  StoreDescription description_;
  bool farTiles_ = false;
};

/// Opens collections.
class CollectionFormat final : public StoredCloudFormat
{
public:
  std::string name() const override { return "collection"; }
  bool accepts(const std::string& path) const override
  {
    return PointStore::looksLikeCollection(EpochAddress::of(path).file);
  }
  Result<std::shared_ptr<const StoredCloud>> open(const std::string& path) const override;
};

} // namespace pointfront
