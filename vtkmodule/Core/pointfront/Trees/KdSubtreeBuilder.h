#pragma once

#include "pointfront/Trees/EmittingBuilder.h"
#include "pointfront/Trees/ExactSampler.h"
#include "pointfront/Trees/KdCut.h"

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace pointfront
{

/// The balanced kd-tree over some points with `add` refinement, from the root down (LAYERS-1).
/// Shape     a node takes nodePoints of the points in its region, evenly spread (ExactSampler.h).
///           The rest is divided along the longest axis of its box so that the left has a whole
///           number of full nodes. All nodes have nodePoints points, but for one a tree. Equal
///           coordinates are divided by Morton order, then by input order.
/// Median    counts of the coordinates in some thousand intervals name the interval with the
///           median; only its points are searched (LAYERS-2).
/// Parts     first give the points that they owe to the nodes above them, from the root down. An
///           open subtree holds these points, in this order.
/// Source    Richter, Discher & Doellner 2015, sections 4.1 and 4.1.1.
class KdSubtreeBuilder final : public EmittingBuilder
{
public:
  /// `tree` and `shares`: the upper tree, and what each of its nodes owes (KdCut.h).
  KdSubtreeBuilder(const NodeEmitter& emitter, const KdRule& rule, std::size_t recordBytes,
    const std::vector<PartNode>& tree, const std::vector<std::vector<KdShare>>& shares)
    : EmittingBuilder(emitter, recordBytes)
    , rule_(rule)
    , tree_(tree)
    , shares_(shares)
  {
  }

  OpenSubtree build(std::vector<std::byte> records, std::size_t count, std::uint32_t node) override;
  OpenSubtree join(std::vector<OpenSubtree> children, std::uint32_t node) override;
  std::unique_ptr<BuiltNode> close(OpenSubtree subtree) override { return std::move(subtree.root); }

private:
  /// Points of active_, and how many more of the same region are in nodes above.
  struct Region
  {
    std::size_t begin = 0;
    std::size_t end = 0;
    double above = 0.0;
  };
  /// The records in Morton order, with their positions_; until the next call.
  RecordSpan sortedPoints(std::vector<std::byte> records, std::size_t count);
  /// The bits that each of some points differs in from the one before.
  void countSteps(const std::vector<std::uint32_t>& points);
  /// Moves `wanted` evenly spread points of a region to held_; the others stay, in order. Leaves
  /// in occupancy_ that of all of them.
  void take(Region& region, std::uint64_t wanted);
  std::vector<std::byte> owed(const RecordSpan& records, std::uint32_t node, Region& region);
  std::unique_ptr<BuiltNode> node(const RecordSpan& records, Region region);
  std::size_t divide(const Region& region);
  std::size_t separate(const Region& region, const std::pair<std::uint32_t, std::uint32_t>& first);
  unsigned longestAxis(const Region& region, std::uint32_t& low, std::uint32_t& high) const;
  double places(double drawn, double above) const;
  double spacing(double places) const;
  float splatRadius(const std::vector<std::uint32_t>& own, double ownPlaces, double places);

  KdRule rule_;
  const std::vector<PartNode>& tree_;
  const std::vector<std::vector<KdShare>>& shares_;
  ExactSampler sampler_;
  // Reused from part to part: fresh memory costs more than what is done with it.
  std::vector<TreePosition> positions_; // positions of the sorted records
  std::vector<std::uint32_t> active_; // numbers of those that no node has yet, region by region
  std::vector<std::uint8_t> steps_; // bits that each of active_ differs in from the one before
  std::vector<std::uint32_t> points_; // points of the region at hand
  CellOccupancy occupancy_; // occupancy of points_
  std::vector<std::uint32_t> held_; // points that take() took
  std::vector<std::uint32_t> coordinates_; // coordinates of active_, along the axis at hand
  std::vector<std::uint32_t> right_;
  std::vector<std::uint8_t> rightSteps_;
  std::vector<std::uint32_t> chosen_; // places in points_
};

} // namespace pointfront
