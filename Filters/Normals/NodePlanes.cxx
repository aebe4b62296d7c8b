#include "NodePlanes.h"

#include "FlannIndex.h"
#include "SurfaceFit.h"

#include "pointfront/Neighbourhood/NeighbourCluster.h"
#include "pointfront/Neighbourhood/TileSearch.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace pointfront
{
namespace
{
/// Points in a row along the curve that share what the index gives, and, of those, the ones that
/// share a choice from it (as in NearestNeighbours.cxx).
constexpr std::size_t longestGroup = 96;
constexpr std::size_t longestRun = 16;

/// Planes through the points [begin, end) of an order.
class PartPlanes
{
public:
  PartPlanes(const std::vector<TilePoint>& points, const PlaceOrder& order, std::size_t begin,
    std::size_t end, std::uint32_t neighbours)
    : points_(points)
    , neighbours_(neighbours)
    , list_(neighbours)
  {
    part_.points.assign(order.points.begin() + static_cast<std::ptrdiff_t>(begin),
      order.points.begin() + static_cast<std::ptrdiff_t>(end));
    part_.keys.assign(order.keys.begin() + static_cast<std::ptrdiff_t>(begin),
      order.keys.begin() + static_cast<std::ptrdiff_t>(end));
    collectReferences(points, part_, ClassSet().set(), 3, neighbours, places_);
  }

  void fill(std::vector<PackedNormal>& normals)
  {
    const FlannIndex index(places_, 0.0f);
    NeighbourCluster cluster(places_, index, { neighbours_, 0.0, 3 });
    for (std::size_t begin = 0; begin < part_.points.size();)
    {
      const std::size_t end = runEnd(part_.keys, begin, part_.keys.size(), longestGroup);
      const Ball group = ballAround(begin, end);
      cluster.gather(group.middle, group.reach);
      for (std::size_t run = begin; run < end;)
      {
        const std::size_t next = runEnd(part_.keys, run, end, longestRun);
        const Ball few = ballAround(run, next);
        cluster.focus(few.middle, few.reach);
        fillRun(run, next, cluster, normals);
        run = next;
      }
      begin = end;
    }
  }

private:
  struct Ball
  {
    glm::dvec3 middle{ 0.0 };
    double reach = 0.0;
  };

  const glm::dvec3& position(std::size_t place) const
  {
    return points_[part_.points[place]].position;
  }

  Ball ballAround(std::size_t begin, std::size_t end) const
  {
    Bounds bounds;
    for (std::size_t i = begin; i < end; ++i)
    {
      bounds.add(position(i));
    }
    const glm::dvec3 middle = bounds.centre();
    double reach = 0.0;
    for (std::size_t i = begin; i < end; ++i)
    {
      const glm::dvec3 out = position(i) - middle;
      reach = std::max(reach, glm::dot(out, out));
    }
    return { middle, std::sqrt(reach) };
  }

  void fillRun(std::size_t begin, std::size_t end, NeighbourCluster& cluster,
    std::vector<PackedNormal>& normals)
  {
    for (std::size_t i = begin; i < end; ++i)
    {
      PackedNormal& normal = normals[part_.points[i]];
      if (i > begin && position(i) == position(i - 1))
      {
        normal = normals[part_.points[i - 1]];
        continue;
      }
      double reach = 0.0;
      if (cluster.searchUnordered(position(i), chosen_, reach))
      {
        collectNear(places_, chosen_, position(i), near_);
      }
      else
      {
        cluster.search(position(i), list_);
        collectNear(places_, list_, neighbours_, near_);
      }
      const std::optional<SurfaceFit> fit = fitSurface(position(i), near_);
      normal = facingUp(packNormal(fit ? fit->normal : glm::dvec3(0.0)));
    }
  }

  const std::vector<TilePoint>& points_;
  std::uint32_t neighbours_;
  PlaceOrder part_;
  PositionSet places_;
  NeighbourList list_;
  std::vector<std::uint32_t> chosen_;
  std::vector<NearPoint> near_;
};
} // namespace

std::string NodePlanes::origin() const
{
  return "of planes through the " + std::to_string(neighbours_) + " nearest points of the node";
}

void NodePlanes::compute(
  const std::vector<glm::dvec3>& positions, std::vector<PackedNormal>& normals) const
{
  normals.assign(positions.size(), PackedNormal(0));
  std::vector<TilePoint> points(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    points[i] = { positions[i], TilePoint::keyOf(i, 0) };
  }
  const PlaceOrder order = placeOrder(points);
  const std::size_t parts = (points.size() + mostPoints - 1) / mostPoints;
  for (std::size_t part = 0; part < parts; ++part)
  {
    const std::size_t begin = part * points.size() / parts;
    const std::size_t end = (part + 1) * points.size() / parts;
    PartPlanes(points, order, begin, end, neighbours_).fill(normals);
  }
}

} // namespace pointfront
