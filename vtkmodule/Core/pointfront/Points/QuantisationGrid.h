#pragma once

#include <glm/vec3.hpp>

#include <cmath>
#include <cstdint>

namespace pointfront
{

using GridPosition = glm::vec<3, std::int64_t, glm::defaultp>;

/// World units from the origin beyond which nothing is a position: a double there resolves steps of
/// an eighth at best.
constexpr double farthestCoordinate = 1e15;

/// The steps from the origin that every grid of our own choice stays below: half of what
/// QuantisationGrid is exact for, so that a LAS file with the same steps is exact as well.
constexpr double mostStepsInDouble = 1125899906842624.0; // 2^50

/// The integer grid that coordinates live on: world = offset + scale * grid, for each axis.
/// Exactness  toGrid(toWorld(g)) == g while |world| / scale < 2^51: rounding to nearest undoes the
///            two roundings of toWorld. This is why double world coordinates lose nothing on
///            their way from a LAS file into a store of the same scale and offset.
struct QuantisationGrid
{
  glm::dvec3 scale{ 0.001 }; ///< world units a step, > 0
  glm::dvec3 offset{ 0.0 }; ///< world coordinates of grid position 0

  glm::dvec3 toWorld(const GridPosition& g) const
  {
    return { offset.x + scale.x * static_cast<double>(g.x),
      offset.y + scale.y * static_cast<double>(g.y),
      offset.z + scale.z * static_cast<double>(g.z) };
  }
  /// Nearest grid position. The caller has checked that p is finite and in range.
  GridPosition toGrid(const glm::dvec3& p) const
  {
    return { std::llround((p.x - offset.x) / scale.x), std::llround((p.y - offset.y) / scale.y),
      std::llround((p.z - offset.z) / scale.z) };
  }
  friend bool operator==(const QuantisationGrid& a, const QuantisationGrid& b)
  {
    return a.scale == b.scale && a.offset == b.offset;
  }
};

} // namespace pointfront
