#pragma once

#include "pointfront/Points/AttributeSchema.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <cstdint>

namespace pointfront
{

/// A unit normal as it is stored: three whole numbers of `normalSteps` steps to 1; zero where a
/// point has none. Readers that apply the attribute's scale see an ordinary vector.
/// Error  at most 0.005 degrees; 6 bytes a point before compression.
using PackedNormal = glm::vec<3, std::int16_t, glm::defaultp>;

constexpr int normalSteps = 10000;

inline Attribute normalAttribute()
{
  return { "normal", ScalarType::Int16, 3, 1.0 / normalSteps, 0.0,
    "unit normal; zero where there is none" };
}

/// `normal` of length 1 or 0.
inline PackedNormal packNormal(const glm::dvec3& normal)
{
  const auto packed = [](double component)
  { return static_cast<std::int16_t>(std::lround(component * normalSteps)); };
  return { packed(normal.x), packed(normal.y), packed(normal.z) };
}

/// Unit vector, or 0.
inline glm::dvec3 unpackNormal(const PackedNormal& packed)
{
  const glm::dvec3 normal(packed.x, packed.y, packed.z);
  const double length = glm::length(normal);
  return length > 0.0 ? normal / length : normal;
}

/// The normal or its opposite: the one that points up. A horizontal one points north, or else east.
inline PackedNormal facingUp(const PackedNormal& normal)
{
  const bool down = normal.z != 0 ? normal.z < 0 : normal.y != 0 ? normal.y < 0 : normal.x < 0;
  return down ? PackedNormal(-normal.x, -normal.y, -normal.z) : normal;
}

/// The normal or its opposite: the one that points from `position` to `viewer`.
inline PackedNormal facing(
  const PackedNormal& normal, const glm::dvec3& position, const glm::dvec3& viewer)
{
  const double towards = glm::dot(glm::dvec3(normal.x, normal.y, normal.z), viewer - position);
  return towards < 0.0 ? PackedNormal(-normal.x, -normal.y, -normal.z) : normal;
}

} // namespace pointfront
