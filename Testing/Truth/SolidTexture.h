#pragma once

#include "TriangleMesh.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>

namespace pointfront::truth
{

/// The colour that a photograph would show of a surface, wherever it is taken from: with detail
/// over several octaves, and the light of one sun, baked in.
/// Units    metres in; red, green, blue out, 0 to 255.
/// Depends  on place and outward normal only (a leaf: also on which triangle it is), so a point
///          that was sampled there has the colour that its pixel has in the true picture.
glm::dvec3 surfaceColour(
  Material material, const glm::dvec3& position, const glm::dvec3& normal, std::size_t triangle);

std::array<std::uint8_t, 3> toBytes(const glm::dvec3& colour); ///< rounded and clamped

} // namespace pointfront::truth
