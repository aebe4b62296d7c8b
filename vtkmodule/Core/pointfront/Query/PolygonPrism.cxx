#include "pointfront/Query/PolygonPrism.h"

#include "pointfront/Query/Orientation.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace pointfront
{
namespace
{

/// True if the closed segment meets the closed rectangle: no line along an axis, and not the
/// segment's own line, has them on different sides.
bool segmentMeets(
  const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& low, const glm::dvec2& high)
{
  if (std::max(a.x, b.x) < low.x || std::min(a.x, b.x) > high.x || std::max(a.y, b.y) < low.y ||
    std::min(a.y, b.y) > high.y)
  {
    return false;
  }
  const int first = orientation(a, b, low);
  return first == 0 || orientation(a, b, high) != first ||
    orientation(a, b, { low.x, high.y }) != first || orientation(a, b, { high.x, low.y }) != first;
}

bool isPlace(const glm::dvec2& vertex)
{
  return std::abs(vertex.x) <= PolygonPrism::farthest &&
    std::abs(vertex.y) <= PolygonPrism::farthest; // NaN is not
}

} // namespace

Result<std::shared_ptr<const PolygonPrism>> PolygonPrism::make(
  const std::vector<PlanarPolygon>& polygons, const std::array<double, 2>& heights)
{
  if (std::isnan(heights[0]) || std::isnan(heights[1]))
  {
    return makeError(Error::Kind::BadArgument, "a height of a polygon's prism is no number");
  }
  std::shared_ptr<PolygonPrism> prism(new PolygonPrism);
  prism->heights_ = heights;
  for (const PlanarPolygon& from : polygons)
  {
    Polygon polygon;
    for (const PlanarLine& ring : from.rings)
    {
      const bool closed = ring.size() > 1 && ring.front() == ring.back();
      const std::size_t count = ring.size() - (closed ? 1 : 0);
      if (count < 3 || !std::all_of(ring.begin(), ring.end(), isPlace))
      {
        return makeError(Error::Kind::BadArgument,
          "a ring of a polygon has fewer than three vertices, or one that is not finite");
      }
      for (std::size_t i = 0; i < count; ++i)
      {
        polygon.edges.push_back({ ring[i], ring[(i + 1) % count] });
        polygon.low = glm::min(polygon.low, ring[i]);
        polygon.high = glm::max(polygon.high, ring[i]);
      }
    }
    if (!polygon.edges.empty() && heights[0] <= heights[1])
    {
      prism->bounds_.add(glm::dvec3(polygon.low, heights[0]));
      prism->bounds_.add(glm::dvec3(polygon.high, heights[1]));
      prism->polygons_.push_back(std::move(polygon));
    }
  }
  return std::shared_ptr<const PolygonPrism>(std::move(prism));
}

/// Edges that a ray towards +x crosses, each with its lower end and without its upper one, so that
/// a vertex on the ray counts once.
bool PolygonPrism::insidePolygon(const std::vector<Edge>& edges, const glm::dvec2& p)
{
  bool inside = false;
  for (const Edge& edge : edges)
  {
    const glm::dvec2& a = edge.from;
    const glm::dvec2& b = edge.to;
    if (a == p)
    {
      return true;
    }
    const bool above = a.y > p.y;
    if (above == (b.y > p.y))
    {
      if (a.y == p.y && b.y == p.y && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x))
      {
        return true; // on a horizontal edge
      }
      continue;
    }
    if (p.x < std::min(a.x, b.x))
    {
      inside = !inside;
    }
    else if (p.x <= std::max(a.x, b.x))
    {
      const int side = above ? -orientation(a, b, p) : orientation(a, b, p);
      if (side == 0)
      {
        return true;
      }
      inside = inside != (side > 0);
    }
  }
  return inside;
}

bool PolygonPrism::contains(const glm::dvec3& point) const
{
  if (!bounds_.contains(point))
  {
    return false;
  }
  const glm::dvec2 place(point);
  return std::any_of(polygons_.begin(), polygons_.end(),
    [&place](const Polygon& polygon) { return insidePolygon(polygon.edges, place); });
}

Overlap PolygonPrism::overlapPolygon(
  const Polygon& polygon, const glm::dvec2& low, const glm::dvec2& high)
{
  if (polygon.low.x > high.x || polygon.high.x < low.x || polygon.low.y > high.y ||
    polygon.high.y < low.y)
  {
    return Overlap::Outside;
  }
  const bool crossed = std::any_of(polygon.edges.begin(), polygon.edges.end(),
    [&](const Edge& edge) { return segmentMeets(edge.from, edge.to, low, high); });
  if (crossed)
  {
    return Overlap::Crossing;
  }
  return insidePolygon(polygon.edges, low) ? Overlap::Inside : Overlap::Outside;
}

Overlap PolygonPrism::overlap(const Bounds& box) const
{
  if (polygons_.empty() || box.empty() || !bounds_.overlaps(box))
  {
    return Overlap::Outside;
  }
  Overlap most = Overlap::Outside;
  for (const Polygon& polygon : polygons_)
  {
    most = std::max(most, overlapPolygon(polygon, glm::dvec2(box.low), glm::dvec2(box.high)));
  }
  const bool between = box.low.z >= heights_[0] && box.high.z <= heights_[1];
  return most == Overlap::Inside && !between ? Overlap::Crossing : most;
}

void PolygonPrism::keepInside(
  const Bounds& box, const glm::dvec3* points, std::size_t count, std::uint8_t* keep) const
{
  std::vector<std::vector<Edge>> nearby;
  for (const Polygon& polygon : polygons_)
  {
    std::vector<Edge> edges;
    std::copy_if(polygon.edges.begin(), polygon.edges.end(), std::back_inserter(edges),
      [&box](const Edge& edge)
      {
        return std::max(edge.from.y, edge.to.y) >= box.low.y &&
          std::min(edge.from.y, edge.to.y) <= box.high.y &&
          std::max(edge.from.x, edge.to.x) >= box.low.x;
      });
    if (!edges.empty())
    {
      nearby.push_back(std::move(edges));
    }
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    if (keep[i] != 0)
    {
      const glm::dvec2 place(points[i]);
      const bool inside = points[i].z >= heights_[0] && points[i].z <= heights_[1] &&
        std::any_of(nearby.begin(), nearby.end(),
          [&place](const std::vector<Edge>& edges) { return insidePolygon(edges, place); });
      keep[i] = inside ? 1 : 0;
    }
  }
}

} // namespace pointfront
