#pragma once

#include "pointfront/Means/MeanCells.h"
#include "pointfront/Trees/EmittingBuilder.h"
#include "pointfront/Trees/KdCut.h"
#include "pointfront/Trees/NodeSplat.h"

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace pointfront
{

/// The balanced kd-tree over some points with `replace` refinement: the points of the input are in
/// the leaves, an inner node holds mean representatives (MeanCells.h).
/// Shape     a region is divided along the longest axis of its box, so that the left has a whole
///           number of full leaves: all leaves have nodePoints points, but for one a tree. Equal
///           coordinates are divided by Morton order, then by input order.
/// Levels    an inner node stands for two divisions, one after the other, and has two to four
///           children. So on a surface its representatives are twice as far apart as below and each
///           node has about as many, as in an octree. One division a level would halve the nodes
///           and divide the representatives by four.
/// What an open subtree holds are the representatives of its root, or the points of a leaf, as
/// records of MeanRecord in Morton order.
/// Source    Richter & Doellner 2010, section 3.1; Richter, Discher & Doellner 2015, section 4.1.
class KdMeanBuilder final : public EmittingBuilder
{
public:
  KdMeanBuilder(
    const NodeEmitter& emitter, const KdRule& rule, MeanRecord form, std::size_t recordBytes)
    : EmittingBuilder(emitter)
    , nodePoints_(rule.nodePoints)
    , recordBytes_(recordBytes)
    , cells_(std::move(form), SamplingRule{ rule.nodePoints }, leastShare)
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
  /// Cells become coarser by powers of two, which leave a quarter of a surface's representatives.
  /// With half as the limit a node has between an eighth and a half of what its children have, and
  /// nodes of all levels about as many points.
  static constexpr unsigned leastShare = 2;

  struct Branch
  {
    std::unique_ptr<BuiltNode> node;
    std::vector<std::byte> means; ///< what `view` shows of an inner node built here
    RecordSpan view;
    bool original = false; ///< the view shows records of the pool
    std::vector<std::uint32_t> held; ///< numbers in the view, Morton order
  };
  using Range = std::pair<std::size_t, std::size_t>; ///< of active_

  Branch branch(const RecordSpan& records, const Range& range);
  Branch leaf(const RecordSpan& records, const Range& range);
  std::array<Range, 2> halves(const RecordSpan& records, const Range& range);
  int longestAxis(const RecordSpan& records, const Range& range) const;
  Branch joinBranches(std::vector<Branch> children);
  OpenSubtree opened(Branch branch);

  std::uint32_t nodePoints_;
  std::size_t recordBytes_;
  MeanCells cells_;
  NodeSplat splat_;
  // Reused from part to part: fresh memory costs more than what is done with it.
  std::vector<std::byte> sorted_; // records of the part
  std::vector<std::uint32_t> active_; // numbers of them, region by region, each in Morton order
  std::vector<std::pair<std::uint32_t, std::uint32_t>> places_; // coordinate, number
};

} // namespace pointfront
