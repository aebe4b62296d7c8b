#include "pointfront/Neighbourhood/CellHistogram.h"

#include <algorithm>
#include <cmath>

namespace pointfront
{

CellHistogram::CellHistogram(int edgeLog2, unsigned axes, std::size_t mostCells)
  : edgeLog2_(edgeLog2)
  , edge_(std::ldexp(1.0, edgeLog2))
  , axes_(axes)
  , mostCells_(mostCells)
{
}

std::size_t CellHistogram::Hash::operator()(const CellIndex& index) const
{
  std::uint64_t mixed = 0;
  for (const std::int64_t i : index)
  {
    mixed = (mixed ^ static_cast<std::uint64_t>(i)) * 0x9e3779b97f4a7c15ull;
    mixed ^= mixed >> 29;
  }
  return static_cast<std::size_t>(mixed);
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
    last_ = &counts_[index]; // nodes of the map stay where they are
    lastIndex_ = index;
  }
  ++*last_;
  if (counts_.size() > mostCells_)
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
  for (const auto& [index, count] : other.counts_)
  {
    CellIndex mine{};
    for (std::size_t axis = 0; axis < mine.size(); ++axis)
    {
      mine[axis] = index[axis] >> std::min(shift, 63);
    }
    counts_[mine] += count;
  }
  points_ += other.points_;
  last_ = nullptr;
  while (counts_.size() > mostCells_)
  {
    coarsen();
  }
}

void CellHistogram::coarsen()
{
  std::unordered_map<CellIndex, std::uint64_t, Hash> coarse;
  for (const auto& [index, count] : counts_)
  {
    coarse[{ index[0] >> 1, index[1] >> 1, index[2] >> 1 }] += count;
  }
  counts_ = std::move(coarse);
  edge_ = std::ldexp(1.0, ++edgeLog2_);
  last_ = nullptr;
}

std::vector<PopulatedCell> CellHistogram::cells() const
{
  std::vector<PopulatedCell> all;
  all.reserve(counts_.size());
  for (const auto& [index, count] : counts_)
  {
    all.push_back({ index, count });
  }
  std::sort(all.begin(), all.end(),
    [](const PopulatedCell& a, const PopulatedCell& b) { return a.index < b.index; });
  return all;
}

} // namespace pointfront
