#include "pointfront/Collection/TileIntake.h"

#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Disk/StopOfReads.h"
#include "pointfront/Disk/TemporaryFile.h"
#include "pointfront/Ingest/RecordColumns.h"
#include "pointfront/Points/GpsTimes.h"
#include "pointfront/Store/DescriptionSection.h"
#include "pointfront/Store/HeldColours.h"
#include "pointfront/Store/PreviewRecord.h"
#include "pointfront/Threads/ThreadCrew.h"
#include "pointfront/Tiles/StoredCloudFormats.h"
#include "pointfront/Tiles/TileFetch.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <numeric>
#include <utility>

namespace pointfront
{
namespace fs = std::filesystem;

namespace
{
/// The reason why a cloud cannot be a tile; empty: it can.
std::string refusalOf(const StoredCloud& cloud)
{
  const StoreDescription& is = cloud.description();
  if (is.structure == "collection" || is.structure == "tiles")
  {
    return "is made of tiles itself; name those";
  }
  if (previewRecordOf(is.metadata))
  {
    return "is the preview of a build; wait for its end";
  }
  if (is.refinement != Refinement::Add)
  {
    return "has representatives (--refinement replace), which a collection does not take; build it "
           "with --refinement add";
  }
  return "";
}

bool isEmpty(const StoredCloud& cloud)
{
  return cloud.description().pointCount == 0 || cloud.hierarchy()->roots().empty();
}

constexpr std::size_t mostNamed = 3;

Result<IncomingTile> openTile(const std::string& collection, const TileRequest& request)
{
  Result<std::shared_ptr<const StoredCloud>> cloud =
    StoredCloudFormats::ofProcess().openWhole(request.path);
  if (!cloud)
  {
    return cloud.error();
  }
  if (const std::string why = refusalOf(**cloud); !why.empty())
  {
    return makeError(Error::Kind::BadArgument, "'" + request.path + "' " + why);
  }
  const Result<TileIdentity> identity = TileIdentity::of((*cloud)->files().front());
  if (!identity)
  {
    return identity.error();
  }
  if (request.identity && !(*request.identity == *identity))
  {
    return makeError(Error::Kind::Unreadable,
      "'" + request.path +
        "' is not the file any more that the collection knows; put that back, "
        "or take this one in: pointfront collection replace");
  }
  TileName is{ request.id,
    request.address.empty() ? relativeAddress(collection, request.path) : request.address,
    request.name.empty() ? tileNameOf(request.path) : request.name, request.epoch, *identity };
  return IncomingTile{ std::move(is), std::move(*cloud), !request.name.empty() };
}

/// Told at most ten times a second, from one thread at a time.
class OpeningProgress
{
public:
  OpeningProgress(const ProgressFunction& progress, std::size_t tiles)
    : progress_(progress)
    , tiles_(tiles)
  {
  }
  /// False: the user wants to stop.
  bool opened()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++done_;
    const auto now = std::chrono::steady_clock::now();
    if (progress_ && !stopped_ && now - told_ > std::chrono::milliseconds(100))
    {
      told_ = now;
      const double part = static_cast<double>(done_) / static_cast<double>(tiles_);
      stopped_ = !progress_({ "opening tiles", done_, tiles_, 0.5 * part,
        std::chrono::duration<double>(now - begin_).count() });
    }
    return !stopped_;
  }
  bool stopped() const { return stopped_; }

private:
  const ProgressFunction& progress_;
  const std::size_t tiles_;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::size_t done_ = 0;
  std::chrono::steady_clock::time_point told_ = begin_;
  std::atomic<bool> stopped_{ false };
};
} // namespace

std::string relativeAddress(const std::string& collection, const std::string& path)
{
  if (isAddress(path))
  {
    return publicForm(path);
  }
  std::error_code failure;
  const fs::path folder = fs::absolute(folderOf(collection), failure).lexically_normal();
  const fs::path tile = fs::absolute(path, failure).lexically_normal();
  fs::path relative = tile.lexically_relative(folder);
  if (!relative.empty() && *relative.begin() == "..") // from a linked folder that leads elsewhere
  {
    relative = tile.lexically_relative(fs::weakly_canonical(folder, failure));
  }
  return relative.empty() ? tile.string() : relative.string();
}

std::string tileNameOf(const std::string& path)
{
  std::string name = fileNameOf(path);
  if (name == "ept.json")
  {
    name = fileNameOf(path.substr(0, path.rfind('/')));
  }
  for (const char* const ending : { ".copc.laz", ".pfront", ".pfindex", ".laz", ".las" })
  {
    const std::string_view end(ending);
    if (name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0)
    {
      return name.substr(0, name.size() - end.size());
    }
  }
  return name;
}

Result<void> checkAddresses(const std::string& collection, const std::vector<TileRequest>& requests)
{
  for (const TileRequest& request : requests)
  {
    const std::string address = relativeAddress(collection, request.path);
    if (isAddress(address) && address.find('?') != std::string::npos) // it hides something
    {
      return makeError(Error::Kind::BadArgument,
        collection + ": '" + address +
          "' stands for an address with a user, a password, a query or settings of its own; the "
          "collection's file would have to hold that for all who read it, secrets included: name "
          "an address without, and give headers or a token by the environment "
          "(POINTFRONT_HTTP_HEADERS)");
    }
  }
  return {};
}

Result<OpenedTiles> openTiles(const std::string& collection,
  const std::vector<TileRequest>& requests, const ProgressFunction& progress)
{
  raiseOpenFiles(requests.size());
  std::vector<Result<IncomingTile>> opened(
    requests.size(), makeError(Error::Kind::Cancelled, "cancelled"));
  const std::function<bool()> stopped = StopOfReads::carry();
  OpeningProgress display(progress, requests.size());
  ThreadCrew::ofProcess().run(requests.size(),
    [&](std::size_t i, unsigned)
    {
      const StopOfReads stop(stopped);
      if (!display.stopped())
      {
        opened[i] = openTile(collection, requests[i]);
        static_cast<void>(display.opened());
      }
    });
  OpenedTiles all;
  std::string faults;
  std::size_t faulty = 0;
  const Error* first = nullptr;
  for (std::size_t i = 0; i < opened.size(); ++i)
  {
    Result<IncomingTile>& tile = opened[i];
    if (tile && isEmpty(*tile->cloud))
    {
      all.empty.push_back(publicForm(requests[i].path));
    }
    else if (tile)
    {
      all.tiles.push_back(std::move(*tile));
    }
    else if (tile.error().kind == Error::Kind::Cancelled)
    {
      return tile.error();
    }
    else
    {
      first = first == nullptr ? &tile.error() : first;
      faults += ++faulty > mostNamed ? "" : (faults.empty() ? "" : "; ") + tile.error().what;
    }
  }
  if (faulty > 0)
  {
    return makeError(first->kind,
      collection + ": " + std::to_string(faulty) + " of " + std::to_string(requests.size()) +
        " tiles cannot be taken in: " + faults + (faulty > mostNamed ? "; and others" : ""));
  }
  if (all.tiles.empty() && !all.empty.empty())
  {
    return makeError(Error::Kind::BadArgument, collection + ": " + all.warning());
  }
  return all;
}

std::string OpenedTiles::warning() const
{
  std::string names;
  for (std::size_t i = 0; i < std::min(empty.size(), mostNamed); ++i)
  {
    names += (i == 0 ? "'" : ", '") + empty[i] + "'";
  }
  return empty.empty()
    ? std::string()
    : std::to_string(empty.size()) + " of " + std::to_string(empty.size() + tiles.size()) +
      (tiles.size() + empty.size() == 1 ? " tile" : " tiles") +
      (empty.size() == 1 ? " has no points and is left out: "
                         : " have no points and are left out: ") +
      names + (empty.size() > mostNamed ? " and others" : "");
}

Result<void> checkSystems(const std::string& collection, const std::vector<IncomingTile>& tiles,
  const std::string& known, const SameSystem& same)
{
  std::string first = known;
  std::string firstOf = "the collection";
  std::string equal; // another text of the same system
  for (const IncomingTile& tile : tiles)
  {
    const StoreDescription& is = tile.cloud->description();
    const std::string system = projectionOf(is);
    if (system.empty() || system == first || system == equal)
    {
      continue;
    }
    if (first.empty())
    {
      first = system;
      firstOf = "'" + is.path + "'";
    }
    else if (same && same(first, system))
    {
      equal = system;
    }
    else
    {
      return makeError(Error::Kind::BadArgument,
        collection + ": '" + is.path + "' names another coordinate reference system than " +
          firstOf + "; a collection has one: build the tile with --crs, or leave it out");
    }
  }
  return {};
}

namespace
{
/// Files whose 16-bit colours have 8 bits are another kind than those that have 16.
void markEightBits(StoreDescription& kind)
{
  if (const auto colour = wideColourColumn(kind.schema))
  {
    for (std::array<double, 2>& ends : kind.ranges[*colour].components)
    {
      ends = { 0.0, 255.0 };
    }
  }
}
} // namespace

CollectedTile IncomingTile::facts(std::vector<StoreDescription>& kinds) const
{
  const StoreDescription& own = cloud->description();
  CollectedTile tile;
  tile.is = is;
  tile.grid = own.grid;
  tile.bounds = own.bounds;
  tile.pointCount = own.pointCount;
  tile.wholeCount = own.wholeCount;
  tile.fileBytes = own.fileBytes;
  tile.levels = own.levels;
  StoreDescription kind = own;
  kind.path.clear();
  kind.warnings.clear();
  kind.grid = QuantisationGrid();
  kind.levels = 0;
  kind.metadata.erase(std::remove_if(kind.metadata.begin(), kind.metadata.end(),
                        [](const auto& record) {
                          return record.owner != "LASF_Projection" && record.owner != lasKeptOwner;
                        }),
    kind.metadata.end());
  const HeldColours held = heldColours(own);
  for (ColumnRange& range : kind.ranges)
  {
    for (std::array<double, 2>& ends : range.components)
    {
      tile.ranges.push_back(std::exchange(ends, { 0.0, 0.0 }));
    }
  }
  held == HeldColours::Eight ? markEightBits(kind) : void();
  for (Layer& layer : kind.layers)
  {
    tile.layers.emplace_back(std::exchange(layer.pointCount, 0), std::exchange(layer.nodeCount, 0));
  }
  const auto same = [&](const StoreDescription& known)
  {
    return known.version == kind.version && known.rangesAreSampled == kind.rangesAreSampled &&
      known.computed == kind.computed &&
      encodeDescription({ known, {}, {} }) == encodeDescription({ kind, {}, {} });
  };
  auto found = std::find_if(kinds.begin(), kinds.end(), same);
  if (found == kinds.end())
  {
    found = kinds.insert(kinds.end(), std::move(kind));
  }
  tile.kind = static_cast<std::uint32_t>(found - kinds.begin());
  const Hierarchy& table = *cloud->hierarchy();
  tile.nodes = table.nodeCount();
  const Node last = table.node(tile.nodes - 1);
  tile.ownPoints = last.firstPoint + last.pointCount;
  for (const NodeIndex root : table.roots())
  {
    tile.roots.push_back({ root, table.node(root), 0 });
  }
  return tile;
}

void chooseHeads(CollectedTile& tile, const HeadSizes& sizes)
{
  constexpr double fewest = 16.0;
  for (TileRoot& root : tile.roots)
  {
    const double part =
      static_cast<double>(root.row.pointsBelow) / static_cast<double>(tile.pointCount);
    const auto share = static_cast<std::uint32_t>(std::max(fewest, part * sizes.ofTile));
    root.head = std::min(share, root.row.pointCount / 2);
  }
}

Result<std::vector<TileHead>> readHeads(const IncomingTile& tile,
  const std::vector<TileRoot>& roots, const TileDescription::Part& part,
  const AttributeSchema& whole)
{
  ColumnSelection all(whole.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<TileHead> heads;
  for (std::size_t r = 0; r < roots.size(); ++r)
  {
    Result<NodeColumns> node = tile.cloud->read(roots[r].node, part.columns.own(all));
    if (!node)
    {
      return node.error();
    }
    NodeColumns head = sliced(*node, 0, roots[r].head, tile.cloud->description().schema);
    part.columns.adapt(head, all, whole);
    if (Result<void> placed = part.placing.place(head, tile.cloud->description().path); !placed)
    {
      return placed.error();
    }
    auto leaf = HeadItem::leafOf(tile.is.id, static_cast<std::uint32_t>(r), roots[r].row);
    heads.push_back({ std::move(leaf), HeadPoints::of(head, whole, tile.is.id), 0 });
  }
  return heads;
}

} // namespace pointfront
