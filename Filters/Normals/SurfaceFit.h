#pragma once

#include "pointfront/Neighbourhood/NearestNeighbours.h"

#include <optional>

namespace pointfront
{

/// A plane through neighbouring points.
struct SurfaceFit
{
  glm::dvec3 normal{ 0.0 }; ///< unit vector; its sign has no meaning
  double curvature = 0.0; ///< smallest eigenvalue over the sum of all three: 0 flat, 1/3 a ball
  double width = 0.0; ///< middle eigenvalue over the largest
  glm::dvec3 centre{ 0.0 }; ///< mean of the points
};

/// Up to so many points the sums of a fit are exact, and so do not depend on their order.
constexpr std::uint32_t mostExactlySummed = 64;

/// The plane of least squared distances: the eigenvector of the smallest eigenvalue of the points'
/// covariance (PCA). Offsets are taken from `origin`, which is one of the points or close to them.
/// Sums     of no more than mostExactlySummed points: of offsets rounded to 2^-23 of the largest
///          or finer, the same in any order. Of more: in the order given.
/// Nothing  for fewer than three places, and for places on one line to within a millionth of their
///          extent: they have no plane.
std::optional<SurfaceFit> fitSurface(
  const glm::dvec3& origin, const std::vector<NearPoint>& points);

} // namespace pointfront
