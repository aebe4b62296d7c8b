#pragma once

#include <algorithm>
#include <cstdint>

namespace pointfront
{

/// The present share of their size that a node's points have. It falls along the node's order, so
/// that the last points of a prefix grow from nothing while the prefix grows (SMOOTH-6). Where
/// splats are blended it is their weight.
/// Twin  growthOf() in SplatVS.glsl.
struct PointGrowth
{
  float first = 1.0f; ///< share of the node's first point, before it is bounded to [0, 1]
  float perPoint = 0.0f; ///< that it falls from a point to the next

  /// Whether all points have their full size.
  bool whole() const { return perPoint == 0.0f && first >= 1.0f; }
  float of(std::uint32_t point) const
  {
    return std::clamp(first - perPoint * static_cast<float>(point), 0.0f, 1.0f);
  }
  /// How many of the first points have their full size.
  std::uint32_t fullPoints(std::uint32_t last) const
  {
    if (perPoint == 0.0f)
    {
      return first >= 1.0f ? last : 0;
    }
    const float full = (first - 1.0f) / perPoint;
    std::uint32_t count = full > 0.0f ? static_cast<std::uint32_t>(full) + 1 : 0;
    // The quotient is rounded, and so is of(): a point of .9999999 would be kept as it is.
    while (count > 0 && of(count - 1) < 1.0f)
    {
      --count;
    }
    return std::min(last, count);
  }
};

inline bool operator==(const PointGrowth& a, const PointGrowth& b)
{
  return a.first == b.first && a.perPoint == b.perPoint;
}
inline bool operator!=(const PointGrowth& a, const PointGrowth& b)
{
  return !(a == b);
}

} // namespace pointfront
