#pragma once

#include "pointfront/Neighbourhood/NearestNeighbours.h"

namespace pointfront
{

class KnownRegion;

/// The points of one tile in an order that is the same whatever order they came in: along a Morton
/// curve, places at the same step of it by positionLess(). Neighbours in space are neighbours in
/// memory, which halves the time of searches in a row.
struct PlaceOrder
{
  std::vector<std::uint32_t> points; ///< indices into the tile's
  std::vector<std::uint64_t> keys; ///< steps of the curve
};
PlaceOrder placeOrder(const std::vector<TilePoint>& points);

/// Those of the points that are searched for: in `queries`, among the first `own`, and wanted of
/// the region if there is one.
PlaceOrder queriesOf(const PlaceOrder& order, const std::vector<TilePoint>& points, std::size_t own,
  const ClassSet& queries, const KnownRegion* region);

/// Where the run of points close together ends that begins at `begin`: at `end`, or after
/// `longest` / 2 to `longest` points, where the curve leaves the largest cell.
std::size_t runEnd(
  const std::vector<std::uint64_t>& keys, std::size_t begin, std::size_t end, std::size_t longest);

/// The places of the references among `points`, taken in `order`. With two axes, points above one
/// another are one place: the lowest.
void collectReferences(const std::vector<TilePoint>& points, const PlaceOrder& order,
  const ClassSet& references, unsigned axes, std::uint32_t mostCount, PositionSet& set);

/// The entries of a list as points, in its order, with no more than `wanted` points in all (0: any
/// number).
void collectNear(const PositionSet& set, const NeighbourList& list, std::uint32_t wanted,
  std::vector<NearPoint>& near);

/// Places with one point each as neighbours of `from`.
void collectNear(const PositionSet& set, const std::vector<std::uint32_t>& places,
  const glm::dvec3& from, std::vector<NearPoint>& near);

/// A point whose neighbours may lie outside of the box that its tile gathered.
struct UnfinishedPoint
{
  TilePoint point;
  double squaredReach = 0.0; ///< its neighbours are within this squared distance
};

/// Squared distance from p to the space outside of the box, rounded down; infinite if the box is
/// all of space.
double squaredClearance(const Bounds& box, const glm::dvec3& p);
/// Squared distance from p to the nearest and to the farthest point of a box, over some axes.
double squaredDistanceTo(const Bounds& box, const glm::dvec3& p, unsigned axes);
double squaredDistanceAcross(const Bounds& box, const glm::dvec3& p, unsigned axes);

} // namespace pointfront
