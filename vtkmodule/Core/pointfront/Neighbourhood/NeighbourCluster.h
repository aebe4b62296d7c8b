#pragma once

#include "pointfront/Neighbourhood/NeighbourList.h"
#include "pointfront/Neighbourhood/PlaceSelection.h"

#include <vector>

namespace pointfront
{

/// The neighbours that are searched for around each point.
struct NeighbourSearch
{
  std::uint32_t neighbours = 16; ///< the k nearest references; 0: all within `radius`
  double radius = 0.0; ///< world units
  unsigned axes = 3; ///< 2: distances are horizontal
};

/// Finds the neighbours of points that lie close together. It looks up the places around the middle
/// of a group once, picks from them the places around a few points of the group, and lets each
/// point choose among these. That is cheaper than to descend the tree for each point.
/// Exact    the lists equal those of the index. Places that were not looked up lie beyond the range
///          of the search around the middle; a point that may need them is searched alone.
/// Eps      an approximate index is asked once or twice for a group: its lists depend on which
///          points are together.
/// Threads  one a thread; the set and its index must live as long.
class NeighbourCluster
{
public:
  NeighbourCluster(
    const PositionSet& set, const NeighbourIndex& index, const NeighbourSearch& search);

  /// Looks up the places around a group. All points that are searched next lie within `reach` of
  /// the middle, over the axes of the search.
  void gather(const glm::dvec3& middle, double reach);
  /// Picks the places around some points of the group, which are the points that are searched next.
  void focus(const glm::dvec3& middle, double reach);
  /// Fills the list for one of them.
  void search(const glm::dvec3& from, NeighbourList& list);
  /// The places of that list, in any order, without it; all of them are at most squaredReach away.
  /// False where rounding, places with several points, or what was looked up does not let them be
  /// told apart so easily: ask for the list then.
  bool searchUnordered(
    const glm::dvec3& from, std::vector<std::uint32_t>& places, double& squaredReach);

private:
  void lookUp(const glm::dvec3& middle, double reach, double widened, PlaceBall& ball);
  void pick();
  bool searchBall(const PlaceBall& ball, const glm::dvec3& from, NeighbourList& list);
  void chooseNearest(const PlaceBall& ball, const glm::dvec3& from, NeighbourList& list);
  bool chooseExactly(const PlaceBall& ball, const glm::dvec3& from,
    std::vector<std::uint32_t>& places, double& squaredReach);
  float limitAmongAll(std::size_t fewest, std::size_t most) const;
  double squaredDistance(const glm::dvec3& a, const glm::dvec3& b) const;

  const PositionSet& set_;
  const NeighbourIndex& index_;
  const NeighbourSearch search_;
  PlaceBall group_;
  PlaceBall few_;
  const PlaceBall* around_ = &group_; ///< that points choose from
  NeighbourList nearest_; ///< nearest of a middle
  NeighbourList within_; ///< a ball
  float likely_ = 0.0f; ///< squared distance to the last neighbour
  PlaceSelection selection_;
  std::vector<NeighbourList::Entry> chosen_;
};

} // namespace pointfront
