#include "pointfront/Tiles/ListedCloud.h"

#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Store/ColumnStatistics.h"
#include "pointfront/Tiles/TiledCloud.h"
#include "pointfront/Tiles/TileFetch.h"

#include <optional>
#include <utility>

namespace pointfront
{

Result<std::shared_ptr<const StoredCloud>> ListedCloud::open(
  const std::string& path, std::vector<ListedTile> tiles, std::vector<std::string> warnings)
{
  const std::vector<ListedTile> told = tiles;
  std::vector<std::string> addresses;
  for (const ListedTile& tile : told)
  {
    addresses.push_back(tile.address);
  }
  Result<std::shared_ptr<const ListedTiles>> listed =
    ListedTiles::make(path, std::move(tiles), warnings);
  if (!listed && listed.error().kind == Error::Kind::Unsupported)
  {
    return TiledCloud::open(path, addresses, std::move(warnings),
      [&told](std::size_t tile, const StoreDescription& own) { return told[tile].compare(own); });
  }
  if (!listed)
  {
    return listed.error();
  }
  std::shared_ptr<ListedCloud> cloud(new ListedCloud);
  cloud->tiles_ = std::move(*listed);
  Result<std::shared_ptr<const ListedTable>> table = ListedTable::make(cloud->tiles_);
  if (!table)
  {
    return table.error();
  }
  cloud->table_ = std::move(*table);
  cloud->hierarchy_ = cloud->table_;
  for (std::size_t t = 0; t < cloud->tiles_->size(); ++t)
  {
    const ListedTiles::Tile* const open = cloud->tiles_->opened(t);
    if (open != nullptr &&
      (cloud->like_ == nullptr ||
        (open->cloud->readCost().far() && !cloud->like_->readCost().far())))
    {
      cloud->like_ = open->cloud.get();
    }
  }
  if (cloud->like_ == nullptr)
  {
    return makeError(Error::Kind::Unreadable, path + ": none of its tiles is what it says");
  }
  return std::shared_ptr<const StoredCloud>(std::move(cloud));
}

std::vector<std::string> ListedCloud::files() const
{
  std::vector<std::string> all{ description().path };
  for (std::size_t t = 0; t < tiles_->size(); ++t)
  {
    all.push_back(publicForm(tiles_->listed(t).address));
  }
  return all;
}

std::size_t ListedCloud::decodedBytes(
  NodeIndex, std::uint32_t points, const ColumnSelection& columns) const
{
  return decodedBytesOf(points, columns, description().schema);
}

std::size_t ListedCloud::storedBytes(NodeIndex node, const ColumnSelection& columns) const
{
  const ListedTable::TileNode at = table_->tileNodeOf(node);
  const ListedTiles::Tile* const open = tiles_->opened(at.tile);
  return at.node == noNode || open == nullptr
    ? 0
    : open->cloud->storedBytes(at.node, open->part.columns.own(columns));
}

Result<FetchedNode> ListedCloud::fetch(NodeIndex node, const ColumnSelection& columns) const
{
  const ReadStop never{ false };
  return std::move(fetchAll({ { node, columns } }, never).front());
}

std::vector<Result<FetchedNode>> ListedCloud::fetchAll(
  const std::vector<WantedNode>& wanted, const ReadStop& stop) const
{
  std::vector<Result<FetchedNode>> results;
  std::vector<WantedOfTile> inner;
  std::vector<std::size_t> places;
  for (const WantedNode& want : wanted)
  {
    const ListedTable::TileNode at = table_->tileNodeOf(want.node);
    results.emplace_back(FetchedNode{ want.node, want.columns, {}, 0, {} });
    if (at.node == noNode)
    {
      results.back()->row = table_->node(want.node);
      continue;
    }
    const Result<const ListedTiles::Tile*> open = table_->openTile(at.tile);
    if (!open)
    {
      results.back() = open.error();
      continue;
    }
    const StoredCloud& tile = *(*open)->cloud;
    inner.push_back({ &tile, { at.node, (*open)->part.columns.own(want.columns) } });
    places.push_back(results.size() - 1);
  }
  std::vector<Result<FetchedNode>> fetched = fetchTiles(inner, stop);
  for (std::size_t i = 0; i < fetched.size(); ++i)
  {
    Result<FetchedNode>& result = results[places[i]];
    if (!fetched[i])
    {
      result = fetched[i].error();
      continue;
    }
    result->bytesRead = fetched[i]->bytesRead;
    result->row = table_->shifted(table_->tileNodeOf(result->node), fetched[i]->row);
    result->inner = std::make_shared<const FetchedNode>(std::move(*fetched[i]));
  }
  return results;
}

Result<NodeColumns> ListedCloud::decode(const FetchedNode& fetched) const
{
  const AttributeSchema& schema = description().schema;
  if (!fetched.inner)
  {
    NodeColumns empty = emptyColumns(fetched.node, 0, fetched.columns, schema);
    empty.describe(fetched.row);
    return empty;
  }
  const std::size_t tile = table_->tileNodeOf(fetched.node).tile;
  const ListedTiles::Tile& open = *tiles_->opened(tile);
  Result<NodeColumns> result = open.cloud->decode(*fetched.inner);
  if (!result)
  {
    return result;
  }
  result->node = fetched.node;
  result->describe(fetched.row);
  open.part.columns.adapt(*result, fetched.columns, schema);
  if (Result<void> placed = open.part.placing.place(*result, open.cloud->description().path);
      !placed)
  {
    return placed.error();
  }
  return result;
}

Result<VerifyReport> ListedCloud::verify(const ProgressFunction& progress) const
{
  VerifyReport all;
  for (std::size_t t = 0; t < tiles_->size() && all.ok; ++t)
  {
    const Result<const ListedTiles::Tile*> open = table_->openTile(t);
    if (!open)
    {
      all.ok = false;
      all.firstError = open.error().what;
      break;
    }
    const Result<VerifyReport> own = (*open)->cloud->verify(progress);
    if (!own)
    {
      return own;
    }
    all.nodesChecked += own->nodesChecked;
    all.pointsChecked += own->pointsChecked;
    all.ok = own->ok;
    all.firstError = own->firstError;
  }
  return all;
}

} // namespace pointfront
