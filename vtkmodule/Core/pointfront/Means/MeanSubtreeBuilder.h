#pragma once

#include "pointfront/Means/MeanCells.h"
#include "pointfront/Trees/EmittingBuilder.h"
#include "pointfront/Trees/NodeSplat.h"
#include "pointfront/Trees/Partition.h"
#include "pointfront/Trees/Sampler.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace pointfront
{

/// The octree over some points with `replace` refinement, from the leaves up: the points of the
/// input are in the leaves, an inner node holds one mean representative for each cell of its grid
/// (MeanCells.h). Cells, leaves and merging as in SubtreeBuilder. A node has at most a third of the
/// points that it stands in for, so all inner nodes together add at most half.
/// What an open subtree holds are the representatives of its root, or the points of a leaf, as
/// records of MeanRecord in Morton order.
/// Source   Richter & Doellner 2010, section 3.1 and figure 3.
class MeanSubtreeBuilder final : public EmittingBuilder
{
public:
  MeanSubtreeBuilder(const NodeEmitter& emitter, const SamplingRule& rule, MeanRecord form,
    std::size_t recordBytes, const Partition& partition)
    : EmittingBuilder(emitter)
    , rule_(rule)
    , cells_(std::move(form), rule, leastShare)
    , recordBytes_(recordBytes)
    , partition_(partition)
    , splat_(emitter.space())
  {
  }

  OpenSubtree build(std::vector<std::byte> records, std::size_t count, std::uint32_t node) override;
  OpenSubtree join(std::vector<OpenSubtree> children, std::uint32_t node) override;
  std::unique_ptr<BuiltNode> close(OpenSubtree subtree) override
  {
    return emitRoot(std::move(subtree), cells_.form().bytes());
  }

private:
  static constexpr unsigned leastShare = 3;

  struct Branch
  {
    std::unique_ptr<BuiltNode> node;
    std::vector<std::byte> means; ///< what `view` shows of an inner node built here
    RecordSpan view;
    bool original = false; ///< the view shows records of the pool
    std::vector<std::uint32_t> held; ///< numbers in the view, Morton order
    std::optional<CellOccupancy> occupancy; ///< of `held`, where it is known already
  };
  Branch branch(const RecordSpan& records, std::uint32_t begin, std::uint32_t end);
  Branch leaf(const RecordSpan& records, std::uint32_t begin, std::uint32_t end, unsigned side);
  Branch joinBranches(std::vector<Branch> children, unsigned log2Side);
  void represent(const std::vector<Branch>& children, unsigned log2Side, Branch& joined);
  OpenSubtree opened(Branch branch);

  SamplingRule rule_;
  MeanCells cells_; // of the node at hand
  std::size_t recordBytes_;
  const Partition& partition_;
  NodeSplat splat_;
  // Reused from part to part: fresh memory costs more than what is done with it.
  std::vector<std::byte> sorted_; // records of the part
};

} // namespace pointfront
