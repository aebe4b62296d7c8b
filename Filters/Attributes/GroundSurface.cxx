#include "GroundSurface.h"

#include <glm/vec2.hpp>

#include <cmath>
#include <cstring>
#include <limits>

namespace pointfront
{
namespace
{
constexpr double steepest = 1.0;
/// Smallest to largest squared extent of ground points that have a plane.
constexpr double onOneLine = 1e-4;
} // namespace

double groundHeight(const glm::dvec3& place, const std::vector<NearPoint>& near)
{
  const double soft = 0.01 * near.back().squaredDistance + std::numeric_limits<double>::min();
  const auto weightOf = [soft](const NearPoint& point)
  { return point.count / (point.squaredDistance + soft); };
  double weights = 0.0;
  glm::dvec3 sum(0.0);
  for (const NearPoint& point : near)
  {
    weights += weightOf(point);
    sum += weightOf(point) * (point.position - place);
  }
  const glm::dvec3 mean = sum / weights;
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  double xz = 0.0;
  double yz = 0.0;
  for (const NearPoint& point : near)
  {
    const glm::dvec3 d = point.position - place - mean;
    const double weight = weightOf(point) / weights;
    xx += weight * d.x * d.x;
    xy += weight * d.x * d.y;
    yy += weight * d.y * d.y;
    xz += weight * d.x * d.z;
    yz += weight * d.y * d.z;
  }
  glm::dvec2 slope(0.0);
  const double determinant = xx * yy - xy * xy;
  if (determinant > onOneLine * (xx + yy) * (xx + yy))
  {
    slope = { (yy * xz - xy * yz) / determinant, (xx * yz - xy * xz) / determinant };
    const double steepness = std::sqrt(slope.x * slope.x + slope.y * slope.y);
    slope *= steepness > steepest ? steepest / steepness : 1.0;
  }
  return place.z + mean.z - slope.x * mean.x - slope.y * mean.y;
}

void HeightAboveGround::compute(
  const glm::dvec3& position, const std::vector<NearPoint>& near, std::byte* value) const
{
  const auto height =
    static_cast<float>(near.empty() ? 0.0 : position.z - groundHeight(position, near));
  std::memcpy(value, &height, sizeof height);
}

} // namespace pointfront
