#include "pointfront/Means/MeanSubtreeBuilder.h"

#include "pointfront/Base/CpuClock.h"
#include "pointfront/Trees/LeafMerging.h"
#include "pointfront/Trees/OctreeSplit.h"

#include <algorithm>
#include <numeric>

namespace pointfront
{
OpenSubtree MeanSubtreeBuilder::build(
  std::vector<std::byte> records, std::size_t count, std::uint32_t /*node*/)
{
  if (count == 0)
  {
    return {};
  }
  const RecordSpan sorted = sortedRecords(std::move(records), count);
  return opened(branch(sorted, 0, static_cast<std::uint32_t>(count)));
}

MeanSubtreeBuilder::Branch MeanSubtreeBuilder::branch(
  const RecordSpan& records, std::uint32_t begin, std::uint32_t end)
{
  if (end - begin <= rule_.nodePoints)
  {
    std::vector<std::uint32_t> held(end - begin);
    std::iota(held.begin(), held.end(), begin);
    return leaf(records, std::move(held));
  }
  const unsigned side = differingBits(records.position(begin), records.position(end - 1));
  std::vector<Branch> children;
  for (const IndexRange& range : splitPoints(records, { begin, end }, side))
  {
    children.push_back(branch(
      records, static_cast<std::uint32_t>(range.begin), static_cast<std::uint32_t>(range.end)));
  }
  return joinBranches(std::move(children), side);
}

MeanSubtreeBuilder::Branch MeanSubtreeBuilder::represent(
  const std::vector<Branch>& children, unsigned log2Side)
{
  const CpuStopwatch watch(seconds_.sample);
  cells_.clear();
  CellOccupancy occupancy;
  for (const Branch& child : children)
  {
    const std::size_t first = cells_.size();
    cells_.add(child.view, child.held, child.original);
    if (first < cells_.size())
    {
      occupancy.append(child.occupancy ? *child.occupancy : cellOccupancy(child.view, child.held),
        first == 0 ? 0 : differingBits(cells_.position(first - 1), cells_.position(first)));
    }
  }
  return represented(occupancy, log2Side, children);
}

MeanSubtreeBuilder::Branch MeanSubtreeBuilder::joinBranches(
  std::vector<Branch> children, unsigned log2Side)
{
  Branch joined = represent(children, log2Side);
  mergeLeaves(
    children, rule_.nodePoints, [](const Branch& leaf) { return leaf.view; }, space().stepLength());
  adopt(joined, std::move(children));
  return joined;
}

OpenSubtree MeanSubtreeBuilder::join(std::vector<OpenSubtree> children, std::uint32_t node)
{
  std::vector<std::byte> records; // one array, because leaves of different parts may grow together
  for (const OpenSubtree& child : children)
  {
    records.insert(records.end(), child.records.begin(), child.records.end());
  }
  std::vector<Branch> branches;
  std::uint32_t first = 0;
  for (OpenSubtree& child : children)
  {
    branches.push_back(reopened(child, { records.data(), meanBytes() }, first));
    first += static_cast<std::uint32_t>(branches.back().held.size());
    child.records = {};
  }
  return opened(joinBranches(std::move(branches), partition_.nodes()[node].cell.log2Side));
}

} // namespace pointfront
