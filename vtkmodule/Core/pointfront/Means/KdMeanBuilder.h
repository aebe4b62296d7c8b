#pragma once

#include "pointfront/Means/MeanBuilder.h"
#include "pointfront/Trees/KdCut.h"

#include <array>
#include <cstdint>
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
/// Source    Richter & Doellner 2010, section 3.1; Richter, Discher & Doellner 2015, section 4.1.
class KdMeanBuilder final : public MeanBuilder
{
public:
  KdMeanBuilder(
    const NodeEmitter& emitter, const KdRule& rule, MeanRecord form, std::size_t recordBytes)
    : MeanBuilder(
        emitter, recordBytes, std::move(form), SamplingRule{ rule.nodePoints }, leastShare)
    , nodePoints_(rule.nodePoints)
  {
  }

  OpenSubtree build(std::vector<std::byte> records, std::size_t count, std::uint32_t node) override;
  OpenSubtree join(std::vector<OpenSubtree> children, std::uint32_t node) override;

private:
  /// Cells become coarser by powers of two, which leave a quarter of a surface's representatives.
  /// With half as the limit a node has between an eighth and a half of what its children have, and
  /// nodes of all levels about as many points.
  static constexpr unsigned leastShare = 2;

  using Range = std::pair<std::size_t, std::size_t>; ///< range in active_

  Branch branch(const RecordSpan& records, const Range& range);
  Branch leafOf(const RecordSpan& records, const Range& range);
  std::array<Range, 2> halves(const RecordSpan& records, const Range& range);
  int longestAxis(const RecordSpan& records, const Range& range) const;
  Branch joinBranches(std::vector<Branch> children);

  std::uint32_t nodePoints_;
  // Reused from part to part: fresh memory costs more than what is done with it.
  std::vector<std::uint32_t> active_; // numbers of them, region by region, each in Morton order
  std::vector<std::pair<std::uint32_t, std::uint32_t>> places_; // coordinate, number
};

} // namespace pointfront
