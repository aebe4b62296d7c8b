#pragma once

#include "pointfront/Neighbourhood/NearestNeighbours.h"

#include <optional>

namespace pointfront
{

/// A plane through neighbouring points.
struct SurfaceFit
{
  glm::dvec3 normal{ 0.0 }; ///< of length 1; its sign has no meaning
  double curvature = 0.0;   ///< smallest eigenvalue over the sum of all three: 0 flat, 1/3 a ball
  glm::dvec3 centre{ 0.0 }; ///< mean of the points
};

/// The plane of least squared distances: the eigenvector of the smallest eigenvalue of the points'
/// covariance (PCA), in double precision relative to the first of them.
/// Nothing  for fewer than three places, and for places on one line to within a millionth of their
///          extent: they have no plane.
std::optional<SurfaceFit> fitSurface(const std::vector<NearPoint>& points);

} // namespace pointfront
