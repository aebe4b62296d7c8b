#pragma once

#include "pointfront/Records/RecordLayout.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace pointfront
{

/// How much surface some points lie on, and how much of it is seen from above. A wall has much of
/// the first and hardly any of the second.
/// Measure  counts the cubes that hold points, of the largest edge at which an eighth as many as
///          points do. Points in a volume have the area of these cubes' faces.
/// Cost     that of at most `mostLookedAt` points, evenly chosen.
struct CoveredArea
{
  static constexpr std::size_t mostLookedAt = 1024;

  /// `positions` in whole steps of `scale` world units.
  static CoveredArea of(const std::vector<TreePosition>& positions, const glm::dvec3& scale);

  double surface = 0.0; ///< square world units; 0: all points are in one place
  double fromAbove = 0.0; ///< the same of their squares in the plane
};

} // namespace pointfront
