#include "pointfront/Trees/MeanSubtreeBuilder.h"

#include "pointfront/Base/CpuClock.h"
#include "pointfront/Trees/LeafMerging.h"
#include "pointfront/Trees/OctreeSplit.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pointfront
{
namespace
{
/// Points that one representative stands in for, at least on average.
constexpr std::uint64_t leastShare = 3;

/// log2 of the cells that are represented by one point each: the finest that gives at most twice
/// the node's capacity, twice as coarse as those of the inner children.
unsigned meanCell(const CellOccupancy& occupancy, std::uint64_t points, unsigned nodeLog2Side,
  int coarsestBelow, const SamplingRule& rule)
{
  const std::uint64_t most = std::min<std::uint64_t>(2ull * rule.nodePoints, points / leastShare);
  unsigned cell = static_cast<unsigned>(coarsestBelow + 1);
  while (cell < nodeLog2Side && occupancy.distinct[cell] > most)
  {
    ++cell;
  }
  return std::min(cell, nodeLog2Side);
}
} // namespace

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
  std::size_t count = 0;
  for (const Branch& child : children)
  {
    count += child.held.size();
  }
  inputs_.resize(count);
  positions_.resize(count);
  std::size_t next = 0;
  int coarsestBelow = -1;
  CellOccupancy occupancy;
  for (const Branch& child : children)
  {
    const std::size_t first = next;
    for (const std::uint32_t i : child.held)
    {
      inputs_[next] = { child.view.record(i), child.original };
      positions_[next++] = child.view.position(i);
    }
    const bool leaf = child.node->samplingQuarters < 0;
    coarsestBelow =
      leaf ? coarsestBelow : std::max(coarsestBelow, child.node->samplingQuarters / 4);
    if (first < next)
    {
      occupancy.append(child.occupancy ? *child.occupancy : cellOccupancy(child.view, child.held),
        first == 0 ? 0 : differingBits(positions_[first - 1], positions_[first]));
    }
  }
  const unsigned cell = meanCell(occupancy, inputs_.size(), log2Side, coarsestBelow, rule_);
  joined.node->samplingQuarters = 4 * static_cast<int>(cell);
  joined.node->row.spacing =
    static_cast<float>(std::ldexp(space().stepLength(), static_cast<int>(cell)));
  joined.held.resize(occupancy.distinct[cell]);
  std::iota(joined.held.begin(), joined.held.end(), 0u);
  joined.means.resize(joined.held.size() * form_.bytes());
  joined.view = { joined.means.data(), form_.bytes() };
  std::byte* out = joined.means.data();
  for (std::size_t begin = 0; begin < inputs_.size(); out += form_.bytes())
  {
    std::size_t end = begin + 1;
    while (end < inputs_.size() && differingBits(positions_[end], positions_[begin]) <= cell)
    {
      ++end;
    }
    form_.summarise(inputs_, begin, end, out);
    form_.forgetSplat(out);
    begin = end;
  }
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
  if (!branch.original)
  {
    return { std::move(branch.node), std::move(branch.means) };
  }
  inputs_.clear();
  std::vector<std::byte> records(branch.held.size() * form_.bytes());
  for (std::size_t i = 0; i < branch.held.size(); ++i)
  {
    inputs_.push_back({ branch.view.record(branch.held[i]), true });
    form_.summarise(inputs_, i, i + 1, records.data() + i * form_.bytes());
  }
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
    branch.view = { records.data(), form_.bytes() };
    branch.held.resize(child.records.size() / form_.bytes());
    std::iota(branch.held.begin(), branch.held.end(), first);
    first += static_cast<std::uint32_t>(branch.held.size());
    branches.push_back(std::move(branch));
    child.records = {};
  }
  return opened(joinBranches(std::move(branches), partition_.nodes()[node].cell.log2Side));
}

} // namespace pointfront
