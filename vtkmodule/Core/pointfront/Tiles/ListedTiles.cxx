#include "pointfront/Tiles/ListedTiles.h"

#include "pointfront/Base/NumberText.h"
#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Disk/StopOfReads.h"
#include "pointfront/Threads/WaitingWork.h"
#include "pointfront/Tiles/StoredCloudFormats.h"
#include "pointfront/Tiles/TileFetch.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::size_t mostKinds = 16; ///< kinds that have a tile opened with the list
constexpr std::size_t looked = 4; ///< tiles over the whole list that are opened with it
constexpr std::size_t mostTries = 4; ///< tiles of a kind that are tried one after another

std::string boxText(const Bounds& box)
{
  const auto corner = [](const glm::dvec3& at)
  {
    return "(" + numberText(at.x, 10) + " " + numberText(at.y, 10) + " " + numberText(at.z, 10) +
      ")";
  };
  return corner(box.low) + " to " + corner(box.high);
}

/// First bytes of a COPC file: its header, and a hierarchy at its end of so many points.
FirstBytes firstOf(const ListedTile& tile)
{
  constexpr std::size_t head = std::size_t(8) << 10;
  constexpr std::size_t beside = std::size_t(8) << 10; // records at the end
  constexpr std::size_t mostTail = std::size_t(256) << 10;
  constexpr std::uint64_t pointsPerByte = 64; // 2,000 points a node, whose entry has 32 bytes
  const auto entries = static_cast<std::size_t>(
    std::min<std::uint64_t>(tile.points / pointsPerByte, mostTail - beside));
  return { head, beside + entries };
}
} // namespace

glm::dvec3 ListedTile::rounding() const
{
  constexpr double share = 1e-4;
  const glm::dvec3 size = bounds.size();
  return glm::dvec3(share * std::max({ size.x, size.y, size.z }));
}

Error ListedTile::unlike(const std::string& what) const
{
  return makeError(Error::Kind::Unreadable,
    "'" + publicForm(address) + "' is not what the list says: " + what +
      "; write the list again, or open the tiles by a list of stores (.pfronts)");
}

Result<void> ListedTile::compare(const StoreDescription& own) const
{
  if (own.pointCount != points)
  {
    return unlike(
      "it has " + std::to_string(own.pointCount) + " points, not " + std::to_string(points));
  }
  const glm::dvec3 room = rounding();
  const Bounds box{ bounds.low - room, bounds.high + room };
  if (!own.bounds.empty() && !(box.contains(own.bounds.low) && box.contains(own.bounds.high)))
  {
    return unlike("its points lie in " + boxText(own.bounds) + ", not in " + boxText(bounds));
  }
  return {};
}

struct ListedTiles::Slot
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

ListedTiles::ListedTiles(std::string path, std::vector<ListedTile> tiles)
  : path_(std::move(path))
  , tiles_(std::move(tiles))
  , slots_(new Slot[tiles_.size()])
{
}

ListedTiles::~ListedTiles() = default;

Result<std::shared_ptr<const ListedTiles>> ListedTiles::make(
  const std::string& path, std::vector<ListedTile> tiles, std::vector<std::string> warnings)
{
  if (tiles.empty())
  {
    return makeError(Error::Kind::BadArgument, path + ": names no tile");
  }
  raiseOpenFiles(tiles.size());
  std::shared_ptr<ListedTiles> made(new ListedTiles(path, std::move(tiles)));
  if (Result<void> opened = made->openFirst(std::move(warnings)); !opened)
  {
    return opened.error();
  }
  return std::shared_ptr<const ListedTiles>(std::move(made));
}

/// The numbers of a tile of each kind, and of some over the whole list; ascending.
std::vector<std::size_t> ListedTiles::chosen(const Kinds& kinds) const
{
  std::vector<std::size_t> wanted;
  for (const auto& [kind, own] : kinds)
  {
    if (wanted.size() < mostKinds)
    {
      wanted.push_back(own.front());
    }
  }
  for (std::size_t i = 0; i < looked; ++i)
  {
    wanted.push_back(i * (tiles_.size() - 1) / (looked - 1));
  }
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  return wanted;
}

Result<void> ListedTiles::openFirst(std::vector<std::string> warnings)
{
  Kinds kinds;
  for (std::size_t t = 0; t < tiles_.size(); ++t)
  {
    kinds[tiles_[t].kind].push_back(t);
  }
  const std::vector<std::size_t> wanted = chosen(kinds);
  const std::function<bool()> stopped = StopOfReads::carry();
  const auto open = [&](std::size_t t)
  {
    const StopOfReads stop(stopped);
    Result<std::shared_ptr<const StoredCloud>> cloud = openCloud(t);
    if (cloud)
    {
      slots_[t].tile.reset(new Tile{ std::move(*cloud), { { {}, {} }, { {}, {} }, {} } });
      return;
    }
    slots_[t].error = cloud.error();
  };
  runWaiting(wanted.size(), openingsAtOnce, [&](std::size_t i) { open(wanted[i]); });
  const auto isOpen = [this](std::size_t t) { return slots_[t].tile != nullptr; };
  std::vector<std::size_t> first;
  for (const auto& [kind, own] : kinds)
  {
    std::size_t tries = 0;
    for (std::size_t i = 0; i < own.size() && tries < mostTries; ++i)
    {
      if (std::none_of(own.begin(), own.end(), isOpen) && !slots_[own[i]].error)
      {
        open(own[i]);
        ++tries;
      }
    }
    std::copy_if(own.begin(), own.end(), std::back_inserter(first), isOpen);
  }
  std::sort(first.begin(), first.end());
  if (Result<void> sound = refuseFaults(first); !sound)
  {
    return sound;
  }
  return describe(first, std::move(warnings));
}

/// Where nothing can be opened, or somebody stopped it, or the tiles are no single trees. A tree of
/// one class says nothing of the classes that tiles which are closed have.
Result<void> ListedTiles::refuseFaults(const std::vector<std::size_t>& first)
{
  for (std::size_t t = 0; t < tiles_.size(); ++t)
  {
    const std::optional<Error>& error = slots_[t].error;
    if (error && (first.empty() || error->kind == Error::Kind::Cancelled))
    {
      return makeError(error->kind, path_ + ": " + error->what);
    }
    slots_[t].state = error ? Slot::State::Failed : Slot::State::Closed;
  }
  for (const std::size_t t : first)
  {
    const StoreDescription& own = slots_[t].tile->cloud->description();
    if (own.layers.size() != 1 || own.layers.front().name != "all")
    {
      return makeError(Error::Kind::Unsupported,
        path_ + ": '" + publicForm(tiles_[t].address) +
          "' has a tree for each class; open its tiles by a list of stores (.pfronts)");
    }
  }
  return {};
}

/// Descriptions of all tiles: those of tiles that are open, with the facts of the list.
std::vector<StoreDescription> ListedTiles::likeFirst(const std::vector<std::size_t>& first) const
{
  std::map<std::string, std::size_t> patterns;
  for (const std::size_t t : first)
  {
    patterns.emplace(tiles_[t].kind, t);
  }
  std::vector<StoreDescription> all;
  all.reserve(tiles_.size());
  for (std::size_t t = 0; t < tiles_.size(); ++t)
  {
    const ListedTile& tile = tiles_[t];
    const auto found = patterns.find(tile.kind);
    const std::size_t like = slots_[t].tile ? t
      : found != patterns.end()             ? found->second
                                            : first.front();
    StoreDescription& own = all.emplace_back(slots_[like].tile->cloud->description());
    own.path = tile.address;
    own.fileBytes = 0; // not known
    own.bounds = tile.bounds;
    own.pointCount = tile.points;
    own.wholeCount = 0;
    own.layers.front().pointCount = tile.points;
    own.layers.front().nodeCount = 0; // not known
    own.warnings.clear();
  }
  return all;
}

/// Lists say it in other words than files: their words are compared with each other.
void ListedTiles::compareSystems()
{
  const ListedTile* known = nullptr;
  const ListedTile* other = nullptr;
  std::size_t others = 0;
  for (const ListedTile& tile : tiles_)
  {
    known = known == nullptr && !tile.system.empty() ? &tile : known;
    if (!tile.system.empty() && tile.system != known->system)
    {
      other = other == nullptr ? &tile : other;
      ++others;
    }
  }
  if (others > 0)
  {
    whole_.warnings.push_back(std::to_string(others) + " of " + std::to_string(tiles_.size()) +
      " files are said to be in another coordinate reference system than '" +
      publicForm(known->address) + "', the first '" + publicForm(other->address) +
      "': unless both mean the same, they do not lie where they should.");
  }
}

/// The whole, by the tiles that are open and the facts of the list.
Result<void> ListedTiles::describe(
  const std::vector<std::size_t>& first, std::vector<std::string> warnings)
{
  const std::vector<StoreDescription> all = likeFirst(first);
  std::vector<const StoreDescription*> pointers;
  for (const StoreDescription& one : all)
  {
    pointers.push_back(&one);
  }
  Result<TileDescription> described =
    TileDescription::ofStores(path_, pointers, std::move(warnings));
  if (!described)
  {
    return described.error();
  }
  whole_ = std::move(described->whole);
  whole_.rangesAreSampled = true;
  ++whole_.levels; // the boxes of tiles that are closed
  compareSystems();
  for (const std::size_t t : first)
  {
    Slot& slot = slots_[t];
    Result<TileDescription::Part> part = partOf(t, *slot.tile->cloud);
    if (!part && first.size() == 1)
    {
      return part.error();
    }
    if (part)
    {
      slot.tile.reset(new Tile{ slot.tile->cloud, std::move(*part) });
    }
    else
    {
      slot.tile.reset();
      slot.error = makeError(part.error().kind, path_ + ": " + part.error().what);
    }
    slot.state = part ? Slot::State::Open : Slot::State::Failed;
  }
  return {};
}

NodeIndex ListedTiles::mostNodes(std::size_t tile) const
{
  constexpr std::uint64_t few = 1024;
  constexpr std::uint64_t pointsOfANode = 64; // on average; of others some thousand
  return static_cast<NodeIndex>(
    std::min<std::uint64_t>(few + tiles_[tile].points / pointsOfANode, noNode / 2));
}

const ListedTiles::Tile* ListedTiles::opened(std::size_t tile) const
{
  const Slot& slot = slots_[tile];
  return slot.state == Slot::State::Open ? slot.tile.get() : nullptr;
}

bool ListedTiles::failed(std::size_t tile) const
{
  return slots_[tile].state == Slot::State::Failed;
}

Result<const ListedTiles::Tile*> ListedTiles::open(std::size_t tile) const
{
  Slot& slot = slots_[tile];
  const std::lock_guard<std::mutex> lock(slot.opening);
  if (slot.state == Slot::State::Closed)
  {
    const Result<std::shared_ptr<const StoredCloud>> cloud = openCloud(tile);
    if (!cloud && cloud.error().kind == Error::Kind::Cancelled)
    {
      return cloud.error();
    }
    Result<TileDescription::Part> part =
      cloud ? partOf(tile, **cloud) : Result<TileDescription::Part>(cloud.error());
    if (part)
    {
      slot.tile.reset(new Tile{ *cloud, std::move(*part) });
    }
    else
    {
      slot.error = makeError(part.error().kind, path_ + ": " + part.error().what);
    }
    slot.state = part ? Slot::State::Open : Slot::State::Failed;
  }
  return slot.error ? Result<const Tile*>(*slot.error) : Result<const Tile*>(slot.tile.get());
}

Result<std::shared_ptr<const StoredCloud>> ListedTiles::openCloud(std::size_t tile) const
{
  const std::string& address = tiles_[tile].address;
  std::shared_ptr<const ByteSource> held; // a source that is open is the same for all
  if (isAddress(address) && fileNameOf(address) != "ept.json")
  {
    // A list may have ten thousand: no more of each than it needs.
    Result<std::shared_ptr<const ByteSource>> source = openBytes(address, firstOf(tiles_[tile]));
    if (!source)
    {
      return source.error();
    }
    held = std::move(*source);
  }
  return StoredCloudFormats::ofProcess().openWhole(address);
}

/// Its part in the whole, if it is what the list says.
Result<TileDescription::Part> ListedTiles::partOf(std::size_t tile, const StoredCloud& cloud) const
{
  const ListedTile& listed = tiles_[tile];
  const StoreDescription& own = cloud.description();
  if (Result<void> same = listed.compare(own); !same)
  {
    return same.error();
  }
  if (cloud.hierarchy()->nodeCount() > mostNodes(tile))
  {
    return listed.unlike("it has " + std::to_string(cloud.hierarchy()->nodeCount()) +
      " nodes, more than a tile of so many points should have");
  }
  Result<TileDescription> described = TileDescription::ofStores(path_, { &whole_, &own }, {});
  if (!described)
  {
    return described.error();
  }
  const StoreDescription& both = described->whole;
  if (!(both.schema == whole_.schema) || both.splatRadiusBase != whole_.splatRadiusBase ||
    both.layers.size() != whole_.layers.size() || cloud.hierarchy()->roots().size() > 1)
  {
    return listed.unlike(
      "it has other attributes or trees than the tiles that are open, which the list does not say");
  }
  TileDescription::Part part = std::move(described->parts[1]);
  part.placing = TilePlacing(own.grid, whole_.grid);
  return part;
}

} // namespace pointfront
