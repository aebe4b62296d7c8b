#pragma once

#include "pointfront/Front/View.h"
#include "pointfront/Store/Hierarchy.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace pointfront
{

/// Where a bounding sphere lies with respect to the frustum.
enum class Visibility
{
  Outside, ///< no part of the sphere can be seen
  Inside ///< some part may be seen
};

/// FRONT-4: frustum test by bounding sphere: six plane distances. Conservative: a sphere near an
/// edge of the frustum may be called Inside, one that can be seen is never called Outside. Inline,
/// like the next functions, because each update calls it for each node of a front.
inline Visibility sphereVisibility(const View& view, const glm::dvec3& centre, double radius)
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

/// distanceToSphere() of a model whose matrix stretches it.
double distanceToStretched(const View& view, const glm::dvec3& centre, double radius);

/// Distance from the eye to a sphere, world units, 0 when the eye is inside. Parallel views have
/// no eye: there it is the depth along the line of sight. Where the view stretches lengths across
/// the ray to the sphere, the distance is as many times shorter as they are longer.
inline double distanceToSphere(const View& view, const glm::dvec3& centre, double radius)
{
  if (view.stretch)
  {
    return distanceToStretched(view, centre, radius);
  }
  const glm::dvec3 fromEye = centre - view.position;
  const double distance = view.parallel ? glm::dot(fromEye, view.direction) : glm::length(fromEye);
  return distance > radius ? distance - radius : 0.0; // a NaN gives 0: first rather than lost
}

/// This keeps the order of nodes monotone and every sum of errors finite, even with an eye inside a
/// node and a near plane of 1e-300.
constexpr double largestErrorPx = 1e30;

/// Pixels that `spacing` world units cover at `distance` (never nearer than the near plane).
/// Always finite and not negative; 0 for a spacing that is not positive or not a number.
inline double projectedSpacing(const View& view, double spacing, double distance)
{
  if (!(spacing > 0.0))
  {
    return 0.0;
  }
  const double nearest = view.parallel ? 1.0 : std::max(view.nearDistance, distance);
  const double pixels = spacing * view.pixelsPerUnit / nearest;
  return pixels < largestErrorPx ? pixels : largestErrorPx;
}

/// FRONT-4: the projected point spacing (PPS) of a node, in pixels: its spacing, projected at the
/// point of its bounding sphere that is nearest to the eye (never nearer than the near plane).
/// The paper gives PPS in words only, as the pixels that the node's sphere covers, for nodes of one
/// representative; our nodes are chunks, so we project the spacing between their points.
double screenError(const View& view, const Node& node);

/// Distance from the eye to the node's sphere, 0 when inside it; world units.
double distanceToNode(const View& view, const Node& node);

} // namespace pointfront
