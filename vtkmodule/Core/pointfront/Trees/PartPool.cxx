#include "pointfront/Trees/PartPool.h"

#include "pointfront/Base/CpuClock.h"
#include "pointfront/Records/MortonOrder.h"

#include <algorithm>

namespace pointfront
{
namespace
{
/// The part of each counted cell, plus one; parts are numbered from `first` on.
CellTable partTable(const std::vector<CountedCell>& cells, unsigned shift,
  const std::vector<std::uint32_t>& partOf, std::uint32_t first)
{
  CellTable table(shift);
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    table.at(table.cellOf(cells[i].origin)) = first + partOf[i] + 1ull;
  }
  return table;
}
} // namespace

PartPool::PartPool(
  RecordPool& pool, std::size_t recordBytes, const MemoryPlan& plan, WorkCrew& crew)
  : sorter_(pool, recordBytes, plan, crew)
{
}

Result<void> PartPool::build(const PoolPreparation& points, ClassCounts counts)
{
  points_ = &points;
  const unsigned coarsest = points.rootLog2 > rootCellsLog2 ? points.rootLog2 - rootCellsLog2 : 0;
  if (counts.shift() > coarsest) // the declared bounds were far too large
  {
    auto again = sorter_.count(points, coarsest > 4 ? coarsest - 4 : 0, coarsest);
    if (!again)
    {
      return again.error();
    }
    counts = std::move(*again);
  }
  const BucketTables buckets = cut(points, counts);
  auto pieces = sorter_.sort(points, buckets, partition_->partCount());
  if (!pieces)
  {
    return pieces.error();
  }
  pieces_ = std::move(*pieces);
  for (std::uint32_t part = 0; part < partition_->partCount() && !sorter_.crew().stopped(); ++part)
  {
    while (partition_->part(part).count > sorter_.plan().partPoints)
    {
      if (Result<void> done = refine(part); !done)
      {
        return done;
      }
    }
  }
  return sorter_.crew().outcome();
}

/// One octree a layer; their parts are numbered through.
BucketTables PartPool::cut(const PoolPreparation& points, const ClassCounts& counts)
{
  BucketTables buckets;
  partition_.emplace();
  for (const auto& [objectClass, table] : counts.classes())
  {
    const std::vector<CountedCell> cells = countedCells(table, points.space);
    std::vector<std::uint32_t> partOf;
    const Partition layer(cells, table.shift(), sorter_.plan().partPoints, partOf);
    buckets.push_back(partTable(cells, table.shift(), partOf, partition_->partCount()));
    partition_->append(layer);
  }
  return buckets;
}

Result<void> PartPool::refine(std::uint32_t part)
{
  const CpuStopwatch watch(seconds_);
  const OctreeCell cell = partition_->part(part).cell;
  if (cell.log2Side == 0)
  {
    refineByOrder(part);
    return {};
  }
  constexpr unsigned finerBits = 9;
  CellCounts counts(cell.log2Side > finerBits ? cell.log2Side - finerBits : 0);
  RunSorter sorter(sorter_.pool(), sorter_.recordBytes());
  const std::vector<Piece> runs = std::move(pieces_[part]);
  for (const Piece& run : runs)
  {
    if (Result<void> done = sorter.load(run); !done)
    {
      return done;
    }
    for (std::uint64_t i = 0; i < run.count; ++i)
    {
      counts.add(points_->space.relativeSteps(positionOf(sorter.record(i))));
    }
  }
  const std::vector<CountedCell> cells =
    countedCells(counts.table(), TreeSpace()); // relative to the root
  std::vector<std::uint32_t> partOf;
  const Partition finer(cells, counts.table().shift(), sorter_.plan().partPoints, partOf);
  const ClassLayers layer; // the part's layer: there is no other in it
  const BucketTables table{ partTable(cells, counts.table().shift(), partOf, 0) };
  const std::vector<std::uint32_t> numbers = partition_->refine(part, finer);
  pieces_.resize(partition_->partCount());
  pieces_[part].clear();
  for (const Piece& run : runs)
  {
    if (Result<void> done = sorter.load(run); !done)
    {
      return done;
    }
    auto pieces = sorter.sort(finer.partCount(), BucketFinder(table, layer, points_->space));
    if (!pieces)
    {
      return pieces.error();
    }
    for (const PartPiece& piece : *pieces)
    {
      pieces_[numbers[piece.part]].push_back(piece.piece);
    }
  }
  return {};
}

void PartPool::refineByOrder(std::uint32_t part)
{
  const std::vector<Piece> all = std::move(pieces_[part]);
  const std::vector<std::uint32_t> numbers = partition_->refineByOrder(part);
  pieces_.resize(partition_->partCount());
  pieces_[part].clear();
  std::size_t next = 0;
  Piece rest;
  for (const std::uint32_t number : numbers)
  {
    std::uint64_t missing = partition_->part(number).count;
    while (missing > 0)
    {
      if (rest.count == 0)
      {
        rest = all[next++];
      }
      const std::uint64_t taken = std::min(missing, rest.count);
      pieces_[number].push_back({ rest.first, taken });
      rest.first += taken;
      rest.count -= taken;
      missing -= taken;
    }
  }
}

Result<std::vector<std::byte>> PartPool::load(std::uint32_t part) const
{
  return sorter_.load(*points_, pieces_[part]);
}

} // namespace pointfront
