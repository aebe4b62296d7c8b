#pragma once

#include "pointfront/Neighbourhood/NeighbourList.h"
#include "pointfront/Neighbourhood/PointColumn.h"
#include "pointfront/Neighbourhood/PointTiles.h"

#include <functional>
#include <memory>
#include <vector>

namespace pointfront
{

/// A neighbour of a point, or several at one place.
struct NearPoint
{
  glm::dvec3 position{ 0.0 };
  double squaredDistance = 0.0;
  std::uint32_t count = 1;
};

/// A value that is computed for a point from its neighbours. Threads: compute() and copied() from
/// any.
class NeighbourhoodFeature
{
public:
  virtual ~NeighbourhoodFeature() = default;
  virtual std::size_t bytes() const = 0; ///< size of a value
  /// True if the value has the same bytes in whatever order the neighbours come: then they are not
  /// sorted, which is much of the time of a search.
  virtual bool orderFree() const { return false; }
  /// `near`: nearest first, ties by positionLess(), or in any order; the point itself is among them
  /// if it is a reference. Their counts sum up to the neighbours wanted, or fewer when there are no
  /// more.
  virtual void compute(
    const glm::dvec3& position, const std::vector<NearPoint>& near, std::byte* value) const = 0;
  /// Another point lies where one was computed, and got a copy of its value. For those who count.
  virtual void copied(const std::byte* /*value*/) const {}
};

/// Makes the search structure over the places of a tile.
using IndexMaker = std::function<std::unique_ptr<NeighbourIndex>(const PositionSet&)>;

struct NeighbourhoodOptions
{
  std::uint32_t neighbours = 16; ///< the k nearest references; 0: all within `radius`
  double radius = 0.0; ///< world units
  unsigned axes = 3; ///< 2: distances are horizontal
  Participants participants;
  std::uint64_t tilePoints = 1u << 17;
  const char* phase = "neighbourhoods"; ///< for the user, a string literal
};

/// Computes a feature of every query from its nearest references among all sources, out of core.
/// Exact    with an exact index the values do not depend on tiles, memory, threads or the order of
///          the points: a point is final only if its last neighbour is nearer than every place that
///          its tile did not gather. The other points are searched in a second round, in all tiles
///          within their reach. With an approximate index they depend on the points and tilePoints
///          alone.
/// Part     if the sources are a part of a cloud, only the values that resources.known wants are
///          computed, and it gets the distance of each one's last neighbour. Others are zero.
/// Speed    points in a row along a Morton curve share a search (NeighbourCluster).
/// Memory   a tile a thread and the points of the second round: under resources.memoryBytes.
/// Errors   those of PointTiles and of the sources; NoMemory; Cancelled.
Result<std::unique_ptr<PointColumn>> computeFromNeighbours(const PointSources& sources,
  const InputOrder& order, const NeighbourhoodOptions& options, const IndexMaker& makeIndex,
  const NeighbourhoodFeature& feature, const PassResources& resources);

} // namespace pointfront
