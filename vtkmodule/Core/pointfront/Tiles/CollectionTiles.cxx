#include "pointfront/Tiles/CollectionTiles.h"

#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Points/GpsTimes.h"
#include "pointfront/Tiles/StoredCloudFormats.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>
#include <utility>

namespace pointfront
{
namespace
{
/// Counts and bounds of the tiles.
void countEpoch(const CollectionRecord& record, const std::string& epoch, StoreDescription& whole)
{
  whole.epochs = { epoch };
  whole.bounds = Bounds();
  whole.pointCount = whole.wholeCount = whole.fileBytes = 0;
  for (Layer& layer : whole.layers)
  {
    layer.pointCount = layer.nodeCount = 0;
  }
  for (const CollectedTile& tile : record.tiles)
  {
    if (tile.is.epoch != epoch)
    {
      continue;
    }
    whole.bounds.add(tile.bounds);
    whole.pointCount += tile.pointCount;
    whole.wholeCount += tile.wholeCount;
    whole.fileBytes += tile.fileBytes;
    for (std::size_t l = 0; l < tile.layers.size(); ++l)
    {
      const std::uint16_t at = record.layerOf(tile, static_cast<std::uint16_t>(l));
      if (at < whole.layers.size()) // else it has no node
      {
        whole.layers[at].pointCount += tile.layers[l].first;
        whole.layers[at].nodeCount += tile.layers[l].second;
      }
    }
  }
}
} // namespace

struct CollectionTiles::Slot
{
  enum class State
  {
    Closed,
    Open,
    Failed
  };
  std::mutex opening;
  std::atomic<State> state{ State::Closed }; ///< the others are constant once it is not Closed
  std::unique_ptr<const Tile> tile;
  std::optional<Error> error;
};

CollectionTiles::CollectionTiles(std::string path, std::shared_ptr<const CollectionRecord> record)
  : path_(std::move(path))
  , record_(std::move(record))
  , slots_(new Slot[record_->tiles.size()])
{
}

CollectionTiles::~CollectionTiles() = default;

std::string CollectionTiles::addressOf(std::size_t tile) const
{
  return beside(path_, record_->tiles[tile].is.address);
}

const CollectionTiles::Tile* CollectionTiles::opened(std::size_t tile) const
{
  const Slot& slot = slots_[tile];
  return slot.state == Slot::State::Open ? slot.tile.get() : nullptr;
}

bool CollectionTiles::failed(std::size_t tile) const
{
  return slots_[tile].state == Slot::State::Failed;
}

Result<const CollectionTiles::Tile*> CollectionTiles::open(std::size_t tile) const
{
  Slot& slot = slots_[tile];
  const std::lock_guard<std::mutex> lock(slot.opening);
  if (slot.state == Slot::State::Closed)
  {
    Result<std::unique_ptr<const Tile>> now = openNow(tile);
    if (!now && now.error().kind == Error::Kind::Cancelled)
    {
      return now.error();
    }
    if (now)
    {
      slot.tile = std::move(*now);
      slot.state = Slot::State::Open;
    }
    else
    {
      slot.error = now.error();
      slot.state = Slot::State::Failed;
    }
  }
  return slot.error ? Result<const Tile*>(*slot.error) : Result<const Tile*>(slot.tile.get());
}

/// Fault of a tile whose table is not that which the collection knows; empty: there is none.
std::string CollectionTiles::rowsFault(std::size_t tile, const StoredCloud& cloud) const
{
  const CollectedTile& known = record_->tiles[tile];
  const Hierarchy& table = *cloud.hierarchy();
  bool same = cloud.description().pointCount == known.pointCount &&
    table.nodeCount() == known.nodes && table.roots().size() == known.roots.size();
  for (std::size_t r = 0; r < known.roots.size() && same; ++r)
  {
    const TileRoot& root = known.roots[r];
    const Node row = table.node(root.node);
    same = table.roots()[r] == root.node && row.pointCount == root.row.pointCount &&
      row.pointsBelow == root.row.pointsBelow && row.firstChild == root.row.firstChild &&
      row.childCount == root.row.childCount && row.layer == root.row.layer &&
      row.firstPoint == root.row.firstPoint;
  }
  return same ? "" : " has other nodes than the collection knows";
}

Result<std::unique_ptr<const CollectionTiles::Tile>> CollectionTiles::openNow(
  std::size_t tile) const
{
  const std::string address = addressOf(tile);
  const std::string before = path_ + ": its tile '" + publicForm(address) + "'";
  const std::string advice = "; put the file that it was made of back, or take the new one in: "
                             "pointfront collection replace";
  Result<std::shared_ptr<const StoredCloud>> cloud =
    StoredCloudFormats::ofProcess().openWhole(address);
  const Result<TileIdentity> is = TileIdentity::of(cloud ? (*cloud)->files().front() : address);
  if (is && !(*is == record_->tiles[tile].is.identity))
  {
    return makeError(Error::Kind::Unreadable,
      before + " has been replaced since the collection was written" + advice);
  }
  if (!cloud || !is)
  {
    const Error& error = cloud ? is.error() : cloud.error();
    return makeError(error.kind, before + " cannot be opened: " + error.what);
  }
  if (const std::string fault = rowsFault(tile, **cloud); !fault.empty())
  {
    return makeError(Error::Kind::Unreadable, before + fault + advice);
  }
  Result<TileDescription> described =
    TileDescription::of(path_, { &record_->whole, &(*cloud)->description() }, {});
  if (!described || !(described->whole.schema == record_->whole.schema))
  {
    return makeError(Error::Kind::Unreadable,
      before + " has attributes that the collection does not know" + advice);
  }
  return std::unique_ptr<const Tile>(new Tile{ std::move(*cloud), std::move(described->parts[1]) });
}

Result<void> CollectionTiles::describeEpoch(const std::string& epoch, StoreDescription& whole) const
{
  countEpoch(*record_, epoch, whole);
  const std::vector<CollectedTile>& tiles = record_->tiles;
  std::vector<QuantisationGrid> grids{ whole.grid }; // where their points are placed
  std::for_each(tiles.begin(), tiles.end(),
    [&](const CollectedTile& tile)
    { tile.is.epoch == epoch ? grids.push_back(tile.grid) : void(); });
  std::vector<std::size_t> places;
  Result<TileDescription> described =
    TileDescription::of(whole.path, record_->alikeTiles(epoch, places), grids, {});
  if (!described)
  {
    return described.error();
  }
  const StoreDescription& own = described->whole;
  whole.warnings = own.warnings;
  GatheredTimes times;
  times.add(whole.path, own.schema, own.metadata);
  times.keepIn(whole.metadata);
  whole.computed.clear();
  std::string lacked;
  for (std::uint32_t c = 0; c < whole.schema.size(); ++c)
  {
    const std::string& name = whole.schema[c].name;
    const std::optional<std::size_t> at = own.schema.find(name);
    lacked += at ? "" : (lacked.empty() ? "" : ", ") + name;
    if (!at || own.isComputed(*at))
    {
      whole.computed.push_back(c);
    }
  }
  const std::string told = "No store of this epoch has " + lacked + ", which other epochs have; ";
  lacked.empty() ? void() : whole.warnings.push_back(told + "who names it gets zeros.");
  return {};
}

} // namespace pointfront
