#include "pointfront/Front/ScreenError.h"

namespace pointfront
{

double distanceToStretched(const View& view, const glm::dvec3& centre, double radius)
{
  const ModelStretch& stretch = *view.stretch;
  const glm::dvec3 fromEye = stretch.toWorld * (centre - view.position);
  const double length = glm::length(fromEye);
  if (view.parallel || length == 0.0)
  {
    return std::max(
      0.0, glm::dot(fromEye, stretch.direction) - radius * stretch.along(stretch.direction));
  }
  // No point of the stretched sphere is nearer than its plane across the ray.
  const glm::dvec3 ray = fromEye / length;
  const double distance = length - radius * stretch.along(ray);
  return distance > 0.0 ? distance / stretch.across(ray) : 0.0;
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
