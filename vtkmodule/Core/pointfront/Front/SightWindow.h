#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>

namespace pointfront
{

/// A part of a view in which a layer is seen: what a lens shows (LAYERS-10).
struct SightWindow
{
  /// Left, right, bottom, top, as View::planes.
  std::array<glm::dvec4, 4> planes{};
  /// How far a node's points are seen from where they are: in the node's spacings, and in world
  /// units.
  double reachSpacings = 0.0;
  double reach = 0.0;

  bool sees(const glm::dvec3& centre, double radius, double spacing) const
  {
    const double most = radius + reach + reachSpacings * std::max(0.0, spacing);
    return std::all_of(planes.begin(), planes.end(),
      [&](const glm::dvec4& plane)
      { return glm::dot(glm::dvec3(plane), centre) + plane.w >= -most; });
  }
};

inline bool operator==(const SightWindow& a, const SightWindow& b)
{
  return a.planes == b.planes && a.reachSpacings == b.reachSpacings && a.reach == b.reach;
}

} // namespace pointfront
