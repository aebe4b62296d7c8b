#pragma once

#include <cmath>
#include <cstdint>

namespace pointfront
{

/// How many of a node's points are drawn, so that the projected point spacing is met per point
/// although the front moves per node, and no chunk pops up at once.
///
/// Density   points of spacing s on a surface have a density ~ 1 / s^2. With Refinement::Add a
///           region shows its ancestors (density 1 / s_parent^2) and the share f of the node that
///           would bring it to 1 / s^2:
///               1 / s_parent^2 + f (1 / s^2 - 1 / s_parent^2) = 1 / t^2
///           where t is the spacing that projects to the threshold. With e = s in pixels, T = t in
///           pixels and r = s / s_parent:
///               f = ((e / T)^2 - r^2) / (1 - r^2)   within [0, 1]
/// Hence     f = 0 where the parent alone is fine enough (T >= e / r), f = 1 from T = e on: as the
///           threshold falls, a node fades in point by point between its parent's turn and its own.
///           A root has no parent: r = 0 and f = (e / T)^2.
/// Twin      none on the GPU: the renderer gets the count.
/// `ratio` is r; a node hardly finer than its parent (r^2 > 3 / 4) is taken as r^2 = 3 / 4.
inline double prefixFraction(double errorPx, double ratio, double thresholdPx)
{
  if (errorPx >= thresholdPx)
  {
    return 1.0;
  }
  const double wanted = (errorPx / thresholdPx) * (errorPx / thresholdPx);
  const double above = ratio * ratio < 0.75 ? ratio * ratio : 0.75;
  return wanted > above ? (wanted - above) / (1.0 - above) : 0.0;
}

/// The prefix in points, rounded up: what is drawn is never sparser than the threshold, and a node
/// whose parent is too coarse shows a point, however fine its spacing is said to be. Falls with the
/// threshold. Of a root (ratio 0) at least one: what is in view shows, however few pixels there
/// are.
inline std::uint32_t prefixLength(
  std::uint32_t pointCount, double errorPx, double ratio, double thresholdPx)
{
  if (errorPx >= thresholdPx)
  {
    return pointCount;
  }
  const auto points =
    static_cast<std::uint32_t>(std::ceil(pointCount * prefixFraction(errorPx, ratio, thresholdPx)));
  return points == 0 && ratio == 0.0 && pointCount > 0 ? 1 : points;
}

/// The density on screen when `drawn` of `pointCount` points are drawn, divided by the density of
/// all.
inline double prefixDensity(std::uint32_t pointCount, std::uint32_t drawn, double ratio)
{
  const double above = ratio * ratio < 0.75 ? ratio * ratio : 0.75;
  const double fraction = pointCount > 0 ? double(drawn) / pointCount : 1.0;
  return above + fraction * (1.0 - above);
}

/// The spacing in pixels on screen with a prefix of that length: the inverse of prefixLength().
inline double prefixErrorPx(
  std::uint32_t pointCount, std::uint32_t drawn, double errorPx, double ratio)
{
  const double density = prefixDensity(pointCount, drawn, ratio);
  return density > 0.0 ? errorPx / std::sqrt(density) : errorPx;
}

/// A root that shows no point counts as one of which one is shown: a finite error, and the largest.
inline std::uint32_t leastForError(std::uint32_t drawn, double ratio)
{
  return drawn == 0 && ratio == 0.0 ? 1 : drawn;
}

} // namespace pointfront
