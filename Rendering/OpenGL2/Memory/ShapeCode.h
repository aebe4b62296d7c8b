#pragma once

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace pointfront
{

/// A point's normal and the code of its radius (SplatRadius.h) in 32 bits, as SplatVS.glsl reads
/// them: the code in the low byte, then two numbers of 12 bits, the normal on an octahedron
/// unfolded into a square.
/// Exactness  0.05 degrees at most; a direction along an axis is exact.
/// Source     Cigolle et al. 2014, "A survey of efficient representations for independent unit
///            vectors".
namespace shapeCode
{
constexpr std::uint32_t centre = 2047; ///< code of 0; -1 is code 0, 1 is code 4094
constexpr std::uint32_t noNormal = 4095; ///< in the place of the first number

/// `normal` may be of any length; one that is zero, not finite, or so far from unit length that it
/// is none to the software back end (completeNormals() in SplatSetUp.h) is none.
inline std::uint32_t of(const glm::vec3& normal, std::uint8_t radius)
{
  const float length = std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z);
  const float square = normal.x * normal.x + normal.y * normal.y + normal.z * normal.z;
  if (!(square > 1e-12f && square < 1e12f))
  {
    return noNormal << 8 | radius;
  }
  const glm::vec3 n = normal / length;
  const auto folded = [&](float a, float b)
  { return n.z < 0.0f ? std::copysign(1.0f - std::abs(b), a) : a; };
  const auto number = [](float value)
  {
    const float steps = std::round(value * static_cast<float>(centre));
    return static_cast<std::uint32_t>(
      std::clamp(static_cast<int>(steps) + static_cast<int>(centre), 0, 2 * int(centre)));
  };
  return number(folded(n.y, n.x)) << 20 | number(folded(n.x, n.y)) << 8 | radius;
}
} // namespace shapeCode

} // namespace pointfront
