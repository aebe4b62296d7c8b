#include "pointfront/Means/MeanBuilder.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace pointfront
{

MeanBuilder::MeanBuilder(const NodeEmitter& emitter, std::size_t recordBytes, MeanRecord form,
  const SamplingRule& rule, unsigned leastShare)
  : EmittingBuilder(emitter, recordBytes)
  , cells_(std::move(form), rule, leastShare)
{
}

RecordSpan MeanBuilder::sortedRecords(std::vector<std::byte> records, std::size_t count)
{
  return sorted(std::move(records), count, [](std::size_t, const std::byte*) {});
}

MeanBuilder::Branch MeanBuilder::leaf(const RecordSpan& records, std::vector<std::uint32_t> held)
{
  const CpuStopwatch watch(seconds_.sample);
  Branch branch;
  branch.view = records;
  branch.original = true;
  branch.held = std::move(held);
  const unsigned side =
    differingBits(records.position(branch.held.front()), records.position(branch.held.back()));
  branch.occupancy = cellOccupancy(records, branch.held);
  branch.node = leafNode(records, branch.held, *branch.occupancy, side);
  return branch;
}

MeanBuilder::Branch MeanBuilder::reopened(
  OpenSubtree& subtree, const RecordSpan& view, std::uint32_t first) const
{
  Branch branch;
  branch.node = std::move(subtree.root);
  branch.view = view;
  branch.held.resize(subtree.records.size() / meanBytes());
  std::iota(branch.held.begin(), branch.held.end(), first);
  return branch;
}

MeanBuilder::Branch MeanBuilder::represented(
  const CellOccupancy& occupancy, unsigned log2Side, const std::vector<Branch>& children)
{
  unsigned finest = 0;
  for (const Branch& child : children)
  {
    const int quarters = child.node->samplingQuarters; // a leaf has points as they come
    finest = quarters < 0 ? finest : std::max(finest, static_cast<unsigned>(quarters) / 4 + 1);
  }
  Branch branch;
  branch.node = std::make_unique<BuiltNode>();
  branch.means = cells_.represent(occupancy, log2Side, finest, space().stepLength(), *branch.node);
  branch.view = { branch.means.data(), meanBytes() };
  branch.held.resize(branch.means.size() / meanBytes());
  std::iota(branch.held.begin(), branch.held.end(), 0u);
  branch.node->row.splatRadius = splat_.measure(branch.view, branch.held);
  return branch;
}

void MeanBuilder::adopt(Branch& parent, std::vector<Branch> children)
{
  for (Branch& child : children)
  {
    emit(*child.node, child.view, child.held);
    parent.node->children.push_back(std::move(child.node));
  }
  adoptEmitted(children.size());
}

OpenSubtree MeanBuilder::opened(Branch branch)
{
  std::vector<std::byte> records =
    branch.original ? cells_.alone(branch.view, branch.held) : std::move(branch.means);
  return { std::move(branch.node), std::move(records) };
}

} // namespace pointfront
