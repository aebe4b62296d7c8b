#pragma once

#include "pointfront/Points/QuantisationGrid.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace pointfront
{

/// Where the frame's reference point (the eye) lies in one node's integer coordinates: what the
/// vertex shader subtracts. See docs/adr/0004 and glsl/PointsVS.glsl.
/// Units      `halfSize` of the node's box in store units.
/// Exactness  integer difference exact; the remainder `base` is computed in double, offset minus
///            reference first: both are large and near each other, so that difference loses
///            nothing.
struct SlotOrigin
{
  glm::ivec3 steps{ 0 }; ///< reference in (shifted) steps from the node's origin, within +-2^30
  int shift = 0; ///< bits dropped of positions of nodes of more than 2^30 steps
  glm::vec3 base{ 0.0f }; ///< rest of rounding and clamping, store units

  static SlotOrigin of(const QuantisationGrid& grid, const glm::vec3& halfSize,
    const GridPosition& origin, const glm::dvec3& reference)
  {
    constexpr double most = 1073741824.0; // 2^30
    SlotOrigin result;
    const glm::dvec3 extent = 2.0 * glm::dvec3(halfSize) / grid.scale;
    // Positions have 32 bits: what claims a larger extent is damaged.
    constexpr int mostBits = 32;
    for (double steps = std::max({ extent.x, extent.y, extent.z });
         steps > most && result.shift < mostBits; steps *= 0.5)
    {
      ++result.shift;
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      const double step = std::ldexp(grid.scale[axis], result.shift);
      const double fromOffset = grid.offset[axis] - reference[axis];
      const double ahead = fromOffset + grid.scale[axis] * static_cast<double>(origin[axis]);
      const double rounded = std::clamp(std::round(-ahead / step), -most, most);
      result.steps[axis] = static_cast<int>(rounded);
      const std::int64_t width = std::int64_t(1) << result.shift;
      const std::int64_t whole = origin[axis] + width * result.steps[axis];
      result.base[axis] =
        static_cast<float>(fromOffset + grid.scale[axis] * static_cast<double>(whole));
    }
    return result;
  }

  /// Twin of positionMC() in PointsVS.glsl: position relative to the reference, store units.
  glm::vec3 relative(const glm::u32vec3& position, const glm::vec3& stepSize) const
  {
    glm::vec3 result;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int difference = static_cast<int>(position[axis] >> shift) - steps[axis];
      result[axis] =
        static_cast<float>(difference) * (stepSize[axis] * std::exp2(static_cast<float>(shift))) +
        base[axis];
    }
    return result;
  }
};

} // namespace pointfront
