#pragma once

#include "pointfront/Neighbourhood/NeighbourList.h"

#include <vector>

namespace pointfront
{

/// What is searched for around each point.
struct NeighbourDemand
{
  std::uint32_t neighbours = 16; ///< the k nearest references; 0: all within `radius`
  double radius = 0.0;           ///< world units
  unsigned axes = 3;             ///< 2: distances are horizontal
};

/// The neighbours of points that lie close together: the places around their middle are looked up
/// once, then each point chooses among them, which is cheaper than to descend the tree for each.
/// Exact    the lists are those that the index gives. A place that was not looked up is farther
///          from the middle than the search went; a point for which that is not far enough is
///          searched for alone.
/// Eps      an approximate index is asked for twice: its lists depend on which points are together.
/// Threads  one a thread; the set and its index must live as long.
class NeighbourCluster
{
public:
  NeighbourCluster(
    const PositionSet& set, const NeighbourIndex& index, const NeighbourDemand& demand);

  /// Looks up what is around. All points that are searched for next are within `reach` of the
  /// middle, over the axes of the demand.
  void gather(const glm::dvec3& middle, double reach);
  /// Fills the list for one of them.
  void search(const glm::dvec3& from, NeighbourList& list);

private:
  void offerCandidates(const glm::dvec3& from, double squaredBound, NeighbourList& list);
  float safely(double squaredBound) const;
  std::size_t select(std::size_t count, float limit);
  double enoughWithin(std::size_t count, float limit) const;
  void sortSelected(std::size_t selected);
  double squaredBound(const glm::dvec3& from) const;
  double squaredDistance(const glm::dvec3& a, const glm::dvec3& b) const;
  void keepLast(const NeighbourList& list);

  const PositionSet& set_;
  const NeighbourIndex& index_;
  const NeighbourDemand demand_;
  glm::dvec3 middle_{ 0.0 };
  double searched_ = 0.0; ///< all places within this distance of the middle are candidates
  NeighbourList around_;  ///< of the middle
  NeighbourList within_;  ///< the ball
  std::vector<std::uint32_t> last_; ///< neighbours of the point before; none if there are too few

  // Candidates: an index into the set, and the place relative to the middle, for a first selection
  // four at a time.
  std::vector<std::uint32_t> candidates_;
  std::vector<float> x_;
  std::vector<float> y_;
  std::vector<float> z_;
  std::vector<float> squaredDistances_;
  std::vector<std::uint32_t> selected_;
  std::vector<std::uint32_t> sorted_;
};

} // namespace pointfront
