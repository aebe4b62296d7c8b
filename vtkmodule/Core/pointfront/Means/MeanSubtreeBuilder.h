#pragma once

#include "pointfront/Means/MeanBuilder.h"
#include "pointfront/Trees/Partition.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace pointfront
{

/// The octree over some points with `replace` refinement, from the leaves up: the points of the
/// input are in the leaves, an inner node holds one mean representative for each cell of its grid
/// (MeanCells.h). Cells, leaves and merging as in SubtreeBuilder. A node has at most a third of the
/// points that it stands in for, so all inner nodes together add at most half.
/// Source   Richter & Doellner 2010, section 3.1 and figure 3.
class MeanSubtreeBuilder final : public MeanBuilder
{
public:
  MeanSubtreeBuilder(const NodeEmitter& emitter, const SamplingRule& rule, MeanRecord form,
    std::size_t recordBytes, const Partition& partition)
    : MeanBuilder(emitter, recordBytes, std::move(form), rule, leastShare)
    , rule_(rule)
    , partition_(partition)
  {
  }

  OpenSubtree build(std::vector<std::byte> records, std::size_t count, std::uint32_t node) override;
  OpenSubtree join(std::vector<OpenSubtree> children, std::uint32_t node) override;

private:
  static constexpr unsigned leastShare = 3;

  Branch branch(const RecordSpan& records, std::uint32_t begin, std::uint32_t end);
  Branch joinBranches(std::vector<Branch> children, unsigned log2Side);
  Branch represent(const std::vector<Branch>& children, unsigned log2Side);

  SamplingRule rule_;
  const Partition& partition_;
};

} // namespace pointfront
