#include "pointfront/Means/KdMeanBuilder.h"

#include "pointfront/Base/CpuClock.h"
#include "pointfront/Records/MortonOrder.h"

#include <glm/common.hpp>

#include <algorithm>
#include <numeric>

namespace pointfront
{

OpenSubtree KdMeanBuilder::build(
  std::vector<std::byte> records, std::size_t count, std::uint32_t /*node*/)
{
  if (count == 0)
  {
    return {};
  }
  const RecordSpan sorted = sortedRecords(std::move(records), count);
  active_.resize(count);
  std::iota(active_.begin(), active_.end(), 0u);
  return opened(branch(sorted, { 0, count }));
}

KdMeanBuilder::Branch KdMeanBuilder::branch(const RecordSpan& records, const Range& range)
{
  const auto fits = [&](const Range& part) { return part.second - part.first <= nodePoints_; };
  if (fits(range))
  {
    return leafOf(records, range);
  }
  std::vector<Branch> children;
  for (const Range& half : halves(records, range))
  {
    if (fits(half))
    {
      children.push_back(leafOf(records, half));
      continue;
    }
    for (const Range& quarter : halves(records, half))
    {
      children.push_back(branch(records, quarter));
    }
  }
  return joinBranches(std::move(children));
}

KdMeanBuilder::Branch KdMeanBuilder::leafOf(const RecordSpan& records, const Range& range)
{
  return leaf(records,
    { active_.begin() + static_cast<std::ptrdiff_t>(range.first),
      active_.begin() + static_cast<std::ptrdiff_t>(range.second) });
}

int KdMeanBuilder::longestAxis(const RecordSpan& records, const Range& range) const
{
  TreePosition low(UINT32_MAX);
  TreePosition high(0);
  for (std::size_t i = range.first; i < range.second; ++i)
  {
    low = glm::min(low, records.position(active_[i]));
    high = glm::max(high, records.position(active_[i]));
  }
  const TreePosition size = high - low;
  return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

/// Puts the points of the left before those of the right, each in Morton order.
std::array<KdMeanBuilder::Range, 2> KdMeanBuilder::halves(
  const RecordSpan& records, const Range& range)
{
  const CpuStopwatch watch(seconds_.sample);
  const int axis = longestAxis(records, range);
  const auto place = [&](std::uint32_t i) { return std::pair(records.position(i)[axis], i); };
  places_.clear();
  for (std::size_t i = range.first; i < range.second; ++i)
  {
    places_.push_back(place(active_[i]));
  }
  const auto wanted =
    static_cast<std::ptrdiff_t>(kdLeftPoints(range.second - range.first, nodePoints_));
  std::nth_element(places_.begin(), places_.begin() + wanted, places_.end());
  const auto first = places_[static_cast<std::size_t>(wanted)]; // first of the right half
  const auto middle =
    std::stable_partition(active_.begin() + static_cast<std::ptrdiff_t>(range.first),
      active_.begin() + static_cast<std::ptrdiff_t>(range.second),
      [&](std::uint32_t i) { return place(i) < first; });
  const auto at = static_cast<std::size_t>(middle - active_.begin());
  return { Range(range.first, at), Range(at, range.second) };
}

KdMeanBuilder::Branch KdMeanBuilder::joinBranches(std::vector<Branch> children)
{
  Branch joined;
  {
    const CpuStopwatch watch(seconds_.sample);
    cells_.clear();
    for (const Branch& child : children)
    {
      cells_.add(child.view, child.held, child.original);
    }
    cells_.sort(); // regions of a kd-tree are no runs of the curve
    const unsigned side = differingBits(cells_.position(0), cells_.position(cells_.size() - 1));
    joined = represented(cells_.occupancy(), side, children);
  }
  adopt(joined, std::move(children));
  return joined;
}

OpenSubtree KdMeanBuilder::join(std::vector<OpenSubtree> children, std::uint32_t /*node*/)
{
  std::vector<Branch> branches;
  for (OpenSubtree& child : children)
  {
    if (child.root) // one of a preview may not have any points yet
    {
      branches.push_back(reopened(child, { child.records.data(), meanBytes() }, 0));
    }
  }
  return branches.empty() ? OpenSubtree() : opened(joinBranches(std::move(branches)));
}

} // namespace pointfront
