#include "pointfront/Query/ConvexRegion.h"

#include <cmath>
#include <limits>
#include <utility>

namespace pointfront
{
namespace
{

/// The same expression for points and corners: it rounds monotonically along each axis, so that a
/// corner speaks for all points of its box.
double side(const glm::dvec4& plane, const glm::dvec3& p)
{
  return plane.x * p.x + plane.y * p.y + plane.z * p.z + plane.w;
}

/// The box's corner farthest along `direction`.
glm::dvec3 extreme(const Bounds& box, const glm::dvec3& direction)
{
  return { direction.x >= 0.0 ? box.high.x : box.low.x, direction.y >= 0.0 ? box.high.y : box.low.y,
    direction.z >= 0.0 ? box.high.z : box.low.z };
}

} // namespace

Result<std::shared_ptr<const ConvexRegion>> ConvexRegion::make(std::vector<glm::dvec4> planes)
{
  for (const glm::dvec4& plane : planes)
  {
    const bool finite = std::isfinite(plane.x) && std::isfinite(plane.y) &&
      std::isfinite(plane.z) && std::isfinite(plane.w);
    if (!finite || (plane.x == 0.0 && plane.y == 0.0 && plane.z == 0.0))
    {
      return makeError(Error::Kind::BadArgument,
        "a plane of a convex region has numbers that are not finite, or no normal");
    }
  }
  return std::shared_ptr<const ConvexRegion>(new ConvexRegion(std::move(planes)));
}

bool ConvexRegion::contains(const glm::dvec3& point) const
{
  for (const glm::dvec4& plane : planes_)
  {
    if (!(side(plane, point) >= 0.0))
    {
      return false;
    }
  }
  return true;
}

Overlap ConvexRegion::overlap(const Bounds& box) const
{
  if (box.empty())
  {
    return Overlap::Outside;
  }
  bool inside = true;
  for (const glm::dvec4& plane : planes_)
  {
    const glm::dvec3 normal(plane);
    if (!(side(plane, extreme(box, normal)) >= 0.0))
    {
      return Overlap::Outside;
    }
    inside = inside && side(plane, extreme(box, -normal)) >= 0.0;
  }
  return inside ? Overlap::Inside : Overlap::Crossing;
}

Bounds ConvexRegion::bounds() const
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return { glm::dvec3(-infinity), glm::dvec3(infinity) };
}

} // namespace pointfront
