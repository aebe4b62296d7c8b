#include "pointfront/Tiles/CollectionCloud.h"

#include "pointfront/Base/FileNames.h"
#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Store/ColumnStatistics.h"
#include "pointfront/Store/StoreFormat.h"
#include "pointfront/Tiles/TileFetch.h"
#include "pointfront/Tiles/TileRanges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace pointfront
{
namespace
{
/// The cost of a server that nobody has asked yet.
constexpr ReadCost farGuess{ 0.05, 0.0, 8, 0 };

ValueRange anyValue()
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return { -infinity, infinity };
}

ValueRange both(const ValueRange& a, const ValueRange& b)
{
  return a.empty() ? b
    : b.empty()    ? a
                   : ValueRange{ std::min(a.low, b.low), std::max(a.high, b.high) };
}
} // namespace

Result<CollectionRecord> CollectionCloud::recordOf(const PointStore& heads)
{
  const std::string& path = heads.description().path;
  const MetadataRecord* const bytes = collectionRecordIn(heads.description().metadata);
  std::optional<CollectionRecord> record = bytes == nullptr
    ? std::nullopt
    : CollectionRecord::decode(bytes->payload.data(), bytes->payload.size());
  if (!record)
  {
    return makeError(Error::Kind::Corrupt,
      "'" + path +
        "' is damaged: its list of tiles contradicts itself; copy the file again or "
        "create it again");
  }
  if (record->version > CollectionRecord::newest)
  {
    return makeError(Error::Kind::Unsupported,
      "'" + path + "' is a collection of version " + std::to_string(record->version) +
        ", this program reads up to version " + std::to_string(CollectionRecord::newest) +
        "; update PointFront");
  }
  const AttributeSchema& schema = heads.description().schema;
  bool same = schema.size() == record->whole.schema.size() + 1 &&
    schema[schema.size() - 1].name == tileColumn && schema[schema.size() - 1].bytes() == 4;
  for (std::size_t c = 0; c + 1 < schema.size() && same; ++c)
  {
    same = schema[c] == record->whole.schema[c];
  }
  if (!same || record->whole.refinement != Refinement::Add)
  {
    return makeError(Error::Kind::Corrupt,
      "'" + path +
        "' is damaged: its heads and its list of tiles have other attributes; copy the "
        "file again or create it again");
  }
  if (Result<void> sound = record->checkAddresses(path); !sound)
  {
    return sound.error();
  }
  return std::move(*record);
}

Result<std::shared_ptr<const CollectionCloud>> CollectionCloud::open(const std::string& path)
{
  std::shared_ptr<CollectionCloud> cloud(new CollectionCloud);
  const EpochAddress asked = EpochAddress::of(path);
  Result<std::shared_ptr<const PointStore>> heads = PointStore::openHeads(asked.file);
  if (!heads)
  {
    return heads.error();
  }
  cloud->heads_ = std::move(*heads);
  Result<CollectionRecord> read = recordOf(*cloud->heads_);
  if (!read)
  {
    return read.error();
  }
  const auto record = std::make_shared<const CollectionRecord>(std::move(*read));
  cloud->tiles_ = std::make_shared<const CollectionTiles>(followedLink(asked.file), record);
  Result<std::shared_ptr<const CollectionTable>> table =
    CollectionTable::make(asked.file, *cloud->heads_->hierarchy(), cloud->tiles_, asked.epoch);
  if (!table)
  {
    return table.error();
  }
  cloud->table_ = std::move(*table);
  cloud->epoch_ = asked.epoch;
  cloud->hierarchy_ = cloud->table_;
  cloud->description_ = record->whole;
  cloud->description_.path = path;
  cloud->description_.version = cloud->heads_->description().version;
  cloud->description_.epochs = record->epochs();
  if (asked.epoch)
  {
    if (const Result<void> told = cloud->tiles_->describeEpoch(*asked.epoch, cloud->description_);
        !told)
    {
      return told.error();
    }
  }
  cloud->description_.fileBytes += cloud->heads_->description().fileBytes;
  cloud->epochs_ = EpochColumn::of(cloud->table_, *record);
  if (cloud->epochs_)
  {
    cloud->epochs_->describe(cloud->description_);
  }
  for (const StoreDescription& kind : record->kinds)
  {
    Result<TileDescription> described = TileDescription::of(path, { &record->whole, &kind }, {});
    if (!described || !(described->whole.schema == record->whole.schema))
    {
      return makeError(Error::Kind::Corrupt,
        "'" + path + "' is damaged: tiles have attributes that the whole lacks; create it again");
    }
    cloud->columns_.push_back(std::move(described->parts[1].columns));
  }
  cloud->farTiles_ = std::any_of(record->tiles.begin(), record->tiles.end(),
    [](const CollectedTile& tile) { return isAddress(tile.is.address); });
  raiseOpenFiles(record->tiles.size());
  return std::shared_ptr<const CollectionCloud>(std::move(cloud));
}

std::vector<std::string> CollectionCloud::files() const
{
  std::vector<std::string> all{ heads_->description().path };
  for (std::size_t t = 0; t < record().tiles.size(); ++t)
  {
    all.push_back(tiles_->addressOf(t));
  }
  return all;
}

ReadCost CollectionCloud::readCost() const
{
  const ReadCost own = heads_->readCost();
  return own.far() || !farTiles_ ? own : farGuess;
}

/// The columns that heads and tiles have.
ColumnSelection CollectionCloud::stored(const ColumnSelection& columns) const
{
  return epochs_ ? epochs_->others(columns) : columns;
}

std::size_t CollectionCloud::decodedBytes(
  NodeIndex, std::uint32_t points, const ColumnSelection& columns) const
{
  return decodedBytesOf(points, columns, description_.schema);
}

std::size_t CollectionCloud::storedBytes(NodeIndex node, const ColumnSelection& columns) const
{
  const std::optional<CollectionTable::TileNode> at = table_->tileNodeOf(node);
  if (!at)
  {
    return heads_->storedBytes(node, stored(columns));
  }
  const CollectionTiles::Tile* const tile = tiles_->opened(at->tile);
  if (tile != nullptr)
  {
    return tile->cloud->storedBytes(at->node, tile->part.columns.own(stored(columns)));
  }
  constexpr std::size_t commonPacking = 3; // airborne clouds take a third of their decoded bytes
  Node row;
  const bool known = node < table_->headCount() && table_->peek(node, row) == RowState::Here;
  return known
    ? decodedBytesOf(row.pointCount, stored(columns), description_.schema) / commonPacking
    : 0;
}

Result<FetchedNode> CollectionCloud::wrapped(
  NodeIndex node, const ColumnSelection& columns, Result<FetchedNode> inner) const
{
  if (!inner)
  {
    return inner;
  }
  const std::optional<CollectionTable::TileNode> at = table_->tileNodeOf(node);
  FetchedNode fetched{ node, columns, {}, inner->bytesRead,
    at ? table_->shifted(*at, inner->row) : table_->node(node) };
  fetched.inner = std::make_shared<const FetchedNode>(std::move(*inner));
  return fetched;
}

Result<FetchedNode> CollectionCloud::fetch(NodeIndex node, const ColumnSelection& columns) const
{
  const ReadStop never{ false };
  return std::move(fetchAll({ { node, columns } }, never).front());
}

std::vector<Result<FetchedNode>> CollectionCloud::fetchOf(const StoredCloud& cloud,
  const std::vector<WantedNode>& own, const std::vector<WantedNode>& wanted,
  const ReadStop& stop) const
{
  std::vector<Result<FetchedNode>> inner = cloud.fetchAll(own, stop);
  for (std::size_t i = 0; i < inner.size(); ++i)
  {
    inner[i] = wrapped(wanted[i].node, wanted[i].columns, std::move(inner[i]));
  }
  return inner;
}

std::vector<Result<FetchedNode>> CollectionCloud::fetchAll(
  const std::vector<WantedNode>& wanted, const ReadStop& stop) const
{
  constexpr std::size_t ofHeads = std::numeric_limits<std::size_t>::max();
  std::map<std::size_t, std::vector<std::size_t>> places; // by tile, in `wanted`
  for (std::size_t i = 0; i < wanted.size(); ++i)
  {
    const std::optional<CollectionTable::TileNode> at = table_->tileNodeOf(wanted[i].node);
    places[at ? at->tile : ofHeads].push_back(i);
  }
  std::vector<std::optional<Result<FetchedNode>>> found(wanted.size());
  for (const auto& [tile, mine] : places)
  {
    const bool heads = tile == ofHeads;
    const Result<const CollectionTiles::Tile*> open = heads
      ? Result<const CollectionTiles::Tile*>(nullptr)
      : stop ? makeError(Error::Kind::Cancelled, "nobody wants the tile now")
             : table_->openTile(tile);
    std::vector<WantedNode> own;
    std::vector<WantedNode> asked;
    for (const std::size_t i : mine)
    {
      if (!open)
      {
        found[i] = open.error();
        continue;
      }
      asked.push_back(wanted[i]);
      const ColumnSelection columns = stored(wanted[i].columns);
      own.push_back(heads ? WantedNode{ wanted[i].node, columns }
                          : WantedNode{ table_->tileNodeOf(wanted[i].node)->node,
                              (*open)->part.columns.own(columns) });
    }
    if (open)
    {
      std::vector<Result<FetchedNode>> inner = fetchOf(
        heads ? static_cast<const StoredCloud&>(*heads_) : *(*open)->cloud, own, asked, stop);
      for (std::size_t i = 0; i < mine.size(); ++i)
      {
        found[mine[i]] = std::move(inner[i]);
      }
    }
  }
  std::vector<Result<FetchedNode>> results;
  results.reserve(found.size());
  for (std::optional<Result<FetchedNode>>& each : found)
  {
    results.push_back(std::move(*each));
  }
  return results;
}

Result<NodeColumns> CollectionCloud::decode(const FetchedNode& fetched) const
{
  const std::optional<CollectionTable::TileNode> at = table_->tileNodeOf(fetched.node);
  const CollectionTiles::Tile* const tile = at ? tiles_->opened(at->tile) : nullptr;
  Result<NodeColumns> inner =
    at ? tile->cloud->decode(*fetched.inner) : heads_->decode(*fetched.inner);
  if (!inner)
  {
    return inner;
  }
  NodeColumns result = std::move(*inner);
  if (at && at->head > 0)
  {
    const std::size_t head = std::min<std::size_t>(at->head, result.size());
    result = sliced(result, head, result.size(), tile->cloud->description().schema);
  }
  result.node = fetched.node;
  result.describe(fetched.row);
  if (at)
  {
    tile->part.columns.adapt(result, stored(fetched.columns), description_.schema);
    if (Result<void> placed = tile->part.placing.place(result, description_.path); !placed)
    {
      return placed.error();
    }
  }
  if (epochs_ && epochs_->isIn(fetched.columns))
  {
    epochs_->fill(result);
  }
  return result;
}

/// Range of all points of a tile, in common values, from what is known without opening it.
ValueRange CollectionCloud::rangeOf(std::size_t tile, std::uint32_t component) const
{
  const CollectedTile& is = record().tiles[tile];
  const StoreDescription& kind = record().kinds[is.kind];
  const auto wanted = WholeComponent::of(component, description_.schema);
  if (wanted.attribute == nullptr)
  {
    const QuantisationGrid& grid = description_.grid;
    const auto axis = static_cast<int>(component);
    const auto steps = [&](double world) { return (world - grid.offset[axis]) / grid.scale[axis]; };
    return { std::floor(steps(is.bounds.low[axis])) - 1.0,
      std::ceil(steps(is.bounds.high[axis])) + 1.0 };
  }
  const TileColumns& columns = columns_[is.kind];
  const auto own = columns.ownComponent(wanted.column, wanted.component);
  if (!own)
  {
    return { 0.0, 0.0 };
  }
  if (kind.rangesAreSampled)
  {
    return anyValue();
  }
  const std::array<double, 2>& ends = is.ranges[*own - coordinateComponents];
  return columns.adapted({ ends[0], ends[1] }, wanted.column, *wanted.attribute);
}

Result<std::shared_ptr<const NodeRanges>> CollectionCloud::nodeRanges(
  std::uint32_t component, NodeIndex most) const
{
  const AttributeSchema& schema = description_.schema;
  const auto& epochs = description_.epochColumn;
  if (epochs && component == rangeComponent(schema, *epochs, 0))
  {
    return epochRanges(most);
  }
  const auto heads = heads_->nodeRanges(component);
  if (!heads)
  {
    return heads;
  }
  const NodeIndex count = table_->headCount();
  std::vector<ValueRange> own(count, anyValue());
  std::vector<ValueRange> below(count, ValueRange{ 1.0, 0.0 });
  for (NodeIndex i = count; i-- > 0;)
  {
    const Node row = table_->node(i);
    if (const std::optional<CollectionTable::TileNode> at = table_->tileNodeOf(i))
    {
      own[i] = below[i] = rangeOf(at->tile, component);
      continue;
    }
    if (*heads && i < (*heads)->nodeCount())
    {
      own[i] = (*heads)->own(i);
    }
    below[i] = own[i];
    for (std::uint32_t c = 0; c < row.childCount; ++c)
    {
      below[i] = both(below[i], below[row.firstChild + c]);
    }
  }
  TileRanges all;
  for (NodeIndex i = 0; i < std::min(count, most); ++i)
  {
    all.add(own[i], below[i]);
  }
  return all.together();
}

std::shared_ptr<const NodeRanges> CollectionCloud::epochRanges(NodeIndex most) const
{
  TileRanges all;
  for (NodeIndex i = 0; i < std::min(table_->headCount(), most); ++i)
  {
    const double time = epochs_->timeOf(i);
    all.add({ time, time }, { time, time });
  }
  return all.together();
}

std::vector<std::size_t> CollectionCloud::tileNumbers() const
{
  std::vector<std::size_t> numbers;
  for (std::size_t t = 0; t < record().tiles.size(); ++t)
  {
    if (!epoch_ || record().tiles[t].is.epoch == *epoch_)
    {
      numbers.push_back(t);
    }
  }
  return numbers;
}

Result<VerifyReport> CollectionCloud::verify(const ProgressFunction& progress) const
{
  Result<VerifyReport> all = heads_->verify(progress);
  if (all)
  {
    all->pointsChecked = 0; // heads hold copies of points that their tiles have
  }
  for (const std::size_t t : tileNumbers())
  {
    if (!all || !all->ok)
    {
      break;
    }
    const Result<const CollectionTiles::Tile*> tile = table_->openTile(t);
    if (!tile)
    {
      all->ok = false;
      all->firstError = tile.error().what;
      break;
    }
    const Result<VerifyReport> own = (*tile)->cloud->verify(progress);
    if (!own)
    {
      return own;
    }
    all->nodesChecked += own->nodesChecked;
    all->pointsChecked += own->pointsChecked;
    all->ok = own->ok;
    all->firstError = own->firstError;
  }
  return all;
}

Result<std::shared_ptr<const StoredCloud>> CollectionFormat::open(const std::string& path) const
{
  Result<std::shared_ptr<const CollectionCloud>> cloud = CollectionCloud::open(path);
  return cloud ? Result<std::shared_ptr<const StoredCloud>>(std::move(*cloud)) : cloud.error();
}

} // namespace pointfront
