#pragma once

#include "pointfront/Trees/EmittingBuilder.h"
#include "pointfront/Trees/Sampler.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace pointfront
{

/// The octree over some points with `add` refinement, from the leaves up. What an open subtree
/// holds are the points of its root, in Morton order: they are its parent's candidates, and only
/// what the parent leaves is the root's own.
/// Shape     A cell is the smallest of the octree that holds all its points, so each inner cell
///           has two to eight children (Richter & Doellner 2010, section 3.1). It is a leaf if and
///           only if all points in it are at most nodePoints. Equal points are split by
///           input order into eight runs, as if the octree went on below one step.
/// Mergers   Leaves of one parent become one node as long as what is left of them together is at
///           most nodePoints: an octree over a surface has many slivers, and a node of some
///           hundred points costs the front, the disk and the GPU as much as a full one.
/// Sampling  An inner node takes from what its children hold, as many as it may, none closer than
///           a distance of its own (Sampler.h); what it leaves is theirs. What a node ends up with
///           depends on the points inside its parent only: not on where the cloud was cut into
///           parts, nor on their order.
/// Splats    are measured when a node still has all points that are drawn of its cell: before those
///           above take their share of them.
/// Order     join() emits the children: siblings are neighbours in the file, below them all
///           that they contain. A subtree's root is emitted by its parent or by close().
class SubtreeBuilder final : public EmittingBuilder
{
public:
  SubtreeBuilder(const NodeEmitter& emitter, const SamplingRule& rule, std::size_t recordBytes)
    : EmittingBuilder(emitter, recordBytes)
    , rule_(rule)
  {
  }

  OpenSubtree build(std::vector<std::byte> records, std::size_t count, std::uint32_t node) override;
  OpenSubtree join(std::vector<OpenSubtree> children, std::uint32_t node) override;
  std::unique_ptr<BuiltNode> close(OpenSubtree subtree) override
  {
    return emitRoot(std::move(subtree), recordBytes_);
  }

private:
  /// Records in Morton order, and their positions once more: a tree is made of positions, and
  /// close together five of them come with one line of the cache.
  struct SortedPoints
  {
    RecordSpan records;
    RecordSpan positions;
  };
  struct Branch
  {
    std::unique_ptr<BuiltNode> node;
    std::vector<std::uint32_t> held; ///< indices into the sorted points, Morton order
    std::optional<CellOccupancy> occupancy; ///< occupancy of `held`, where it is known already
  };
  Branch branch(const SortedPoints& points, std::uint32_t begin, std::uint32_t end);
  Branch leaf(const SortedPoints& points, std::uint32_t begin, std::uint32_t end, unsigned side);
  Branch joinBranches(const SortedPoints& points, std::vector<Branch> children);
  float spacingOf(const SortedPoints& points, const CellOccupancy& occupancy,
    const SamplingDistance& distance) const;
  static CellOccupancy occupancyOf(
    const RecordSpan& positions, const std::vector<Branch>& children);
  static OpenSubtree opened(const RecordSpan& records, Branch branch);
  SortedPoints sortedPoints(const RecordSpan& records, std::size_t count);
  RecordSpan positionsView() const;

  SamplingRule rule_;
  SubsetSampler sampler_;
  // Reused from part to part: fresh memory costs more than what is done with it.
  std::vector<TreePosition> positions_; // positions of the sorted points
  std::vector<std::uint32_t> candidates_;
  std::vector<std::uint32_t> chosen_;
};

} // namespace pointfront
