#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace pointfront::truth
{

/// Picks among candidates a set of points that keep their distance, coarse to fine: first as many
/// as fit at a large distance, then at 1/sqrt(2) of that, and so on, down to the radius of each.
/// Takes       radii that are all alike, or differ by powers of two.
/// Guarantees  two points of a prefix are at least as far apart as the distance at which the last
///             of them was picked; a candidate is left out only where a picked point lies within
///             its radius.
/// Order       depends on the seed and the candidates only.
/// Source      progressive dart throwing: Mitchell 1987, McCool & Fiume 1992.
std::vector<std::uint32_t> poissonOrder(
  const std::vector<glm::dvec3>& candidates, const std::vector<double>& radii, std::uint64_t seed);

} // namespace pointfront::truth
