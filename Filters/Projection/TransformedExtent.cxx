#include "TransformedExtent.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pointfront
{
namespace
{
constexpr double earthRadius = 6378137.0; // metres: angles measured on the ground

double groundLength(const CoordinateSystem& system)
{
  return system.geographic ? system.unitLength * earthRadius : system.unitLength;
}

double powerOfTenUpTo(double step)
{
  constexpr double nearlyWhole = 1e-6; // log10(0.001) is not -3 to the last bit
  return std::pow(10.0, std::floor(std::log10(step) + nearlyWhole));
}

/// `wanted`: as coarse as is no loss.
double stepFor(double wanted, double most)
{
  const bool known = wanted > 0.0 && std::isfinite(wanted);
  return std::min(most, powerOfTenUpTo(known ? wanted : most));
}

bool heightsChange(const CoordinateSystem& from, const CoordinateSystem& to)
{
  return (from.vertical && to.vertical) || from.geocentric || to.geocentric;
}

/// The coarsest tenth, hundredth ... of `coarse` that is no coarser than `step`.
double decimalPartOf(double coarse, double step)
{
  double part = coarse;
  while (part > step * (1.0 + 1e-6))
  {
    part /= 10.0;
  }
  return part;
}

double roundTo(double value, double whole)
{
  return std::isfinite(value) ? std::round(value / whole) * whole : 0.0;
}
} // namespace

Result<Bounds> transformedBounds(const Bounds& bounds, const CoordinateTransform& transform)
{
  constexpr int side = 5;
  std::array<glm::dvec3, std::size_t(side) * side * 2> lattice;
  const glm::dvec3 size = bounds.size();
  for (std::size_t i = 0; i < lattice.size(); ++i)
  {
    const glm::vec<3, std::size_t> place(i % side, i / side % side, i / (side * side));
    const glm::dvec3 share = glm::dvec3(place) / glm::dvec3(side - 1, side - 1, 1.0);
    lattice[i] = bounds.low + share * size;
  }
  if (Result<void> done = transform.apply(lattice.data(), lattice.size()); !done)
  {
    return done.error();
  }
  Bounds transformed;
  for (const glm::dvec3& p : lattice)
  {
    if (std::isfinite(p.x + p.y + p.z))
    {
      transformed.add(p);
    }
  }
  return transformed;
}

glm::dvec3 transformedSteps(
  const glm::dvec3& steps, const CoordinateSystem& from, const CoordinateSystem& to)
{
  const double plane = groundLength(from) / groundLength(to);
  const double height = heightsChange(from, to) ? from.heightUnit / to.heightUnit : 0.0;
  return steps * glm::dvec3(plane, plane, height);
}

QuantisationGrid transformedGrid(const SourceDescription& source, const CoordinateSystem& from,
  const CoordinateSystem& to, const Bounds& extent, const std::optional<QuantisationGrid>& resident)
{
  const glm::dvec3 old = source.grid ? source.grid->scale : glm::dvec3(0.0);
  const glm::dvec3 middle = extent.empty() ? glm::dvec3(0.0) : extent.centre();
  const double whole = to.geographic ? 1.0 : 1000.0;
  const glm::dvec3 lossless = transformedSteps(old, from, to);
  QuantisationGrid grid;
  for (int axis = 0; axis < 3; ++axis)
  {
    double& scale = grid.scale[axis];
    double& offset = grid.offset[axis];
    if (axis < 2)
    {
      scale = stepFor(lossless[axis], to.geographic ? angularStep : lengthStep);
      offset = roundTo(middle[axis], whole);
    }
    else if (heightsChange(from, to))
    {
      scale = stepFor(lossless.z, lengthStep);
      offset = to.geocentric ? roundTo(middle.z, whole) : 0.0;
    }
    else
    {
      scale = source.grid ? old.z : lengthStep;
      offset = source.grid ? source.grid->offset.z : 0.0;
    }
    if (resident)
    {
      scale = decimalPartOf(resident->scale[axis], scale);
      offset = resident->offset[axis];
    }
  }
  return grid;
}

} // namespace pointfront
