#include "pointfront/Front/ScreenError.h"

#include <algorithm>
#include <cmath>

namespace pointfront
{
namespace
{

/// The order of nodes stays monotone and every sum of errors finite, also with an eye inside a
/// node and a near plane of 1e-300.
constexpr double largestErrorPx = 1e30;

} // namespace

Visibility sphereVisibility(const View& view, const glm::dvec3& centre, double radius)
{
  for (const glm::dvec4& plane : view.planes)
  {
    if (glm::dot(glm::dvec3(plane), centre) + plane.w < -radius)
    {
      return Visibility::Outside;
    }
  }
  return Visibility::Inside;
}

double distanceToSphere(const View& view, const glm::dvec3& centre, double radius)
{
  const glm::dvec3 fromEye = centre - view.position;
  const double distance =
    view.parallel ? glm::dot(fromEye, view.direction) : glm::length(fromEye);
  return distance > radius ? distance - radius : 0.0; // a NaN gives 0: first rather than lost
}

double projectedSpacing(const View& view, double spacing, double distance)
{
  if (!(spacing > 0.0))
  {
    return 0.0;
  }
  const double nearest = view.parallel ? 1.0 : std::max(view.nearDistance, distance);
  const double pixels = spacing * view.pixelsPerUnit / nearest;
  return pixels < largestErrorPx ? pixels : largestErrorPx;
}

double screenError(const View& view, const Node& node)
{
  return projectedSpacing(view, node.spacing, distanceToNode(view, node));
}

double distanceToNode(const View& view, const Node& node)
{
  return distanceToSphere(view, node.centre, node.radius);
}

} // namespace pointfront
