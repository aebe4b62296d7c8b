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
  {
    const CpuStopwatch watch(seconds_.sort);
    const RecordSpan view{ records.data(), recordBytes_ };
    sorted_.resize(std::max(sorted_.size(), records.size()));
    gatherRecords(view, mortonOrder(view, count), sorted_.data());
    records = {};
  }
  const RecordSpan sorted{ sorted_.data(), recordBytes_ };
  return opened(branch(sorted, 0, static_cast<std::uint32_t>(count)));
}

MeanSubtreeBuilder::Branch MeanSubtreeBuilder::branch(
  const RecordSpan& records, std::uint32_t begin, std::uint32_t end)
{
  const unsigned side = differingBits(records.position(begin), records.position(end - 1));
  if (end - begin <= rule_.nodePoints)
  {
    return leaf(records, begin, end, side);
  }
  std::vector<Branch> children;
  const auto octant = [&](std::uint64_t i)
  { return octantOf(records.position(static_cast<std::size_t>(i)), side); };
  for (const IndexRange& range : splitRange({ begin, end }, side, octant))
  {
    children.push_back(branch(
      records, static_cast<std::uint32_t>(range.begin), static_cast<std::uint32_t>(range.end)));
  }
  return joinBranches(std::move(children), side);
}

MeanSubtreeBuilder::Branch MeanSubtreeBuilder::leaf(
  const RecordSpan& records, std::uint32_t begin, std::uint32_t end, unsigned side)
{
  const CpuStopwatch watch(seconds_.sample);
  Branch branch;
  branch.view = records;
  branch.original = true;
  branch.held.resize(end - begin);
  std::iota(branch.held.begin(), branch.held.end(), begin);
  branch.node = std::make_unique<BuiltNode>();
  branch.occupancy = cellOccupancy(records, branch.held);
  const double steps = surfaceSpacing(*branch.occupancy, branch.held.size(), side);
  branch.node->row.spacing = static_cast<float>(steps * space().stepLength());
  branch.node->row.splatRadius = splat_.measure(records, branch.held);
  return branch;
}

void MeanSubtreeBuilder::represent(
  const std::vector<Branch>& children, unsigned log2Side, Branch& joined)
{
  const CpuStopwatch watch(seconds_.sample);
  cells_.clear();
  int coarsestBelow = -1;
  CellOccupancy occupancy;
  for (const Branch& child : children)
  {
    const std::size_t first = cells_.size();
    cells_.add(child.view, child.held, child.original);
    const bool leaf = child.node->samplingQuarters < 0;
    coarsestBelow =
      leaf ? coarsestBelow : std::max(coarsestBelow, child.node->samplingQuarters / 4);
    if (first < cells_.size())
    {
      occupancy.append(child.occupancy ? *child.occupancy : cellOccupancy(child.view, child.held),
        first == 0 ? 0 : differingBits(cells_.position(first - 1), cells_.position(first)));
    }
  }
  joined.means = cells_.represent(occupancy, log2Side, static_cast<unsigned>(coarsestBelow + 1),
    space().stepLength(), *joined.node); // twice as coarse as the inner children
  joined.view = { joined.means.data(), cells_.form().bytes() };
  joined.held.resize(joined.means.size() / cells_.form().bytes());
  std::iota(joined.held.begin(), joined.held.end(), 0u);
  joined.node->row.splatRadius = splat_.measure(joined.view, joined.held);
}

MeanSubtreeBuilder::Branch MeanSubtreeBuilder::joinBranches(
  std::vector<Branch> children, unsigned log2Side)
{
  Branch joined;
  joined.node = std::make_unique<BuiltNode>();
  represent(children, log2Side, joined);
  mergeLeaves(children, rule_.nodePoints);
  for (Branch& child : children)
  {
    emit(*child.node, child.view, child.held);
    joined.node->children.push_back(std::move(child.node));
  }
  return joined;
}

OpenSubtree MeanSubtreeBuilder::opened(Branch branch)
{
  std::vector<std::byte> records =
    branch.original ? cells_.alone(branch.view, branch.held) : std::move(branch.means);
  return { std::move(branch.node), std::move(records) };
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
    Branch branch;
    branch.node = std::move(child.root);
    branch.view = { records.data(), cells_.form().bytes() };
    branch.held.resize(child.records.size() / cells_.form().bytes());
    std::iota(branch.held.begin(), branch.held.end(), first);
    first += static_cast<std::uint32_t>(branch.held.size());
    branches.push_back(std::move(branch));
    child.records = {};
  }
  return opened(joinBranches(std::move(branches), partition_.nodes()[node].cell.log2Side));
}

} // namespace pointfront
