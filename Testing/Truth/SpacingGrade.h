#pragma once

#include <algorithm>
#include <cmath>

namespace pointfront::truth
{

/// How far apart the points of a view are, by their depth: everywhere alike, or, graded, doubled
/// with each doubling of depth, so that on the screen it stays between 0.71 and 1.41 of what is
/// asked for.
/// Units  metres. The spacing h of points means one point for each h x h of surface.
struct SpacingGrade
{
  double spacing = 1.0; ///< at the median depth
  double medianDepth = 1.0;
  bool graded = false;

  double nearest() const { return 0.02 * medianDepth; } ///< no points nearer than that
  /// 0 at the median depth, 1 where the spacing is twice as large ...
  int level(double depth) const
  {
    return graded ? int(std::floor(std::log2(std::max(depth, 0.5 * nearest()) / medianDepth) + 0.5))
                  : 0;
  }
  double ofLevel(int level) const { return std::ldexp(spacing, level); }
  double at(double depth) const { return ofLevel(level(depth)); }
};

} // namespace pointfront::truth
