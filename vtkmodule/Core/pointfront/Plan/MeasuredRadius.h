#pragma once

#include "pointfront/Front/PointPrefix.h"
#include "pointfront/Store/Hierarchy.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace pointfront
{

/// The radius that closes the surface among the first `drawn` points of a node, before its
/// neighbours are looked at.
struct MeasuredRadius
{
  /// A node whose few points stand farther apart than its level can see has strays in it, no
  /// surface.
  static constexpr float mostSpacings = 2.0f;
  /// A whole layer of fewer points is no surface: its points are as small as can be. A root that
  /// has nodes below it is no whole layer: in a tree of means it may hold a dozen.
  static constexpr std::size_t fewestOfSurface = 64;

  float spacing = 0.0f; ///< between the points on screen
  float radiusScale = 1.0f; ///< as PlanItem's
  float closing = 0.0f;
  bool unfinished = false;

  template <typename Row> // Node or NodeColumns
  MeasuredRadius(
    const Row& row, std::uint32_t points, std::uint32_t drawn, bool leaf, float spacingRatio)
    : spacing(static_cast<float>(prefixErrorPx(points, drawn, row.spacing, spacingRatio)))
    , radiusScale(row.spacing > 0.0f ? std::max(1.0f, spacing / row.spacing) : 1.0f)
    , unfinished(!leaf || drawn < points)
  {
    const float measured = std::min(row.splatRadius, mostSpacings * row.spacing);
    const bool strays = leaf && row.parent == noNode && points < fewestOfSurface;
    closing = strays ? 0.0f : measured > 0.0f ? measured * radiusScale : spacing;
  }
};

} // namespace pointfront
