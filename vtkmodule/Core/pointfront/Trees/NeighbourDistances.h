#pragma once

#include "pointfront/Records/RecordLayout.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace pointfront
{

/// How far points lie from their nearest neighbours, and how far from those next to them as they
/// are seen from above. On the ground both are the same; on a wall the second is far smaller.
/// Places  points that share one are no neighbours.
/// Cost    looks at all points for each of `asked` ones, evenly chosen.
struct NeighbourDistances
{
  static constexpr std::size_t asked = 32;

  /// `positions` in whole steps of `scale` world units.
  static NeighbourDistances of(const std::vector<TreePosition>& positions, const glm::dvec3& scale);

  double inSpace = 0.0; ///< median, world units; 0: all points are in one place
  double fromAbove = 0.0; ///< likewise
};

} // namespace pointfront
