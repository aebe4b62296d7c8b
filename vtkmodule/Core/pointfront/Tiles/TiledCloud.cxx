#include "pointfront/Tiles/TiledCloud.h"

#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Disk/StopOfReads.h"
#include "pointfront/Store/ColumnStatistics.h"
#include "pointfront/Store/StoreFormat.h"
#include "pointfront/Threads/ThreadCrew.h"
#include "pointfront/Threads/WaitingWork.h"
#include "pointfront/Tiles/StoredCloudFormats.h"
#include "pointfront/Tiles/TileFetch.h"
#include "pointfront/Tiles/TileRanges.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace pointfront
{
namespace
{
/// Tiles that are opened beside each other if some are behind addresses.
constexpr std::size_t openingsAtOnce = 16;
} // namespace

Result<std::shared_ptr<const StoredCloud>> TiledCloud::open(const std::string& path,
  const std::vector<std::string>& files, std::vector<std::string> warnings, const TileCheck& check)
{
  raiseOpenFiles(files.size());
  std::vector<Result<std::shared_ptr<const StoredCloud>>> opened(
    files.size(), makeError(Error::Kind::NotFound, ""));
  const std::function<bool()> stopped = StopOfReads::carry();
  const auto open = [&](std::size_t i)
  {
    const StopOfReads stop(stopped);
    opened[i] = StoredCloudFormats::ofProcess().openWhole(files[i]);
    const Result<void> right =
      opened[i] && check ? check(i, (*opened[i])->description()) : Result<void>();
    if (!right)
    {
      opened[i] = right.error();
    }
  };
  if (std::any_of(files.begin(), files.end(), [](const auto& file) { return isAddress(file); }))
  {
    runWaiting(files.size(), openingsAtOnce, open); // they wait for servers
  }
  else
  {
    ThreadCrew::ofProcess().run(files.size(), [&](std::size_t i, unsigned) { open(i); });
  }
  constexpr std::size_t mostNamed = 3;
  std::string faults;
  std::size_t faulty = 0;
  const Error* first = nullptr;
  Tiles tiles;
  for (auto& tile : opened)
  {
    if (tile)
    {
      tiles.push_back(std::move(*tile));
      continue;
    }
    first = first == nullptr ? &tile.error() : first;
    faults += ++faulty > mostNamed ? "" : (faults.empty() ? "" : "; ") + tile.error().what;
  }
  if (faulty > 0)
  {
    return makeError(first->kind,
      path + ": " + std::to_string(faulty) + " of " + std::to_string(files.size()) +
        " stores cannot be opened: " + faults + (faulty > mostNamed ? "; and others" : ""));
  }
  return make(path, std::move(tiles), std::move(warnings));
}

Result<std::shared_ptr<const StoredCloud>> TiledCloud::make(const std::string& path, Tiles tiles,
  std::vector<std::string> warnings, std::uint64_t overviewPoints)
{
  if (tiles.empty())
  {
    return makeError(Error::Kind::BadArgument, path + ": names no store");
  }
  std::vector<const StoreDescription*> descriptions;
  for (const auto& tile : tiles)
  {
    descriptions.push_back(&tile->description());
  }
  Result<TileDescription> described =
    TileDescription::ofStores(path, descriptions, std::move(warnings));
  if (!described)
  {
    return described.error();
  }
  std::shared_ptr<TiledCloud> cloud(new TiledCloud(std::move(tiles), std::move(described.value())));
  const auto far = std::find_if(cloud->tiles_.begin(), cloud->tiles_.end(),
    [](const auto& tile) { return tile->readCost().far(); });
  cloud->costliest_ =
    far != cloud->tiles_.end() ? static_cast<std::size_t>(far - cloud->tiles_.begin()) : 0;
  if (Result<void> done = cloud->makeTable(overviewPoints); !done)
  {
    return done.error();
  }
  return std::shared_ptr<const StoredCloud>(std::move(cloud));
}

Result<void> TiledCloud::makeTable(std::uint64_t overviewPoints)
{
  constexpr std::uint64_t fewest = 256;
  std::uint64_t nodes = 0;
  std::uint64_t roots = 0;
  std::vector<TileTable::Tile> tables;
  for (std::size_t t = 0; t < tiles_.size(); ++t)
  {
    const std::shared_ptr<const Hierarchy>& table = tiles_[t]->hierarchy();
    nodes += table->nodeCount() + table->roots().size();
    roots += table->roots().size();
    TileTable::Tile row{ table, described_.parts[t].layers, 0 };
    if (const NodeIndex count = table->nodeCount(); count > 0)
    {
      const Node last = table->node(count - 1);
      row.points = last.firstPoint + last.pointCount;
    }
    if (const std::optional<Error> fault = table->fault())
    {
      return *fault;
    }
    tables.push_back(std::move(row));
  }
  if (nodes >= noNode)
  {
    return makeError(Error::Kind::NoMemory,
      described_.whole.path + ": its stores have " + std::to_string(nodes) +
        " nodes together, more than 32 bits count; open fewer of them");
  }
  const std::uint64_t each = std::max(fewest, overviewPoints / std::max<std::uint64_t>(roots, 1));
  table_ = std::make_shared<const TileTable>(
    std::move(tables), static_cast<std::uint32_t>(std::min<std::uint64_t>(each, maxNodePoints)));
  described_.whole.levels += table_->headCount() > 0 ? 1 : 0;
  hierarchy_ = table_;
  return {};
}

std::vector<std::string> TiledCloud::files() const
{
  std::vector<std::string> all{ described_.whole.path };
  for (const auto& tile : tiles_)
  {
    const std::vector<std::string> own = tile->files();
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

std::size_t TiledCloud::decodedBytes(
  NodeIndex, std::uint32_t points, const ColumnSelection& columns) const
{
  return decodedBytesOf(points, columns, described_.whole.schema);
}

std::size_t TiledCloud::storedBytes(NodeIndex node, const ColumnSelection& columns) const
{
  const TileTable::TileNode at = table_->tileNodeOf(node);
  return tiles_[at.tile]->storedBytes(at.node, described_.parts[at.tile].columns.own(columns));
}

Result<FetchedNode> TiledCloud::fetch(NodeIndex node, const ColumnSelection& columns) const
{
  const TileTable::TileNode at = table_->tileNodeOf(node);
  return wrapped(
    node, columns, tiles_[at.tile]->fetch(at.node, described_.parts[at.tile].columns.own(columns)));
}

Result<FetchedNode> TiledCloud::wrapped(
  NodeIndex node, const ColumnSelection& columns, Result<FetchedNode> inner) const
{
  if (!inner)
  {
    return inner;
  }
  const TileTable::TileNode at = table_->tileNodeOf(node);
  FetchedNode fetched{ node, columns, {}, inner->bytesRead, table_->shifted(at, inner->row) };
  fetched.inner = std::make_shared<const FetchedNode>(std::move(*inner));
  return fetched;
}

std::vector<Result<FetchedNode>> TiledCloud::fetchAll(
  const std::vector<WantedNode>& wanted, const ReadStop& stop) const
{
  std::vector<WantedOfTile> inner;
  for (const WantedNode& want : wanted)
  {
    const TileTable::TileNode at = table_->tileNodeOf(want.node);
    inner.push_back(
      { tiles_[at.tile].get(), { at.node, described_.parts[at.tile].columns.own(want.columns) } });
  }
  std::vector<Result<FetchedNode>> results = fetchTiles(inner, stop);
  for (std::size_t i = 0; i < results.size(); ++i)
  {
    results[i] = wrapped(wanted[i].node, wanted[i].columns, std::move(results[i]));
  }
  return results;
}

Result<NodeColumns> TiledCloud::decode(const FetchedNode& fetched) const
{
  const TileTable::TileNode at = table_->tileNodeOf(fetched.node);
  const StoredCloud& tile = *tiles_[at.tile];
  const TileDescription::Part& part = described_.parts[at.tile];
  Result<NodeColumns> inner = tile.decode(*fetched.inner);
  if (!inner)
  {
    return inner;
  }
  NodeColumns result = std::move(*inner);
  if (at.cut != TileTable::Cut::Whole)
  {
    const std::size_t head = std::min<std::size_t>(table_->headPoints(), result.size());
    result = at.cut == TileTable::Cut::Head
      ? sliced(result, 0, head, tile.description().schema)
      : sliced(result, head, result.size(), tile.description().schema);
  }
  result.node = fetched.node;
  result.describe(fetched.row);
  part.columns.adapt(result, fetched.columns, described_.whole.schema);
  if (Result<void> placed = part.placing.place(result, tile.description().path); !placed)
  {
    return placed.error();
  }
  return result;
}

Result<std::shared_ptr<const NodeRanges>> TiledCloud::nodeRanges(
  std::uint32_t component, NodeIndex most) const
{
  const auto wanted = WholeComponent::of(component, described_.whole.schema);
  TileRanges all;
  bool known = false;
  const NodeIndex nodes = std::min(most, table_->nodeCount());
  for (NodeIndex first = 0; first < nodes;)
  {
    const std::size_t t = table_->tileNodeOf(first).tile;
    const NodeIndex end = std::min(nodes, table_->nodesBehind(t));
    const TileDescription::Part& part = described_.parts[t];
    const std::optional<std::uint32_t> own = wanted.attribute == nullptr
      ? component
      : part.columns.ownComponent(wanted.column, wanted.component);
    std::shared_ptr<const NodeRanges> ranges;
    if (own)
    {
      auto read = tiles_[t]->nodeRanges(*own, table_->tileNodeOf(end - 1).node + 1);
      if (!read)
      {
        return read.error();
      }
      ranges = std::move(*read);
    }
    known = known || ranges || !own;
    const auto adapted = [&](const ValueRange& range)
    {
      return wanted.attribute == nullptr
        ? part.placing.placed(range, static_cast<int>(component))
        : part.columns.adapted(range, wanted.column, *wanted.attribute);
    };
    for (; first < end; ++first)
    {
      const NodeIndex node = table_->tileNodeOf(first).node;
      if (!own)
      {
        all.add({ 0.0, 0.0 }, { 0.0, 0.0 }); // a column that the tile lacks
      }
      else if (ranges && node < ranges->nodeCount())
      {
        all.add(adapted(ranges->own(node)), adapted(ranges->below(node)));
      }
      else
      {
        all.addUnknown();
      }
    }
  }
  return known ? all.together() : std::shared_ptr<const NodeRanges>();
}

Result<VerifyReport> TiledCloud::verify(const ProgressFunction& progress) const
{
  VerifyReport all;
  for (const auto& tile : tiles_)
  {
    const Result<VerifyReport> own = tile->verify(progress);
    if (!own)
    {
      return own;
    }
    all.nodesChecked += own->nodesChecked;
    all.pointsChecked += own->pointsChecked;
    if (!own->ok)
    {
      all.ok = false;
      all.firstError = own->firstError;
      return all;
    }
  }
  return all;
}

} // namespace pointfront
