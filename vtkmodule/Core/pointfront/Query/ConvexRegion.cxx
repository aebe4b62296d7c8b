#include "pointfront/Query/ConvexRegion.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
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

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t mostPlanes = 24; ///< for an extent, whose cost grows with their third power
constexpr double leastVolume = 1e-9; ///< that three unit normals span, or they count as parallel
constexpr double rounding = 1e-11;

/// How far the space behind some of three planes reaches along a direction; infinity: they do not
/// end it. By duality: of weights w >= 0 with -(w0 n0 + w1 n1 + w2 n2) = direction, each p inside
/// has direction.p <= w0 d0 + w1 d1 + w2 d2. What stands in for planes behind the first `count` has
/// no weight.
double reachOf(
  const std::array<glm::dvec4, 3>& planes, int count, const glm::dvec3& direction, double scale)
{
  const glm::dmat3 normals{ glm::dvec3(planes[0]), glm::dvec3(planes[1]), glm::dvec3(planes[2]) };
  if (!(std::abs(glm::determinant(normals)) > leastVolume))
  {
    return infinity;
  }
  const glm::dvec3 weights = -(glm::inverse(normals) * direction);
  double reach = 0.0;
  double sum = 1.0;
  for (int i = 0; i < 3; ++i)
  {
    if (weights[i] < -rounding || (i >= count && weights[i] > rounding))
    {
      return infinity;
    }
    reach += weights[i] * planes[i].w;
    sum += std::abs(weights[i]);
  }
  return reach + rounding * scale * sum;
}

/// Cuts off what lies beyond some of three planes.
void cut(Bounds& box, const std::array<glm::dvec4, 3>& planes, int count, double scale)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    glm::dvec3 up(0.0);
    up[axis] = 1.0;
    box.high[axis] = std::min(box.high[axis], reachOf(planes, count, up, scale));
    box.low[axis] = std::max(box.low[axis], -reachOf(planes, count, -up, scale));
  }
}

glm::dvec4 across(const glm::dvec4& one, const glm::dvec4& other)
{
  const glm::dvec3 normal = glm::cross(glm::dvec3(one), glm::dvec3(other));
  const double length = glm::length(normal);
  return length > leastVolume ? glm::dvec4(normal / length, 0.0) : glm::dvec4(0.0);
}

/// Along the axis that is farthest from a direction.
glm::dvec4 aside(const glm::dvec4& direction)
{
  const glm::dvec3 size = glm::abs(glm::dvec3(direction));
  const int least = size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2;
  glm::dvec4 axis(0.0);
  axis[least] = 1.0;
  return axis;
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
  Bounds box{ glm::dvec3(-infinity), glm::dvec3(infinity) };
  if (planes_.size() > mostPlanes)
  {
    return box;
  }
  std::vector<glm::dvec4> unit;
  double scale = 0.0; // the largest coordinate, about
  for (const glm::dvec4& plane : planes_)
  {
    unit.push_back(plane / glm::length(glm::dvec3(plane)));
    scale = std::max(scale, std::abs(unit.back().w));
  }
  for (std::size_t i = 0; i < unit.size(); ++i)
  {
    const glm::dvec4 beside = across(unit[i], aside(unit[i]));
    cut(box, { unit[i], beside, across(unit[i], beside) }, 1, scale);
    for (std::size_t j = i + 1; j < unit.size(); ++j)
    {
      cut(box, { unit[i], unit[j], across(unit[i], unit[j]) }, 2, scale);
      for (std::size_t k = j + 1; k < unit.size(); ++k)
      {
        cut(box, { unit[i], unit[j], unit[k] }, 3, scale);
      }
    }
  }
  return box;
}

} // namespace pointfront
