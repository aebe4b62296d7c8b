#include "pointfront/Tiles/CollectionRecord.h"

#include "pointfront/Codec/ByteStream.h"
#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Store/DescriptionSection.h"

#include <algorithm>
#include <set>
#include <utility>

namespace pointfront
{
namespace
{
void putDescription(ByteWriter& out, const StoreDescription& description)
{
  const std::vector<std::byte> bytes = encodeDescription({ description, {}, {} });
  out.put(static_cast<std::uint64_t>(bytes.size()));
  out.putBytes(bytes.data(), bytes.size());
  out.put(description.version);
  out.put(static_cast<std::uint8_t>(description.rangesAreSampled));
  out.put(static_cast<std::uint32_t>(description.computed.size()));
  for (const std::uint32_t column : description.computed)
  {
    out.put(column);
  }
}

std::optional<StoreDescription> descriptionOf(ByteReader& in)
{
  const auto size = in.get<std::uint64_t>();
  if (size > in.remaining())
  {
    return std::nullopt;
  }
  const std::byte* const bytes = in.getBytes(static_cast<std::size_t>(size));
  std::optional<StoredDescription> stored =
    decodeDescription(bytes, static_cast<std::size_t>(size));
  if (!stored)
  {
    return std::nullopt;
  }
  StoreDescription description = std::move(stored->description);
  description.version = in.get<std::uint32_t>();
  description.rangesAreSampled = in.get<std::uint8_t>() != 0;
  const std::size_t computed = takeCount(in, 4);
  for (std::size_t i = 0; i < computed; ++i)
  {
    description.computed.push_back(in.get<std::uint32_t>());
    if (description.computed.back() >= description.schema.size())
    {
      return std::nullopt;
    }
  }
  return description;
}

void putHead(ByteWriter& out, const HeadNode& head)
{
  out.put(static_cast<std::uint8_t>(head.root ? 1 : 0));
  if (head.root)
  {
    out.put(head.root->first);
    out.put(head.root->second);
    return;
  }
  for (const GridPosition& corner : { head.bounds.low, head.bounds.high })
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      out.put(corner[axis]);
    }
  }
  for (const ColumnRange& range : head.ranges)
  {
    for (const std::array<double, 2>& ends : range.components)
    {
      out.put(ends[0]);
      out.put(ends[1]);
    }
  }
}

HeadNode headOf(ByteReader& in, const AttributeSchema& whole)
{
  HeadNode head;
  if (in.get<std::uint8_t>() == 1)
  {
    const auto tile = in.get<std::uint32_t>();
    head.root = { tile, in.get<std::uint32_t>() };
    return head;
  }
  for (GridPosition* const corner : { &head.bounds.low, &head.bounds.high })
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      (*corner)[axis] = in.get<std::int64_t>();
    }
  }
  head.ranges.reserve(whole.size() + 1);
  for (std::size_t c = 0; c <= whole.size(); ++c) // and that of the tile
  {
    ColumnRange& range = head.ranges.emplace_back();
    range.components.resize(c < whole.size() ? whole[c].components : 1);
    for (std::array<double, 2>& ends : range.components)
    {
      ends[0] = in.get<double>();
      ends[1] = in.get<double>();
    }
  }
  return head;
}

/// Each root of each tile stands for one node, and nothing else does.
bool rootsStandOnce(const CollectionRecord& record)
{
  std::vector<std::vector<bool>> seen;
  std::size_t roots = 0;
  for (const CollectedTile& tile : record.tiles)
  {
    seen.emplace_back(tile.roots.size());
    roots += tile.roots.size();
  }
  std::size_t found = 0;
  for (const HeadNode& head : record.heads)
  {
    if (!head.root)
    {
      continue;
    }
    const auto& [tile, root] = *head.root;
    if (tile >= seen.size() || root >= seen[tile].size() || seen[tile][root])
    {
      return false;
    }
    seen[tile][root] = true;
    ++found;
  }
  return found == roots;
}

void putHistory(ByteWriter& out, const std::vector<CollectionChange>& history)
{
  out.put(static_cast<std::uint32_t>(history.size()));
  for (const CollectionChange& change : history)
  {
    out.putText(change.what);
    out.put(static_cast<std::uint32_t>(change.added.size()));
    for (const std::uint32_t id : change.added)
    {
      out.put(id);
    }
    out.put(static_cast<std::uint32_t>(change.removed.size()));
    for (const TileName& tile : change.removed)
    {
      tile.put(out);
    }
  }
}

std::vector<CollectionChange> historyOf(ByteReader& in)
{
  std::vector<CollectionChange> history(takeCount(in, 12));
  for (CollectionChange& change : history)
  {
    change.what = in.getText();
    change.added.resize(takeCount(in, 4));
    for (std::uint32_t& id : change.added)
    {
      id = in.get<std::uint32_t>();
    }
    const std::size_t removed = takeCount(in, 32);
    for (std::size_t i = 0; i < removed; ++i)
    {
      change.removed.push_back(TileName::take(in));
    }
  }
  return history;
}

/// The bytes that a record takes, about.
std::size_t roomFor(const CollectionRecord& record)
{
  constexpr std::size_t tileBytes = 240; // with its texts; ranges, layers and roots not
  std::size_t bytes = std::size_t(1) << 16;
  for (const CollectedTile& tile : record.tiles)
  {
    bytes += tileBytes + 16 * tile.ranges.size() + 12 * tile.layers.size() + 80 * tile.roots.size();
  }
  for (const HeadNode& head : record.heads)
  {
    bytes += 9 + (head.root ? 0 : 40 + 24 * head.ranges.size());
  }
  return bytes;
}

/// All that stands besides the description's own bytes.
void putWhole(ByteWriter& out, const StoreDescription& whole)
{
  putDescription(out, whole);
  putBounds(out, whole.bounds);
  out.put(whole.pointCount);
  out.put(whole.wholeCount);
  out.put(whole.fileBytes);
  out.put(static_cast<std::uint32_t>(whole.warnings.size()));
  for (const std::string& warning : whole.warnings)
  {
    out.putText(warning);
  }
}

std::optional<StoreDescription> wholeOf(ByteReader& in)
{
  std::optional<StoreDescription> whole = descriptionOf(in);
  if (whole)
  {
    whole->bounds = takeBounds(in);
    whole->pointCount = in.get<std::uint64_t>();
    whole->wholeCount = in.get<std::uint64_t>();
    whole->fileBytes = in.get<std::uint64_t>();
    const std::size_t warnings = takeCount(in, 4);
    for (std::size_t i = 0; i < warnings; ++i)
    {
      whole->warnings.push_back(in.getText());
    }
  }
  return whole;
}
} // namespace

StoreDescription CollectionRecord::description(std::size_t tile, const std::string& path) const
{
  const CollectedTile& is = tiles[tile];
  StoreDescription own = kinds[is.kind];
  own.path = path;
  own.grid = is.grid;
  own.bounds = is.bounds;
  own.pointCount = is.pointCount;
  own.wholeCount = is.wholeCount;
  own.fileBytes = is.fileBytes;
  own.levels = is.levels;
  std::size_t at = 0;
  for (ColumnRange& range : own.ranges)
  {
    for (std::array<double, 2>& ends : range.components)
    {
      ends = is.ranges[at++];
    }
  }
  for (std::size_t layer = 0; layer < own.layers.size(); ++layer)
  {
    own.layers[layer].pointCount = is.layers[layer].first;
    own.layers[layer].nodeCount = is.layers[layer].second;
  }
  return own;
}

std::uint16_t CollectionRecord::layerOf(const CollectedTile& tile, std::uint16_t own) const
{
  const Layer& is = kinds[tile.kind].layers[own];
  const auto found = std::find_if(whole.layers.begin(), whole.layers.end(),
    [&](const Layer& layer)
    { return layer.objectClass == is.objectClass && layer.name == is.name; });
  return static_cast<std::uint16_t>(found - whole.layers.begin());
}

HeadTreeKey CollectionRecord::treeOf(const CollectedTile& tile, std::size_t root) const
{
  return { layerOf(tile, tile.roots[root].row.layer), tile.is.epoch };
}

std::vector<AlikeTiles> CollectionRecord::alikeTiles(
  const std::optional<std::string>& epoch, std::vector<std::size_t>& places) const
{
  constexpr std::size_t none = SIZE_MAX;
  std::vector<AlikeTiles> alike;
  places.assign(kinds.size(), none);
  for (std::size_t t = 0; t < tiles.size(); ++t)
  {
    const CollectedTile& tile = tiles[t];
    std::size_t& place = places[tile.kind];
    const bool shown = !epoch || tile.is.epoch == *epoch;
    if (shown && place != none)
    {
      alike[place].add(tile);
    }
    else if (shown)
    {
      place = alike.size();
      alike.emplace_back().begin(description(t, tile.is.address));
    }
  }
  return alike;
}

std::vector<std::string> CollectionRecord::epochs() const
{
  std::set<std::string> all;
  for (const CollectedTile& tile : tiles)
  {
    all.insert(tile.is.epoch);
  }
  return { all.begin(), all.end() };
}

Result<void> CollectionRecord::checkAddresses(const std::string& path) const
{
  const auto check = [&path](const TileName& tile) -> Result<void>
  {
    Result<void> sound = refuseSettings(path, tile.address);
    const Result<std::string> file = sound ? fileNamedBy(path, tile.address) : sound.error();
    return file ? Result<void>() : file.error();
  };
  Result<void> sound;
  for (std::size_t t = 0; t < tiles.size() && sound; ++t)
  {
    sound = check(tiles[t].is);
  }
  for (const CollectionChange& change : history)
  {
    for (std::size_t t = 0; t < change.removed.size() && sound; ++t)
    {
      sound = check(change.removed[t]);
    }
  }
  return sound;
}

std::vector<std::byte> CollectionRecord::encode() const
{
  ByteWriter out;
  out.reserve(roomFor(*this));
  out.put(epochs().size() > 1 ? newest : std::uint32_t(1));
  out.put(state);
  out.put(nextId);
  putWhole(out, whole);
  out.put(static_cast<std::uint32_t>(kinds.size()));
  for (const StoreDescription& kind : kinds)
  {
    putDescription(out, kind);
  }
  out.put(static_cast<std::uint32_t>(tiles.size()));
  for (const CollectedTile& tile : tiles)
  {
    tile.put(out);
  }
  out.put(static_cast<std::uint32_t>(heads.size()));
  for (const HeadNode& head : heads)
  {
    putHead(out, head);
  }
  putHistory(out, history);
  return out.take();
}

std::optional<CollectionRecord> CollectionRecord::decode(const std::byte* data, std::size_t size)
{
  ByteReader in(data, size);
  CollectionRecord record;
  record.version = in.get<std::uint32_t>();
  if (record.version > newest)
  {
    return record;
  }
  record.state = in.get<std::uint64_t>();
  record.nextId = in.get<std::uint32_t>();
  std::optional<StoreDescription> whole = wholeOf(in);
  if (!whole || record.version == 0)
  {
    return std::nullopt;
  }
  record.whole = std::move(*whole);
  const std::size_t kinds = takeCount(in, 64);
  for (std::size_t k = 0; k < kinds; ++k)
  {
    std::optional<StoreDescription> kind = descriptionOf(in);
    if (!kind)
    {
      return std::nullopt;
    }
    record.kinds.push_back(std::move(*kind));
  }
  const std::size_t tiles = takeCount(in, 128);
  record.tiles.reserve(tiles);
  for (std::size_t t = 0; t < tiles && in.ok(); ++t)
  {
    record.tiles.push_back(CollectedTile::take(in));
    if (!record.tiles.back().isSound(record.kinds))
    {
      return std::nullopt;
    }
  }
  const std::size_t heads = takeCount(in, 9);
  record.heads.reserve(heads);
  for (std::size_t h = 0; h < heads && in.ok(); ++h)
  {
    record.heads.push_back(headOf(in, record.whole.schema));
  }
  record.history = historyOf(in);
  const bool sound = in.ok() && in.remaining() == 0 && !record.tiles.empty();
  return sound && rootsStandOnce(record) ? std::optional(std::move(record)) : std::nullopt;
}

} // namespace pointfront
