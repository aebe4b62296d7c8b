#include "GeoTransform.h"

#include <cmath>

namespace pointfront
{

std::optional<GeoTransform> GeoTransform::fromCorner(
  const glm::dvec2& origin, const glm::dvec2& u, const glm::dvec2& v)
{
  GeoTransform made;
  made.origin_ = origin;
  made.u_ = u;
  made.v_ = v;
  made.determinant_ = u.x * v.y - u.y * v.x;
  const bool usable = std::isfinite(origin.x + origin.y) && std::isnormal(made.determinant_);
  return usable ? std::optional<GeoTransform>(made) : std::nullopt;
}

std::optional<GeoTransform> GeoTransform::fromCentre(
  const glm::dvec2& centre, const glm::dvec2& u, const glm::dvec2& v)
{
  return fromCorner({ centre.x - 0.5 * (u.x + v.x), centre.y - 0.5 * (u.y + v.y) }, u, v);
}

} // namespace pointfront
