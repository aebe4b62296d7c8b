#include "pointfront/Neighbourhood/CellHistogram.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace pointfront
{
namespace
{
constexpr std::size_t fewestSlots = 1u << 10;

std::size_t hashOf(const CellIndex& index)
{
  std::uint64_t mixed = 0;
  for (const std::int64_t i : index)
  {
    mixed = (mixed ^ static_cast<std::uint64_t>(i)) * 0x9e3779b97f4a7c15ull;
    mixed ^= mixed >> 29;
  }
  return static_cast<std::size_t>(mixed);
}
} // namespace

CellHistogram::CellHistogram(int edgeLog2, unsigned axes, std::size_t mostCells)
  : edgeLog2_(edgeLog2)
  , edge_(std::ldexp(1.0, edgeLog2))
  , axes_(axes)
  , mostCells_(mostCells)
  , slots_(fewestSlots)
{
}

/// Its count; a new cell has 0 points until the caller adds some.
std::uint64_t& CellHistogram::countOf(const CellIndex& index)
{
  if (2 * (taken_ + 1) > slots_.size())
  {
    grow();
  }
  std::size_t at = hashOf(index) & (slots_.size() - 1);
  while (slots_[at].points > 0 && slots_[at].index != index)
  {
    at = (at + 1) & (slots_.size() - 1);
  }
  if (slots_[at].points == 0)
  {
    slots_[at].index = index;
    ++taken_;
  }
  return slots_[at].points;
}

void CellHistogram::grow()
{
  const std::vector<PopulatedCell> cells = std::move(slots_);
  slots_.assign(2 * cells.size(), {});
  taken_ = 0;
  for (const PopulatedCell& cell : cells)
  {
    if (cell.points > 0)
    {
      countOf(cell.index) = cell.points;
    }
  }
}

void CellHistogram::add(const glm::dvec3& p)
{
  CellIndex index{};
  for (unsigned axis = 0; axis < axes_; ++axis)
  {
    index[axis] = static_cast<std::int64_t>(std::floor(p[static_cast<int>(axis)] / edge_));
  }
  ++points_;
  if (last_ == nullptr || index != lastIndex_)
  {
    last_ = &countOf(index); // stays where it is until the next one
    lastIndex_ = index;
  }
  ++*last_;
  while (taken_ > mostCells_)
  {
    coarsen();
  }
}

void CellHistogram::add(const CellHistogram& other)
{
  while (edgeLog2_ < other.edgeLog2_)
  {
    coarsen();
  }
  const int shift = edgeLog2_ - other.edgeLog2_;
  for (const PopulatedCell& cell : other.slots_)
  {
    if (cell.points > 0)
    {
      CellIndex mine{};
      for (std::size_t axis = 0; axis < mine.size(); ++axis)
      {
        mine[axis] = cell.index[axis] >> std::min(shift, 63);
      }
      countOf(mine) += cell.points;
    }
  }
  points_ += other.points_;
  last_ = nullptr;
  while (taken_ > mostCells_)
  {
    coarsen();
  }
}

void CellHistogram::coarsen()
{
  const std::vector<PopulatedCell> fine = std::move(slots_);
  slots_.assign(fine.size(), {});
  taken_ = 0;
  for (const PopulatedCell& cell : fine)
  {
    if (cell.points > 0)
    {
      countOf({ cell.index[0] >> 1, cell.index[1] >> 1, cell.index[2] >> 1 }) += cell.points;
    }
  }
  edge_ = std::ldexp(1.0, ++edgeLog2_);
  last_ = nullptr;
}

std::vector<PopulatedCell> CellHistogram::cells() const
{
  std::vector<PopulatedCell> all;
  all.reserve(taken_);
  std::copy_if(slots_.begin(), slots_.end(), std::back_inserter(all),
    [](const PopulatedCell& cell) { return cell.points > 0; });
  std::sort(all.begin(), all.end(),
    [](const PopulatedCell& a, const PopulatedCell& b) { return a.index < b.index; });
  return all;
}

} // namespace pointfront
