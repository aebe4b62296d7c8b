#include "pointfront/Ingest/BlockCells.h"

#include "pointfront/Records/MortonOrder.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::size_t recordsPerRun = 64;
constexpr std::size_t fewRuns = 64;
} // namespace

void BlockCells::begin(std::size_t records)
{
  numbers_.resize(std::max(numbers_.size(), records));
  // A table as large as the last block needed: one block all over the cloud would else leave all
  // that follow one that no cache holds.
  std::size_t slots = leastSlots;
  while (slots < 4 * met_)
  {
    slots *= 2;
  }
  slots_.assign(slots, 0u);
  met_ = 0;
  cells_.clear();
  records_ = 0;
  last_.fill(Last{});
  runShift_ = shift_;
}

std::uint32_t BlockCells::numberOf(const CellRun& wanted, std::vector<CellRun>& cells)
{
  if (2 * cells.size() >= slots_.size())
  {
    slots_.assign(2 * slots_.size(), 0u);
    const std::vector<CellRun> known = std::move(cells);
    cells.clear();
    for (const CellRun& cell : known)
    {
      numberOf(cell, cells); // gets the number that it had
    }
  }
  CellPlace place(wanted.cell, wanted.objectClass, slots_.size());
  for (; slots_[place.slot()] != 0; place.next())
  {
    const CellRun& known = cells[slots_[place.slot()] - 1];
    if (known.cell == wanted.cell && known.objectClass == wanted.objectClass)
    {
      return slots_[place.slot()] - 1;
    }
  }
  cells.push_back(wanted);
  slots_[place.slot()] = static_cast<std::uint32_t>(cells.size());
  return slots_[place.slot()] - 1;
}

void BlockCells::countInto(ClassCounts& counts) const
{
  for (const CellRun& cell : cells_)
  {
    counts.add(cell.objectClass,
      { cell.cell.x << shift_, cell.cell.y << shift_, cell.cell.z << shift_ }, cell.count);
  }
}

/// Twice as large cells; the records' numbers are changed later, once.
void BlockCells::coarsen()
{
  std::vector<std::uint32_t> coarse(cells_.size());
  std::iota(coarse.begin(), coarse.end(), 0u);
  const std::size_t most = std::max(fewRuns, records_ / recordsPerRun);
  while (cells_.size() > most && runShift_ < 31)
  {
    std::fill(slots_.begin(), slots_.end(), 0u);
    std::vector<CellRun> larger;
    std::vector<std::uint32_t> numberIn(cells_.size());
    for (std::size_t i = 0; i < cells_.size(); ++i)
    {
      CellRun cell = cells_[i];
      cell.cell = { cell.cell.x >> 1, cell.cell.y >> 1, cell.cell.z >> 1 };
      const std::uint32_t count = std::exchange(cell.count, 0u);
      numberIn[i] = numberOf(cell, larger);
      larger[numberIn[i]].count += count;
    }
    cells_ = std::move(larger);
    ++runShift_;
    for (std::uint32_t& number : coarse)
    {
      number = numberIn[number];
    }
  }
  if (runShift_ != shift_)
  {
    for (std::size_t i = 0; i < records_; ++i)
    {
      numbers_[i] = coarse[numbers_[i]];
    }
  }
}

std::vector<CellRun> BlockCells::order()
{
  met_ = cells_.size();
  coarsen();
  std::vector<std::uint32_t> sorted(cells_.size());
  std::iota(sorted.begin(), sorted.end(), 0u);
  std::sort(sorted.begin(), sorted.end(),
    [this](std::uint32_t a, std::uint32_t b)
    {
      const CellRun& p = cells_[a];
      const CellRun& q = cells_[b];
      return p.objectClass != q.objectClass ? p.objectClass < q.objectClass
                                            : mortonLess(p.cell, q.cell);
    });
  std::vector<CellRun> runs;
  runs.reserve(cells_.size());
  places_.resize(cells_.size());
  std::uint32_t place = 0;
  for (const std::uint32_t number : sorted)
  {
    runs.push_back(cells_[number]);
    places_[number] = place;
    place += cells_[number].count;
  }
  return runs;
}

void BlockCells::scatter(const std::byte* records, std::size_t recordBytes, std::byte* to)
{
  for (std::size_t i = 0; i < records_; ++i, records += recordBytes)
  {
    copyRecord(to + std::size_t(places_[numbers_[i]]++) * recordBytes, records, recordBytes);
  }
}

} // namespace pointfront
