#include "pointfront/Trees/SubtreeBuilder.h"

#include "pointfront/Base/CpuClock.h"
#include "pointfront/Trees/LeafMerging.h"
#include "pointfront/Trees/OctreeSplit.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pointfront
{
OpenSubtree SubtreeBuilder::build(
  std::vector<std::byte> records, std::size_t count, std::uint32_t /*node*/)
{
  if (count == 0)
  {
    return {};
  }
  positions_.resize(std::max(positions_.size(), count));
  const RecordSpan view = sorted(std::move(records), count,
    [&](std::size_t i, const std::byte* record) { positions_[i] = positionOf(record); });
  return opened(view, branch({ view, positionsView() }, 0, static_cast<std::uint32_t>(count)));
}

SubtreeBuilder::SortedPoints SubtreeBuilder::sortedPoints(
  const RecordSpan& records, std::size_t count)
{
  const CpuStopwatch watch(seconds_.sort);
  positions_.resize(std::max(positions_.size(), count));
  for (std::size_t i = 0; i < count; ++i)
  {
    positions_[i] = records.position(i);
  }
  return { records, positionsView() };
}

RecordSpan SubtreeBuilder::positionsView() const
{
  return { reinterpret_cast<const std::byte*>(positions_.data()), RecordLayout::positionBytes };
}

SubtreeBuilder::Branch SubtreeBuilder::branch(
  const SortedPoints& points, std::uint32_t begin, std::uint32_t end)
{
  const RecordSpan& positions = points.positions;
  const unsigned side = differingBits(positions.position(begin), positions.position(end - 1));
  if (end - begin <= rule_.nodePoints)
  {
    return leaf(points, begin, end, side);
  }
  std::vector<Branch> children;
  for (const IndexRange& range : splitPoints(positions, { begin, end }, side))
  {
    children.push_back(branch(
      points, static_cast<std::uint32_t>(range.begin), static_cast<std::uint32_t>(range.end)));
  }
  return joinBranches(points, std::move(children));
}

SubtreeBuilder::Branch SubtreeBuilder::leaf(
  const SortedPoints& points, std::uint32_t begin, std::uint32_t end, unsigned side)
{
  const CpuStopwatch watch(seconds_.sample);
  Branch branch;
  branch.held.resize(end - begin);
  std::iota(branch.held.begin(), branch.held.end(), begin);
  branch.occupancy = cellOccupancy(points.positions, branch.held);
  branch.node = leafNode(points.positions, branch.held, *branch.occupancy, side);
  return branch;
}

SubtreeBuilder::Branch SubtreeBuilder::joinBranches(
  const SortedPoints& points, std::vector<Branch> children)
{
  Branch joined;
  joined.node = std::make_unique<BuiltNode>();
  {
    const CpuStopwatch watch(seconds_.sample);
    candidates_.clear();
    int coarsestBelow = -1;
    float spacingBelow = 0.0f;
    for (const Branch& child : children)
    {
      candidates_.insert(candidates_.end(), child.held.begin(), child.held.end());
      const bool inner = child.node->samplingQuarters >= 0;
      coarsestBelow = std::max(coarsestBelow, child.node->samplingQuarters);
      spacingBelow = std::max(spacingBelow, inner ? child.node->row.spacing : 0.0f);
    }
    const CellOccupancy occupancy = occupancyOf(points.positions, children);
    const SamplingDistance distance =
      samplingDistance(occupancy, candidates_.size(), coarsestBelow, rule_);
    joined.node->samplingQuarters = distance.quarters;
    sampler_.choose(points.positions, candidates_, distance, chosen_);
    joined.node->row.spacing = std::max(spacingBelow, spacingOf(points, occupancy, distance));
    joined.held.reserve(chosen_.size());
    auto next = chosen_.begin();
    std::size_t first = 0; // the child's first, among the candidates
    for (Branch& child : children)
    {
      auto left = child.held.begin();
      auto from = child.held.begin();
      const std::size_t end = first + child.held.size();
      for (; next != chosen_.end() && *next < end; ++next)
      {
        const auto at = child.held.begin() + static_cast<std::ptrdiff_t>(*next - first);
        left = std::copy(from, at, left);
        joined.held.push_back(*at);
        from = at + 1;
      }
      child.held.erase(std::copy(from, child.held.end(), left), child.held.end());
      first = end;
    }
    joined.node->row.splatRadius = splat_.measure(points.positions, joined.held);
  }
  mergeLeaves(
    children, rule_.nodePoints, [&](const Branch&) { return points.positions; },
    space().stepLength());
  for (Branch& child : children)
  {
    if (child.node->children.empty())
    {
      // Whatever a leaf holds has a point of the node above no farther than that node's spacing:
      // where that is twice the threshold or less, nothing of the leaf is needed.
      seeSparse(*child.node, points.positions, child.held, 0.5f * joined.node->row.spacing);
    }
    emit(*child.node, points.records, child.held);
    joined.node->children.push_back(std::move(child.node));
  }
  adoptEmitted(children.size());
  return joined;
}

/// Spacing of an inner node that chose chosen_ of candidates_: the distance that keeps them apart;
/// where a point of each place was chosen, that of the places, which may lie much further apart.
float SubtreeBuilder::spacingOf(const SortedPoints& points, const CellOccupancy& occupancy,
  const SamplingDistance& distance) const
{
  const double apart = distance.steps();
  const double steps = chosen_.size() < occupancy.places()
    ? apart
    : std::max(apart, surfaceSpacing(points.positions, candidates_));
  return static_cast<float>(space().stepLength() * steps);
}

/// Occupancy of all points that the children hold; those of a leaf were counted already.
CellOccupancy SubtreeBuilder::occupancyOf(
  const RecordSpan& positions, const std::vector<Branch>& children)
{
  CellOccupancy all;
  const Branch* before = nullptr;
  for (const Branch& child : children)
  {
    if (child.held.empty())
    {
      continue;
    }
    const unsigned between = before ? differingBits(positions.position(before->held.back()),
                                        positions.position(child.held.front()))
                                    : 0;
    all.append(child.occupancy ? *child.occupancy : cellOccupancy(positions, child.held), between);
    before = &child;
  }
  return all;
}

OpenSubtree SubtreeBuilder::opened(const RecordSpan& records, Branch branch)
{
  OpenSubtree open{ std::move(branch.node), {} };
  open.records.resize(branch.held.size() * records.stride);
  gatherRecords(records, branch.held, open.records.data());
  return open;
}

OpenSubtree SubtreeBuilder::join(std::vector<OpenSubtree> children, std::uint32_t /*node*/)
{
  std::vector<std::byte> records;
  std::vector<Branch> branches;
  for (OpenSubtree& child : children)
  {
    const auto begin = static_cast<std::uint32_t>(records.size() / recordBytes_);
    records.insert(records.end(), child.records.begin(), child.records.end());
    Branch branch;
    branch.node = std::move(child.root);
    branch.held.resize(child.records.size() / recordBytes_);
    std::iota(branch.held.begin(), branch.held.end(), begin);
    branches.push_back(std::move(branch));
    child.records = {};
  }
  const SortedPoints points =
    sortedPoints({ records.data(), recordBytes_ }, records.size() / recordBytes_);
  return opened(points.records, joinBranches(points, std::move(branches)));
}

} // namespace pointfront
