#include "pointfront/Build/SubtreeBuilder.h"

#include "pointfront/Build/CpuClock.h"
#include "pointfront/Build/OctreeSplit.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

namespace pointfront
{
namespace
{
std::vector<std::byte> gathered(const RecordView& records, const std::vector<std::uint32_t>& order)
{
  std::vector<std::byte> out(order.size() * records.stride);
  std::byte* to = out.data();
  for (const std::uint32_t i : order)
  {
    std::memcpy(to, records.record(i), records.stride);
    to += records.stride;
  }
  return out;
}
} // namespace

OpenSubtree SubtreeBuilder::build(
  std::vector<std::byte> records, std::size_t count, std::uint32_t /*node*/)
{
  if (count == 0)
  {
    return {};
  }
  {
    const CpuStopwatch watch(seconds_.sort);
    const RecordView view{records.data(), recordBytes_};
    records = gathered(view, mortonOrder(view, count));
  }
  const RecordView sorted{records.data(), recordBytes_};
  return opened(sorted, branch(sorted, 0, static_cast<std::uint32_t>(count)));
}

SubtreeBuilder::Branch SubtreeBuilder::branch(
  const RecordView& records, std::uint32_t begin, std::uint32_t end)
{
  const unsigned side = differingBits(records.position(begin), records.position(end - 1));
  if (end - begin <= rule_.nodePoints)
  {
    return leaf(records, begin, end, side);
  }
  std::vector<Branch> children;
  const auto octant = [&](std::uint64_t i)
  { return octantOf(records.position(static_cast<std::size_t>(i)), side); };
  for (const IndexRange& range : splitRange({begin, end}, side, octant))
  {
    children.push_back(branch(
      records, static_cast<std::uint32_t>(range.begin), static_cast<std::uint32_t>(range.end)));
  }
  return joinBranches(records, std::move(children), side);
}

SubtreeBuilder::Branch SubtreeBuilder::leaf(
  const RecordView& records, std::uint32_t begin, std::uint32_t end, unsigned side)
{
  const CpuStopwatch watch(seconds_.sample);
  Branch branch;
  branch.held.resize(end - begin);
  std::iota(branch.held.begin(), branch.held.end(), begin);
  branch.node = std::make_unique<BuiltNode>();
  const double steps =
    surfaceSpacing(cellOccupancy(records, branch.held), branch.held.size(), side);
  branch.node->row.spacing = static_cast<float>(steps * emitter_.space().stepLength());
  return branch;
}

SubtreeBuilder::Branch SubtreeBuilder::joinBranches(
  const RecordView& records, std::vector<Branch> children, unsigned log2Side)
{
  Branch joined;
  joined.node = std::make_unique<BuiltNode>();
  std::vector<bool> chosen;
  {
    const CpuStopwatch watch(seconds_.sample);
    std::vector<std::uint32_t> candidates;
    int coarsestBelow = -1;
    for (const Branch& child : children)
    {
      candidates.insert(candidates.end(), child.held.begin(), child.held.end());
      coarsestBelow = std::max(coarsestBelow, child.node->samplingLog2);
    }
    const unsigned cell =
      samplingCell(cellOccupancy(records, candidates), log2Side, coarsestBelow, rule_);
    joined.node->samplingLog2 = static_cast<int>(cell);
    joined.node->row.spacing =
      static_cast<float>(std::ldexp(emitter_.space().stepLength(), static_cast<int>(cell)));
    sampler_.choose(records, candidates, cell, chosen);
  }
  std::size_t rank = 0;
  for (Branch& child : children)
  {
    std::vector<std::uint32_t> left;
    for (const std::uint32_t point : child.held)
    {
      (chosen[rank++] ? joined.held : left).push_back(point);
    }
    child.held = std::move(left);
  }
  mergeLeaves(children);
  for (Branch& child : children)
  {
    emit(std::move(child), *joined.node, records);
  }
  return joined;
}

void SubtreeBuilder::mergeLeaves(std::vector<Branch>& children) const
{
  std::vector<Branch> merged;
  std::size_t grown = SIZE_MAX; // the leaf in `merged` that takes in others
  for (Branch& child : children)
  {
    const std::size_t points = child.held.size();
    const bool leaf = child.node->children.empty();
    if (leaf && points == 0)
    {
      continue; // all its points went up
    }
    if (!leaf || grown == SIZE_MAX || merged[grown].held.size() + points > rule_.nodePoints)
    {
      grown = leaf ? merged.size() : grown;
      merged.push_back(std::move(child));
      continue;
    }
    Branch& into = merged[grown];
    // Spacing of a surface is sqrt(area / points), and areas add up.
    const auto area = [](const Branch& b)
    { return double(b.node->row.spacing) * b.node->row.spacing * double(b.held.size()); };
    const double all = area(into) + area(child);
    into.held.insert(into.held.end(), child.held.begin(), child.held.end());
    into.node->row.spacing = static_cast<float>(std::sqrt(all / double(into.held.size())));
  }
  children = std::move(merged);
}

void SubtreeBuilder::emit(Branch child, BuiltNode& parent, const RecordView& records)
{
  const CpuStopwatch watch(seconds_.encode);
  EncodedNode payload = emitter_.emit(*child.node, records, child.held);
  emitted_.push_back({child.node.get(), std::move(payload)});
  parent.children.push_back(std::move(child.node));
}

OpenSubtree SubtreeBuilder::opened(const RecordView& records, Branch branch) const
{
  return {std::move(branch.node), gathered(records, branch.held)};
}

OpenSubtree SubtreeBuilder::join(std::vector<OpenSubtree> children, std::uint32_t node)
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
  const RecordView view{records.data(), recordBytes_};
  return opened(
    view, joinBranches(view, std::move(branches), partition_.nodes()[node].cell.log2Side));
}

std::unique_ptr<BuiltNode> SubtreeBuilder::close(OpenSubtree subtree)
{
  if (!subtree.root)
  {
    return nullptr;
  }
  const RecordView view{subtree.records.data(), recordBytes_};
  std::vector<std::uint32_t> all(subtree.records.size() / recordBytes_);
  std::iota(all.begin(), all.end(), 0u);
  const CpuStopwatch watch(seconds_.encode);
  EncodedNode payload = emitter_.emit(*subtree.root, view, all);
  emitted_.push_back({subtree.root.get(), std::move(payload)});
  return std::move(subtree.root);
}

} // namespace pointfront
