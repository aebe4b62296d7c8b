#include "pointfront/Build/BlockSorter.h"

#include "pointfront/Build/CpuClock.h"

#include <algorithm>
#include <atomic>
#include <mutex>

namespace pointfront
{
namespace
{
void widen(RunSorter& sorter, const Piece& block, const ColourWidening& widening)
{
  for (const Piece& run : widening.runs)
  {
    const std::uint64_t begin = std::max(block.first, run.first);
    const std::uint64_t end = std::min(block.first + block.count, run.first + run.count);
    for (std::uint64_t i = begin; i < end; ++i)
    {
      widening.widen(sorter.record(i - block.first));
    }
  }
}

} // namespace

std::vector<CountedCell> countedCells(const CellTable& table, const TreeSpace& space)
{
  std::vector<CountedCell> cells;
  for (const CellTable::Entry& entry : table.entries())
  {
    const unsigned shift = table.shift();
    const TreePosition low{entry.cell.x << shift, entry.cell.y << shift, entry.cell.z << shift};
    cells.push_back({space.relativeSteps(low), entry.value});
  }
  std::sort(cells.begin(), cells.end(),
    [](const CountedCell& a, const CountedCell& b) { return mortonLess(a.origin, b.origin); });
  return cells;
}

Result<ClassCounts> BlockSorter::count(
  const PoolPreparation& points, unsigned finest, unsigned coarsest)
{
  std::atomic<std::uint64_t> next{0};
  std::mutex mutex;
  ClassCounts all(finest, coarsest);
  const auto work = [&]() -> Result<void>
  {
    ClassCounts own(finest, coarsest);
    RunSorter run(pool_, recordBytes_);
    for (std::uint64_t first = next.fetch_add(plan_.blockPoints);
         first < points.points && !crew_.stopped(); first = next.fetch_add(plan_.blockPoints))
    {
      const std::uint64_t count = std::min(plan_.blockPoints, points.points - first);
      if (Result<void> done = run.load({first, count}); !done)
      {
        return done;
      }
      for (std::uint64_t i = 0; i < count; ++i)
      {
        const std::size_t layer = points.layers.layerOf(run.record(i));
        own.add(points.layers.classes()[layer], positionOf(run.record(i)));
      }
    }
    const std::lock_guard<std::mutex> lock(mutex);
    all.add(own);
    return {};
  };
  if (Result<void> done = crew_.run(work); !done)
  {
    return done.error();
  }
  return all;
}

Result<std::vector<std::vector<Piece>>> BlockSorter::sort(
  const PoolPreparation& points, const BucketTables& buckets, std::uint32_t bucketCount)
{
  const std::uint64_t blocks = (points.points + plan_.blockPoints - 1) / plan_.blockPoints;
  std::vector<std::vector<PartPiece>> sorted(blocks);
  std::atomic<std::uint64_t> next{0};
  std::mutex mutex;
  const auto work = [&]() -> Result<void>
  {
    RunSorter sorter(pool_, recordBytes_);
    double seconds = 0.0;
    for (std::uint64_t b = next++; b < blocks && !crew_.stopped(); b = next++)
    {
      const CpuStopwatch watch(seconds);
      const Piece block{
        b * plan_.blockPoints, std::min(plan_.blockPoints, points.points - b * plan_.blockPoints)};
      if (Result<void> done = sorter.load(block); !done)
      {
        return done;
      }
      for (std::uint64_t i = 0; i < block.count; ++i)
      {
        setPosition(sorter.record(i), points.space.relativeSteps(positionOf(sorter.record(i))));
      }
      if (points.widening)
      {
        widen(sorter, block, *points.widening);
      }
      auto pieces = sorter.sort(bucketCount, BucketFinder(buckets, points.layers));
      if (!pieces)
      {
        return pieces.error();
      }
      sorted[b] = std::move(*pieces);
      crew_.advance(block.count);
    }
    const std::lock_guard<std::mutex> lock(mutex);
    seconds_ += seconds;
    return {};
  };
  if (Result<void> done = crew_.run(work); !done)
  {
    return done.error();
  }
  std::vector<std::vector<Piece>> pieces(bucketCount);
  for (const std::vector<PartPiece>& block : sorted)
  {
    for (const PartPiece& piece : block)
    {
      pieces[piece.part].push_back(piece.piece);
    }
  }
  return pieces;
}

} // namespace pointfront
