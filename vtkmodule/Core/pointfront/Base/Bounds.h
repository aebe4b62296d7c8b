#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <limits>

namespace pointfront
{

/// Axis-aligned box in world coordinates (double; the unit is the CRS's, metres unless it says
/// otherwise). Empty when made; an empty box has low > high.
struct Bounds
{
  glm::dvec3 low{ std::numeric_limits<double>::infinity() };
  glm::dvec3 high{ -std::numeric_limits<double>::infinity() };

  bool empty() const { return !(low.x <= high.x && low.y <= high.y && low.z <= high.z); }
  void add(const glm::dvec3& p)
  {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  void add(const Bounds& b)
  {
    low = glm::min(low, b.low);
    high = glm::max(high, b.high);
  }
  bool contains(const glm::dvec3& p) const
  {
    return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y && p.z >= low.z &&
      p.z <= high.z;
  }
  bool overlaps(const Bounds& b) const
  {
    return low.x <= b.high.x && b.low.x <= high.x && low.y <= b.high.y && b.low.y <= high.y &&
      low.z <= b.high.z && b.low.z <= high.z;
  }
  glm::dvec3 centre() const { return 0.5 * (low + high); }
  glm::dvec3 size() const { return high - low; }
};

} // namespace pointfront
