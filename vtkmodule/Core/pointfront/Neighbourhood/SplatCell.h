#pragma once

#include "pointfront/Neighbourhood/NearOffsets.h"

#include <glm/vec3.hpp>

namespace pointfront
{

/// The plane of a neighbourhood, and how plane it is. Eigenvalues are of the covariance.
struct NeighbourPlane
{
  glm::dvec3 normal{ 0.0, 0.0, 1.0 }; ///< unit vector; its sign has no meaning
  double flatness = 1.0; ///< smallest eigenvalue over the sum: 0 a plane, 1/3 a ball
  double width = 0.0; ///< middle eigenvalue over the largest: 0 a line
};

/// Fits a plane to the point and its neighbours.
NeighbourPlane neighbourPlane(const NearOffsets& near);

/// How large a disc at a point must be for the surface to close, from its nearest places:
/// 1.25 times the distance to the farthest vertex of its Voronoi cell among them in the plane,
/// within bounds; less on lines and in volumes.
/// Bounds   are multiples of the local scale, which is the median distance to the neighbours times
///          a constant: it depends on them only, not on where a cloud is cut into parts.
/// Result   finite, > 0; 0 without a neighbour. Units of the offsets.
/// Source   splat rule and constants: docs/adr/0017-splat-radius.md.
/// `rim`, if it is asked for: whether the cell is open, so that the radius is a guess.
double splatRadius(const NearOffsets& near, const NeighbourPlane& plane, bool* rim = nullptr);

} // namespace pointfront
