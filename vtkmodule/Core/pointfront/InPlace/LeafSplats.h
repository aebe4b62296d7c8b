#pragma once

#include "pointfront/InPlace/GridRecords.h"
#include "pointfront/InPlace/QuadTree.h"
#include "pointfront/Points/QuantisationGrid.h"
#include "pointfront/Store/Hierarchy.h"
#include "pointfront/Trees/NeighbourDistances.h"
#include "pointfront/Trees/NodeSplat.h"
#include "pointfront/Trees/SparseLeaves.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace pointfront
{

/// How large splats of an in-place tree must be, and how many points share a place.
/// Leaves  some, evenly over the table, are measured (NodeSplat.h): the ratio of radius and spacing
///         is a trait of how a scanner works. The others have the ratio of those beside them.
/// Inner   nodes draw points at random: a constant ratio.
/// Upright squares hold more surface than their area where walls stand in them: as much more as in
///         the measured leaves beside them, which NeighbourDistances.h tells.
/// Places  of the measured leaves, against their points: all nodes have that share.
/// Cost    that of at most `mostMeasured` leaves, whatever the file holds.
/// Threads one.
class LeafSplats
{
public:
  static constexpr std::size_t mostMeasured = 96;

  /// `released` gets the records [begin, end) that were read: their pages need not stay in memory.
  LeafSplats(const QuadTree& tree, const GridRecords& records, const QuantisationGrid& grid,
    std::function<void(std::uint64_t, std::uint64_t)> released);
  /// Called with the list of each node, in any order.
  void look(NodeIndex node, const std::vector<std::byte>& list);
  /// Called after the lists of all nodes, before what follows.
  void finish();
  void fill(std::vector<Node>& nodes) const;
  /// World units between neighbours of what is drawn of a node and those above it, where they are
  /// sparse.
  double spacing(NodeIndex node) const;

private:
  /// As if each point had a place of its own.
  double pointSpacing(NodeIndex node) const;
  /// World units between neighbours of what is drawn of a node and those above it.
  double meanSpacing(NodeIndex node) const;
  SparseLeaves sparseLeaves() const;
  /// The mean of the measured leaves before and behind a leaf, its own if it is measured; 0: they
  /// have none.
  double nearby(const std::vector<double>& ofMeasured, NodeIndex leaf) const;
  bool isSlice(NodeIndex node) const;
  /// Surface in a measured leaf's square, of the square's area.
  double liftOf(NodeIndex leaf, const NeighbourDistances& distances) const;

  const QuadTree& tree_;
  const GridRecords& records_;
  std::function<void(std::uint64_t, std::uint64_t)> released_;
  glm::dvec3 scale_;
  double stepArea_; ///< area of a step by a step of the grid, world units
  NodeSplat splat_;
  std::vector<NodeIndex> measured_; ///< leaves, ascending
  std::vector<double> radii_; ///< theirs, then their ratios to pointSpacing(); 0: none was found
  std::vector<double> lifts_; ///< theirs: surface in their squares, of the squares' area
  std::vector<double> nodeLifts_; ///< that of each node
  SparseLeaves sparse_{ {} };
  std::uint64_t points_ = 0; ///< theirs
  std::uint64_t places_ = 0;
};

} // namespace pointfront
