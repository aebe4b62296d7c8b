#include "pointfront/Build/PartPool.h"

#include "pointfront/Build/CpuClock.h"
#include "pointfront/Build/MortonOrder.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <mutex>

namespace pointfront
{
namespace
{
struct PartPiece
{
  std::uint32_t part = 0;
  Piece piece;
};

/// Sorts runs of the pool by part, in place and stable. One instance a thread.
class RunSorter
{
public:
  RunSorter(RecordPool& pool, std::size_t recordBytes) : pool_(pool), recordBytes_(recordBytes) {}

  Result<void> load(const Piece& run)
  {
    run_ = run;
    in_.resize(run.count * recordBytes_);
    return pool_.read(run.first, run.count, in_.data());
  }
  std::byte* record(std::uint64_t i) { return in_.data() + i * recordBytes_; }

  /// `partOf(position)` for each record of the loaded run; gives the pieces in part order.
  template <typename PartOf>
  Result<std::vector<PartPiece>> sort(std::uint32_t partCount, const PartOf& partOf)
  {
    parts_.resize(run_.count);
    starts_.assign(partCount + 1, 0);
    for (std::uint64_t i = 0; i < run_.count; ++i)
    {
      parts_[i] = partOf(positionOf(record(i)));
      ++starts_[parts_[i] + 1];
    }
    std::vector<PartPiece> pieces;
    for (std::uint32_t part = 0; part < partCount; ++part)
    {
      if (const std::uint64_t count = starts_[part + 1]; count > 0)
      {
        pieces.push_back({part, {run_.first + starts_[part], count}});
      }
      starts_[part + 1] += starts_[part];
    }
    if (pieces.size() == 1)
    {
      out_ = in_;
    }
    else
    {
      scatter();
    }
    if (Result<void> done = pool_.write(run_.first, run_.count, out_.data()); !done)
    {
      return done.error();
    }
    return pieces;
  }

private:
  void scatter()
  {
    out_.resize(in_.size());
    for (std::uint64_t i = 0; i < run_.count; ++i)
    {
      std::memcpy(out_.data() + starts_[parts_[i]]++ * recordBytes_, record(i), recordBytes_);
    }
  }

  RecordPool& pool_;
  std::size_t recordBytes_;
  Piece run_;
  std::vector<std::byte> in_;
  std::vector<std::byte> out_;
  std::vector<std::uint32_t> parts_;
  std::vector<std::uint64_t> starts_;
};

void widen(RunSorter& sorter, const Piece& block, const ColourWidening& widening)
{
  for (const Piece& run : widening.runs)
  {
    const std::uint64_t begin = std::max(block.first, run.first);
    const std::uint64_t end = std::min(block.first + block.count, run.first + run.count);
    for (std::uint64_t i = begin; i < end; ++i)
    {
      std::byte* colour = sorter.record(i - block.first) + widening.offset;
      for (std::size_t k = 0; k < widening.components; ++k)
      {
        std::uint16_t value;
        std::memcpy(&value, colour + 2 * k, sizeof(value));
        value = static_cast<std::uint16_t>(value * 257u);
        std::memcpy(colour + 2 * k, &value, sizeof(value));
      }
    }
  }
}

/// Counted cells in Morton order. `move` takes a cell's lowest position to where it is in the tree.
template <typename Move>
std::vector<CountedCell> countedCells(const CellTable& table, const Move& move)
{
  std::vector<CountedCell> cells;
  for (const CellTable::Entry& entry : table.entries())
  {
    const unsigned shift = table.shift();
    const TreePosition low{entry.cell.x << shift, entry.cell.y << shift, entry.cell.z << shift};
    cells.push_back({move(low), entry.value});
  }
  std::sort(cells.begin(), cells.end(),
    [](const CountedCell& a, const CountedCell& b) { return mortonLess(a.origin, b.origin); });
  return cells;
}

/// The part of each counted cell, plus one.
CellTable partTable(
  const std::vector<CountedCell>& cells, unsigned shift, const std::vector<std::uint32_t>& partOf)
{
  CellTable table(shift);
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    table.at(table.cellOf(cells[i].origin)) = partOf[i] + 1ull;
  }
  return table;
}

/// Finds parts of neighbouring points without a look-up each.
class PartFinder
{
public:
  explicit PartFinder(const CellTable& table) : table_(table) {}
  std::uint32_t operator()(const TreePosition& position) const
  {
    const TreePosition cell = table_.cellOf(position);
    if (part_ == 0 || cell != cell_)
    {
      cell_ = cell;
      part_ = table_.find(cell);
    }
    return static_cast<std::uint32_t>(part_ - 1);
  }

private:
  const CellTable& table_;
  mutable TreePosition cell_{0};
  mutable std::uint64_t part_ = 0;
};
} // namespace

PartPool::PartPool(
  RecordPool& pool, std::size_t recordBytes, const MemoryPlan& plan, WorkCrew& crew)
    : pool_(pool), recordBytes_(recordBytes), plan_(plan), crew_(crew)
{
}

Result<void> PartPool::build(const IngestedPoints& points, const TreeSpace& space,
  unsigned rootLog2, const std::optional<ColourWidening>& widening)
{
  const unsigned coarsest = rootLog2 > rootCellsLog2 ? rootLog2 - rootCellsLog2 : 0;
  Result<CellCounts> counts = points.counts;
  if (points.counts.table().shift() > coarsest) // the declared bounds were far too large
  {
    counts = countAgain(points.kept, coarsest);
  }
  if (!counts)
  {
    return counts.error();
  }
  const std::vector<CountedCell> cells = countedCells(
    counts->table(), [&](const TreePosition& low) { return space.relativeSteps(low); });
  std::vector<std::uint32_t> partOf;
  const unsigned cellLog2 = counts->table().shift();
  partition_.emplace(cells, cellLog2, plan_.partPoints, partOf);
  pieces_.resize(partition_->partCount());
  const CellTable table = partTable(cells, cellLog2, partOf);
  if (Result<void> done = sortBlocks(points.kept, space, widening, table); !done)
  {
    return done;
  }
  for (std::uint32_t part = 0; part < partition_->partCount() && !crew_.stopped(); ++part)
  {
    while (partition_->part(part).count > plan_.partPoints)
    {
      if (Result<void> done = refine(part); !done)
      {
        return done;
      }
    }
  }
  return crew_.outcome();
}

Result<CellCounts> PartPool::countAgain(std::uint64_t points, unsigned shift)
{
  std::atomic<std::uint64_t> next{0};
  std::mutex mutex;
  const unsigned finer = shift > 4 ? shift - 4 : 0;
  CellCounts all(finer);
  const auto work = [&]() -> Result<void>
  {
    CellCounts own(finer);
    RunSorter run(pool_, recordBytes_);
    for (std::uint64_t first = next.fetch_add(plan_.blockPoints);
         first < points && !crew_.stopped(); first = next.fetch_add(plan_.blockPoints))
    {
      const std::uint64_t count = std::min(plan_.blockPoints, points - first);
      if (Result<void> done = run.load({first, count}); !done)
      {
        return done;
      }
      for (std::uint64_t i = 0; i < count; ++i)
      {
        own.add(positionOf(run.record(i)));
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

Result<void> PartPool::sortBlocks(std::uint64_t points, const TreeSpace& space,
  const std::optional<ColourWidening>& widening, const CellTable& partOf)
{
  const std::uint64_t blocks = (points + plan_.blockPoints - 1) / plan_.blockPoints;
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
        b * plan_.blockPoints, std::min(plan_.blockPoints, points - b * plan_.blockPoints)};
      if (Result<void> done = sorter.load(block); !done)
      {
        return done;
      }
      for (std::uint64_t i = 0; i < block.count; ++i)
      {
        setPosition(sorter.record(i), space.relativeSteps(positionOf(sorter.record(i))));
      }
      if (widening)
      {
        widen(sorter, block, *widening);
      }
      auto pieces = sorter.sort(partition_->partCount(), PartFinder(partOf));
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
  Result<void> done = crew_.run(work);
  for (const std::vector<PartPiece>& block : sorted)
  {
    for (const PartPiece& piece : block)
    {
      pieces_[piece.part].push_back(piece.piece);
    }
  }
  return done;
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
  RunSorter sorter(pool_, recordBytes_);
  const std::vector<Piece> runs = std::move(pieces_[part]);
  for (const Piece& run : runs)
  {
    if (Result<void> done = sorter.load(run); !done)
    {
      return done;
    }
    for (std::uint64_t i = 0; i < run.count; ++i)
    {
      counts.add(positionOf(sorter.record(i)));
    }
  }
  const std::vector<CountedCell> cells =
    countedCells(counts.table(), [](const TreePosition& low) { return low; });
  std::vector<std::uint32_t> partOf;
  const Partition finer(cells, counts.table().shift(), plan_.partPoints, partOf);
  const CellTable table = partTable(cells, counts.table().shift(), partOf);
  const std::vector<std::uint32_t> numbers = partition_->refine(part, finer);
  pieces_.resize(partition_->partCount());
  pieces_[part].clear();
  for (const Piece& run : runs)
  {
    if (Result<void> done = sorter.load(run); !done)
    {
      return done;
    }
    auto pieces = sorter.sort(finer.partCount(), PartFinder(table));
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
      pieces_[number].push_back({rest.first, taken});
      rest.first += taken;
      rest.count -= taken;
      missing -= taken;
    }
  }
}

Result<std::vector<std::byte>> PartPool::load(std::uint32_t part) const
{
  std::vector<std::byte> records(partition_->part(part).count * recordBytes_);
  std::uint64_t loaded = 0;
  for (const Piece& piece : pieces_[part])
  {
    if (Result<void> done =
          pool_.read(piece.first, piece.count, records.data() + loaded * recordBytes_);
        !done)
    {
      return done.error();
    }
    loaded += piece.count;
  }
  return records;
}

} // namespace pointfront
