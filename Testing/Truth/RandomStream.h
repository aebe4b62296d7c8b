#pragma once

#include "pointfront/Generate/LatticeNoise.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace pointfront::truth
{

constexpr double pi = 3.14159265358979323846;

/// Numbers that the seed alone decides, on every machine and thread.
class RandomStream
{
public:
  explicit RandomStream(std::uint64_t seed)
    : key_(hashOf(seed))
  {
  }

  std::uint64_t next() { return hashOf(key_++); }
  double uniform() { return unitOf(next()); } ///< in [0, 1)
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Mean 0, standard deviation 1.  Source  Box & Muller 1958.
  double gaussian()
  {
    const double length = std::sqrt(-2.0 * std::log(std::max(uniform(), 0x1.0p-53)));
    return length * std::cos(2.0 * pi * uniform());
  }
  glm::dvec3 direction() ///< unit vector, all alike likely
  {
    const double x = gaussian();
    const double y = gaussian();
    return glm::normalize(glm::dvec3(x, y, gaussian()));
  }

private:
  std::uint64_t key_;
};

} // namespace pointfront::truth
