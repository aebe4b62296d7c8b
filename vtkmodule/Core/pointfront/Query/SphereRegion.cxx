#include "pointfront/Query/SphereRegion.h"

#include <glm/common.hpp>

#include <cmath>
#include <limits>

namespace pointfront
{
namespace
{

/// Rounding never turns a larger distance along an axis into a smaller sum: what holds of the
/// nearest and farthest corner of a box holds of its points, to the last bit.
double squaredLength(const glm::dvec3& v)
{
  return v.x * v.x + v.y * v.y + v.z * v.z;
}

} // namespace

Result<std::shared_ptr<const SphereRegion>> SphereRegion::make(
  const glm::dvec3& centre, double radius)
{
  const bool finite = std::isfinite(centre.x) && std::isfinite(centre.y) &&
    std::isfinite(centre.z) && std::isfinite(radius);
  if (!finite || radius < 0.0)
  {
    return makeError(Error::Kind::BadArgument,
      "a sphere's centre and radius are finite, and its radius is 0 or more");
  }
  return std::shared_ptr<const SphereRegion>(new SphereRegion(centre, radius));
}

bool SphereRegion::contains(const glm::dvec3& point) const
{
  return squaredLength(point - centre_) <= radius_ * radius_;
}

Overlap SphereRegion::overlap(const Bounds& box) const
{
  if (box.empty() || !contains(glm::clamp(centre_, box.low, box.high)))
  {
    return Overlap::Outside;
  }
  const glm::dvec3 farthest = glm::max(glm::abs(box.low - centre_), glm::abs(box.high - centre_));
  return squaredLength(farthest) <= radius_ * radius_ ? Overlap::Inside : Overlap::Crossing;
}

Bounds SphereRegion::bounds() const
{
  // One step outwards: rounding must not cut off a point.
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double reach = std::nextafter(radius_, infinity);
  Bounds box;
  for (int axis = 0; axis < 3; ++axis)
  {
    box.low[axis] = std::nextafter(centre_[axis] - reach, -infinity);
    box.high[axis] = std::nextafter(centre_[axis] + reach, infinity);
  }
  return box;
}

} // namespace pointfront
