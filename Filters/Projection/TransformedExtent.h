#pragma once

#include "pointfront/Base/Bounds.h"
#include "pointfront/Points/PointSource.h"
#include "pointfront/Reference/CoordinateSystems.h"

#include <optional>

namespace pointfront
{

/// The box around a lattice of `bounds` after the transformation: a hint, as declared bounds are.
/// Error   none of the lattice can be transformed, with the transformation's reason.
Result<Bounds> transformedBounds(const Bounds& bounds, const CoordinateTransform& transform);

/// The grid for coordinates that a transformation gives: they lie on none.
/// Step     the largest power of ten that is no coarser than the step they had, measured on the
///          ground, and at most 1 mm (1e-9 degrees, a tenth of that); heights that stay as they
///          are keep their own.
/// Offset   whole thousands (whole degrees) near the middle of `extent`. If `resident`, the grid
///          of points that are in `to` already, is given: a grid that these lie on too.
QuantisationGrid transformedGrid(const SourceDescription& source, const CoordinateSystem& from,
  const CoordinateSystem& to, const Bounds& extent,
  const std::optional<QuantisationGrid>& resident);

/// The steps of a grid in `from`, measured in the units of `to`; 0 on an axis that stays as it is.
glm::dvec3 transformedSteps(
  const glm::dvec3& steps, const CoordinateSystem& from, const CoordinateSystem& to);

/// Step of x and y for coordinates of floating point that are angles.
constexpr double angularStep = 1e-9;
/// Longest step of lengths, metres.
constexpr double lengthStep = 1e-3;

} // namespace pointfront
