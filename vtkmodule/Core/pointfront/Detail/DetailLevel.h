#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace pointfront
{

// Detail levels of view-specific detail. A level is log2 of the points that the whole data set
// would show at it: in a kd-tree with a point a node, a level of the tree; in trees of chunks it
// need not be whole.
// Source  Futterlieb, Teutsch & Berndt 2016, sections 3.1.1 and 3.1.2 (SMOOTH-2, SMOOTH-3).

/// Treelevel_Overview = log2(N_OverviewPoints).
inline double overviewLevel(std::uint64_t overviewPoints)
{
  return std::log2(static_cast<double>(std::max<std::uint64_t>(overviewPoints, 1)));
}

/// Points of one data set in an overview of several, in proportion to its size: 2 to the power of
/// Treelevel_Dataset = log2(N_Datasetpoints / N_TotalPoints * N_OverviewPoints). At least 1, and
/// not more than it has.
inline std::uint64_t overviewShare(
  std::uint64_t overviewPoints, std::uint64_t dataSetPoints, std::uint64_t totalPoints)
{
  const double share = static_cast<double>(dataSetPoints) /
    static_cast<double>(std::max<std::uint64_t>({ totalPoints, dataSetPoints, 1 }));
  const auto points =
    static_cast<std::uint64_t>(std::floor(share * static_cast<double>(overviewPoints)));
  return std::min(std::max<std::uint64_t>(points, 1), dataSetPoints);
}

/// Treelevel_Details = Treelevel_Overview + log2(N_IP / N_OPIF) where N_IP > N_OPIF > 0:
/// `imagePixels` that wait for a point, `overviewInFrustum` points that the frustum has already.
/// The overview's level where it has enough; `deepest` where it has none.
inline double detailLevel(
  double overview, double imagePixels, double overviewInFrustum, double deepest)
{
  if (overviewInFrustum <= 0.0)
  {
    return deepest;
  }
  const double more = std::log2(imagePixels / overviewInFrustum);
  return std::min(overview + std::max(more, 0.0), std::max(deepest, overview));
}

/// Which slice of the frustum a distance lies in: slices twice as deep as the one before, from the
/// near plane on (figure 3, right).
inline int frustumSlice(double distance, double nearDistance)
{
  return distance > nearDistance ? static_cast<int>(std::log2(distance / nearDistance)) : 0;
}

} // namespace pointfront
