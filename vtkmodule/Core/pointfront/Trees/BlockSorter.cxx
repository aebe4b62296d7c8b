#include "pointfront/Trees/BlockSorter.h"

#include "pointfront/Base/CpuClock.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <map>
#include <mutex>
#include <optional>

namespace pointfront
{
namespace
{
void widen(
  std::byte* records, std::size_t recordBytes, const Piece& piece, const ColourWidening& widening)
{
  for (const Piece& run : widening.runs)
  {
    const std::uint64_t begin = std::max(piece.first, run.first);
    const std::uint64_t end = std::min(piece.first + piece.count, run.first + run.count);
    for (std::uint64_t i = begin; i < end; ++i)
    {
      widening.widen(records + (i - piece.first) * recordBytes);
    }
  }
}

constexpr std::uint64_t shared = UINT64_MAX; // by several buckets

/// The bucket, plus one, of each cell of 2^shift steps, or `shared`.
CellTable coarseBuckets(const CellTable& buckets, unsigned shift)
{
  CellTable coarse(shift);
  const unsigned bits = shift - buckets.shift();
  for (const CellTable::Entry& entry : buckets.entries())
  {
    std::uint64_t& value =
      coarse.at({ entry.cell.x >> bits, entry.cell.y >> bits, entry.cell.z >> bits });
    value = value == 0 || value == entry.value ? entry.value : shared;
  }
  return coarse;
}

/// Which buckets the runs of blocks belong to. One instance a thread.
class RunBuckets
{
public:
  RunBuckets(const BucketTables& buckets, const PoolPreparation& points)
    : buckets_(buckets)
    , points_(points)
    , coarse_(buckets.size())
  {
    if (points.layers.byClass())
    {
      for (std::size_t layer = 0; layer < buckets.size(); ++layer)
      {
        layerOf_[points.layers.classes()[layer]] = layer;
      }
    }
  }

  /// The bucket, or nothing when several share the run's cell.
  std::optional<std::uint32_t> operator()(const CellRun& run, unsigned shift)
  {
    const std::size_t layer = layerOf_[run.objectClass];
    const unsigned fine = buckets_[layer].shift();
    // A cell is one of the tree's as long as it is not larger than those of the root cube.
    if (shift > fine && shift + rootCellsLog2 > points_.rootLog2)
    {
      return std::nullopt;
    }
    const TreePosition low = points_.space.relativeSteps(
      { run.cell.x << shift, run.cell.y << shift, run.cell.z << shift });
    const CellTable& table = shift > fine ? coarse(layer, shift) : buckets_[layer];
    const std::uint64_t bucket = table.find(table.cellOf(low));
    if (bucket == shared)
    {
      return std::nullopt;
    }
    return static_cast<std::uint32_t>(bucket - 1);
  }

private:
  const CellTable& coarse(std::size_t layer, unsigned shift)
  {
    auto known = coarse_[layer].find(shift);
    if (known == coarse_[layer].end())
    {
      known = coarse_[layer].emplace(shift, coarseBuckets(buckets_[layer], shift)).first;
    }
    return known->second;
  }

  const BucketTables& buckets_;
  const PoolPreparation& points_;
  std::array<std::size_t, 256> layerOf_{};
  std::vector<std::map<unsigned, CellTable>> coarse_; // tables of each layer, by shift
};

/// Divides blocks into pieces of one bucket each. One instance a thread.
class BlockDivision
{
public:
  BlockDivision(RecordPool& pool, const BucketTables& buckets, std::uint32_t bucketCount,
    const PoolPreparation& points)
    : bucketCount_(bucketCount)
    , bucketOf_(buckets, points)
    , finder_(buckets, points.layers, points.space)
    , sorter_(pool, pool.recordBytes())
  {
  }

  Result<std::vector<PartPiece>> divide(const PoolBlock& block)
  {
    pieces_.clear();
    mixed_ = { block.first, 0 };
    for (const CellRun& run : block.runs)
    {
      const auto bucket = bucketOf_(run, block.shift);
      if (!bucket)
      {
        mixed_.count += run.count;
        continue;
      }
      if (Result<void> done = sortMixed(); !done)
      {
        return done.error();
      }
      append({ *bucket, { mixed_.first, run.count } });
      mixed_.first += run.count;
    }
    if (Result<void> done = sortMixed(); !done)
    {
      return done.error();
    }
    return std::move(pieces_);
  }

private:
  /// Pieces that follow each other in one bucket are one.
  void append(const PartPiece& piece)
  {
    if (!pieces_.empty() && pieces_.back().part == piece.part &&
      pieces_.back().piece.first + pieces_.back().piece.count == piece.piece.first)
    {
      pieces_.back().piece.count += piece.piece.count;
      return;
    }
    pieces_.push_back(piece);
  }

  Result<void> sortMixed()
  {
    if (mixed_.count == 0)
    {
      return {};
    }
    if (Result<void> done = sorter_.load(mixed_); !done)
    {
      return done;
    }
    auto sorted = sorter_.sort(bucketCount_, finder_);
    if (!sorted)
    {
      return sorted.error();
    }
    for (const PartPiece& piece : *sorted)
    {
      append(piece);
    }
    mixed_ = { mixed_.first + mixed_.count, 0 };
    return {};
  }

  std::uint32_t bucketCount_;
  RunBuckets bucketOf_;
  BucketFinder finder_;
  RunSorter sorter_;
  std::vector<PartPiece> pieces_; // pieces of the block, up to mixed_
  Piece mixed_; // runs whose buckets are not known yet
};
} // namespace

std::vector<CountedCell> countedCells(const CellTable& table, const TreeSpace& space)
{
  std::vector<CountedCell> cells;
  for (const CellTable::Entry& entry : table.entries())
  {
    const unsigned shift = table.shift();
    const TreePosition low{ entry.cell.x << shift, entry.cell.y << shift, entry.cell.z << shift };
    cells.push_back({ space.relativeSteps(low), entry.value });
  }
  std::sort(cells.begin(), cells.end(),
    [](const CountedCell& a, const CountedCell& b) { return mortonLess(a.origin, b.origin); });
  return cells;
}

Result<ClassCounts> BlockSorter::count(
  const PoolPreparation& points, unsigned finest, unsigned coarsest)
{
  std::atomic<std::uint64_t> next{ 0 };
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
      if (Result<void> done = run.load({ first, count }); !done)
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
  std::vector<std::vector<PartPiece>> sorted(points.blocks.size());
  std::atomic<std::size_t> next{ 0 };
  std::mutex mutex;
  const auto work = [&]() -> Result<void>
  {
    BlockDivision division(pool_, buckets, bucketCount, points);
    double seconds = 0.0;
    for (std::size_t b = next++; b < points.blocks.size() && !crew_.stopped(); b = next++)
    {
      const CpuStopwatch watch(seconds);
      auto pieces = division.divide(points.blocks[b]);
      if (!pieces)
      {
        return pieces.error();
      }
      sorted[b] = std::move(*pieces);
      crew_.advance(points.blocks[b].count);
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

Result<std::vector<std::byte>> BlockSorter::load(
  const PoolPreparation& points, const std::vector<Piece>& pieces) const
{
  std::uint64_t count = 0;
  for (const Piece& piece : pieces)
  {
    count += piece.count;
  }
  std::vector<std::byte> records(count * recordBytes_);
  std::byte* to = records.data();
  for (const Piece& piece : pieces)
  {
    if (Result<void> done = pool_.read(piece.first, piece.count, to); !done)
    {
      return done.error();
    }
    if (points.widening)
    {
      widen(to, recordBytes_, piece, *points.widening);
    }
    for (std::uint64_t i = 0; i < piece.count; ++i, to += recordBytes_)
    {
      setPosition(to, points.space.relativeSteps(positionOf(to)));
    }
  }
  return records;
}

} // namespace pointfront
