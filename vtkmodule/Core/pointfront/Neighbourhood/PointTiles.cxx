#include "pointfront/Neighbourhood/PointTiles.h"

#include "pointfront/Neighbourhood/PointReading.h"
#include "pointfront/Threads/WorkerThread.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <unistd.h>

namespace pointfront
{
namespace
{
/// More copies than that of each point are a mistake of the user's, not a plan.
constexpr double mostRecordsPerPoint = 12.0;
/// Records that a thread collects before it sorts them by tile and writes them.
constexpr std::size_t blockRecords = 1u << 16;

/// About a thousand for a tile: enough to cut it evenly, few enough to be counted in a cache.
std::size_t mostCells(std::uint64_t points)
{
  return static_cast<std::size_t>(std::clamp<std::uint64_t>(points / 128, 1u << 12, 1u << 18));
}

/// A fine cell to begin with: 2^-16 of the extent of the first chunk that has an extent.
Result<int> firstEdgeLog2(const PointSources& sources, const InputOrder& order)
{
  PointBatch batch;
  for (std::uint64_t number = 0; number < order.chunks(); ++number)
  {
    const SourceChunk chunk = order.chunk(number);
    if (Result<void> done = sources[chunk.source]->read(chunk.chunk, batch); !done)
    {
      return done.error();
    }
    Bounds bounds;
    for (const glm::dvec3& p : batch.positions)
    {
      if (hasPlace(p))
      {
        bounds.add(p);
      }
    }
    const glm::dvec3 size = bounds.empty() ? glm::dvec3(0.0) : bounds.size();
    if (const double extent = std::max({ size.x, size.y, size.z }); extent > 0.0)
    {
      return std::max(-20, std::ilogb(extent) - 16);
    }
  }
  return -20;
}
} // namespace

std::uint64_t memoryOf(const PassResources& resources)
{
  return resources.memoryBytes > 0
    ? resources.memoryBytes
    : std::uint64_t(sysconf(_SC_PHYS_PAGES)) * std::uint64_t(sysconf(_SC_PAGESIZE)) / 2;
}

unsigned threadsOf(const PassResources& resources)
{
  return threadsOr(resources.threads);
}

/// One run over all sources that puts every point where it belongs.
class PointTiles::Distribution
{
public:
  Distribution(PointTiles& tiles, PointReading& reading, WorkCrew& crew)
    : tiles_(tiles)
    , reading_(reading)
    , crew_(crew)
    , ownCursor_(tiles.count())
    , haloCursor_(tiles.count())
  {
    for (std::size_t t = 0; t < tiles.count(); ++t)
    {
      ownCursor_[t] = tiles.begin_[t];
      haloCursor_[t] = tiles.begin_[t] + tiles.layout_->tiles()[t].points;
    }
  }

  /// The work of one thread.
  Result<void> work();
  /// After the last thread.
  void finish();

private:
  struct Placed
  {
    std::uint32_t tile;
    bool own;
    TilePoint point;
  };
  void place(const TilePoint& point, std::vector<Placed>& block) const;
  Result<void> write(std::vector<Placed>& block);
  Result<void> writeRun(std::size_t tile, bool own, const TilePoint* points, std::size_t count);

  PointTiles& tiles_;
  PointReading& reading_;
  WorkCrew& crew_;
  std::vector<std::atomic<std::uint64_t>> ownCursor_;
  std::vector<std::atomic<std::uint64_t>> haloCursor_;
  std::mutex extents_;
};

Result<void> PointTiles::Distribution::work()
{
  std::vector<Placed> block;
  block.reserve(blockRecords);
  PointReading::Chunk chunk;
  while (!crew_.stopped())
  {
    Result<bool> more = reading_.next(chunk);
    if (!more)
    {
      return more.error();
    }
    if (!*more)
    {
      break;
    }
    for (const TilePoint& point : chunk.points)
    {
      place(point, block);
    }
    if (block.size() >= blockRecords)
    {
      if (Result<void> done = write(block); !done)
      {
        return done;
      }
    }
    crew_.advance(chunk.read);
  }
  return write(block);
}

void PointTiles::Distribution::place(const TilePoint& point, std::vector<Placed>& block) const
{
  const TileLayout& layout = *tiles_.layout_;
  const std::size_t own = layout.tileOf(point.position);
  block.push_back({ static_cast<std::uint32_t>(own), true, point });
  if (layout.isInner(point.position, own) || !tiles_.participants_.references[point.objectClass()])
  {
    return;
  }
  layout.forEachGathering(point.position, point.position,
    [&](std::size_t tile)
    {
      if (tile != own)
      {
        block.push_back({ static_cast<std::uint32_t>(tile), false, point });
      }
    });
}

/// Brings what goes to one place together, in the order it came, by counting: own points of tile t
/// are kind 2 t, its halo is kind 2 t + 1.
Result<void> PointTiles::Distribution::write(std::vector<Placed>& block)
{
  const auto kindOf = [](const Placed& placed)
  { return 2 * std::size_t(placed.tile) + (placed.own ? 0 : 1); };
  std::vector<std::size_t> end(2 * tiles_.count() + 1);
  std::vector<ReferenceExtent> extents(tiles_.count());
  for (const Placed& placed : block)
  {
    ++end[kindOf(placed) + 1];
    if (placed.own && tiles_.participants_.references[placed.point.objectClass()])
    {
      extents[placed.tile].bounds.add(placed.point.position);
      ++extents[placed.tile].points;
    }
  }
  std::partial_sum(end.begin(), end.end(), end.begin());
  std::vector<TilePoint> points(block.size());
  for (const Placed& placed : block) // the first point of a kind moves on to its end
  {
    points[end[kindOf(placed)]++] = placed.point;
  }
  std::size_t begin = 0;
  for (std::size_t kind = 0; kind < 2 * tiles_.count(); ++kind)
  {
    const TilePoint* const run = points.data() + begin;
    if (Result<void> done = writeRun(kind / 2, kind % 2 == 0, run, end[kind] - begin); !done)
    {
      return done;
    }
    begin = end[kind];
  }
  block.clear();
  const std::lock_guard<std::mutex> lock(extents_);
  for (std::size_t t = 0; t < extents.size(); ++t)
  {
    tiles_.extents_[t].bounds.add(extents[t].bounds);
    tiles_.extents_[t].points += extents[t].points;
  }
  return {};
}

Result<void> PointTiles::Distribution::writeRun(
  std::size_t tile, bool own, const TilePoint* points, std::size_t count)
{
  if (count == 0)
  {
    return {};
  }
  const std::uint64_t at = (own ? ownCursor_ : haloCursor_)[tile].fetch_add(count);
  const std::uint64_t end =
    own ? tiles_.begin_[tile] + tiles_.layout_->tiles()[tile].points : tiles_.begin_[tile + 1];
  if (at + count > end)
  {
    return makeError(Error::Kind::Corrupt,
      "an input gave other points when it was read a second time; is it being written to?");
  }
  return tiles_.pool_->write(at, count, reinterpret_cast<const std::byte*>(points));
}

void PointTiles::Distribution::finish()
{
  for (std::size_t t = 0; t < tiles_.count(); ++t)
  {
    tiles_.ownCount_.push_back(ownCursor_[t] - tiles_.begin_[t]);
    tiles_.haloCount_.push_back(
      haloCursor_[t] - tiles_.begin_[t] - tiles_.layout_->tiles()[t].points);
  }
}

Result<std::unique_ptr<PointTiles>> PointTiles::make(const PointSources& sources,
  const InputOrder& order, const TilingOptions& tiling, const Participants& participants,
  const PassResources& resources, WorkCrew& crew, double weight)
{
  const Result<int> edgeLog2 = firstEdgeLog2(sources, order);
  if (!edgeLog2)
  {
    return edgeLog2.error();
  }
  CellHistogram histogram(*edgeLog2, tiling.axes, mostCells(order.points()));
  std::mutex adding;
  PointReading counting(sources, order, participants.queries | participants.references);
  crew.beginPhase("cutting into tiles", order.points(), weight);
  const auto count = [&]() -> Result<void>
  {
    CellHistogram mine(*edgeLog2, tiling.axes, mostCells(order.points()));
    PointReading::Chunk chunk;
    while (!crew.stopped())
    {
      Result<bool> more = counting.next(chunk);
      if (!more || !*more)
      {
        const std::lock_guard<std::mutex> lock(adding);
        histogram.add(mine);
        return more ? Result<void>() : Result<void>(more.error());
      }
      for (const TilePoint& point : chunk.points)
      {
        mine.add(point.position);
      }
      crew.advance(chunk.read);
    }
    return {};
  };
  if (Result<void> done = crew.run(count); !done)
  {
    return done.error();
  }
  std::unique_ptr<PointTiles> tiles(new PointTiles(participants));
  tiles->layout_ = std::make_unique<TileLayout>(histogram, tiling);
  if (Result<void> done = tiles->placeTiles(resources); !done)
  {
    return done.error();
  }
  PointReading reading(sources, order, participants.queries | participants.references);
  Distribution distribution(*tiles, reading, crew);
  crew.beginPhase("distributing", order.points(), weight);
  if (Result<void> done = crew.run([&] { return distribution.work(); }); !done)
  {
    return done.error();
  }
  distribution.finish();
  return tiles;
}

Result<void> PointTiles::placeTiles(const PassResources& resources)
{
  std::uint64_t points = 0;
  std::uint64_t records = 0;
  for (const Tile& tile : layout_->tiles())
  {
    begin_.push_back(records);
    records += std::max(tile.points, tile.mostGathered);
    points += tile.points;
  }
  begin_.push_back(records);
  extents_.resize(layout_->tiles().size());
  if (static_cast<double>(records) > mostRecordsPerPoint * static_cast<double>(points) + 1e6)
  {
    return makeError(Error::Kind::BadArgument,
      "the neighbourhoods are so wide that each point would be copied " +
        std::to_string(records / std::max<std::uint64_t>(1, points)) +
        " times; choose a smaller radius");
  }
  if (records * sizeof(TilePoint) <= memoryOf(resources) / 2)
  {
    pool_ = RecordPool::inMemory(records, sizeof(TilePoint));
    return {};
  }
  const std::string folder = resources.temporaryFolder.empty()
    ? std::filesystem::temp_directory_path().string()
    : resources.temporaryFolder;
  auto spilled = RecordPool::spilled(folder, records, sizeof(TilePoint));
  if (!spilled)
  {
    return spilled.error();
  }
  pool_ = std::move(*spilled);
  return {};
}

Result<unsigned> PointTiles::threadsFor(
  std::uint64_t pointBytes, const PassResources& resources) const
{
  std::uint64_t largest = 0;
  for (const Tile& tile : layout_->tiles())
  {
    largest = std::max({ largest, tile.points, tile.mostGathered });
  }
  const std::uint64_t memory = memoryOf(resources) / 2;
  const std::uint64_t tileBytes = std::max<std::uint64_t>(1, largest * pointBytes);
  if (tileBytes > memory)
  {
    return makeError(Error::Kind::NoMemory,
      "a memory limit of " + std::to_string(memoryOf(resources) >> 20) +
        " MiB is too small for neighbourhoods: the densest piece of the cloud needs " +
        std::to_string((2 * tileBytes >> 20) + 1) + " MiB");
  }
  return static_cast<unsigned>(
    std::clamp<std::uint64_t>(memory / tileBytes, 1, threadsOf(resources)));
}

Result<GatheredPoints> PointTiles::gathered(std::size_t tile) const
{
  GatheredPoints result;
  result.own = ownCount_[tile];
  result.points.resize(ownCount_[tile] + haloCount_[tile]);
  auto* bytes = reinterpret_cast<std::byte*>(result.points.data());
  Result<void> done = pool_->read(begin_[tile], ownCount_[tile], bytes);
  if (done)
  {
    done = pool_->read(begin_[tile] + layout_->tiles()[tile].points, haloCount_[tile],
      bytes + ownCount_[tile] * sizeof(TilePoint));
  }
  if (!done)
  {
    return done.error();
  }
  return result;
}

Result<std::vector<TilePoint>> PointTiles::own(std::size_t tile) const
{
  std::vector<TilePoint> points(ownCount_[tile]);
  Result<void> done =
    pool_->read(begin_[tile], points.size(), reinterpret_cast<std::byte*>(points.data()));
  if (!done)
  {
    return done.error();
  }
  return points;
}

} // namespace pointfront
