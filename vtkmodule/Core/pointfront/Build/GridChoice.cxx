#include "pointfront/Build/GridChoice.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pointfront
{
namespace
{
/// A quotient that near to an integer is one: scales and offsets in headers are decimal fractions.
constexpr double wholeTolerance = 1e-6;

bool whole(double v)
{
  return std::abs(v - std::round(v)) <= wholeTolerance;
}

std::string number(double v)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.9g", v);
  return text;
}

using Sources = std::vector<std::unique_ptr<PointSource>>;

bool usable(const QuantisationGrid& grid)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(grid.scale[axis] > 0.0) || !std::isfinite(grid.scale[axis]) ||
        !std::isfinite(grid.offset[axis]))
    {
      return false;
    }
  }
  return true;
}

/// True if every position of `fine` x `coarse` multiples lies on the grid.
bool liesOn(const QuantisationGrid& source, const QuantisationGrid& grid)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const double ratio = source.scale[axis] / grid.scale[axis];
    const double steps = (source.offset[axis] - grid.offset[axis]) / grid.scale[axis];
    if (ratio < 1.0 - wholeTolerance || !whole(ratio) || !whole(steps))
    {
      return false;
    }
  }
  return true;
}

Bounds declaredBounds(const Sources& sources)
{
  Bounds bounds;
  for (const auto& source : sources)
  {
    const Bounds& declared = source->description().declaredBounds;
    const glm::dvec3 size = declared.size();
    if (!declared.empty() && std::isfinite(size.x + size.y + size.z))
    {
      bounds.add(declared);
    }
  }
  return bounds;
}

/// Offsets are whole units near the data: a reader of the file can tell what they are.
glm::dvec3 roundOffset(const Bounds& bounds)
{
  return bounds.empty() ? glm::dvec3(0.0) : glm::round(bounds.centre());
}

GridChoice defaultGrid(const Sources& sources)
{
  const Bounds bounds = declaredBounds(sources);
  double step = 0.001;
  if (!bounds.empty())
  {
    const glm::dvec3 size = bounds.size();
    const double extent = std::max({size.x, size.y, size.z});
    if (extent > 0.0)
    {
      step = std::pow(10.0, std::floor(std::log10(extent)) - 6.0);
    }
  }
  GridChoice choice;
  choice.grid.scale = glm::dvec3(step);
  choice.grid.offset = roundOffset(bounds);
  choice.warnings.push_back(
    "The input has floating point coordinates; they are rounded to steps of " + number(step) +
    " units. Give a precision to choose another step.");
  return choice;
}

/// The finest scale of all sources, with the offset of the first that has it.
std::optional<QuantisationGrid> finestGrid(const Sources& sources)
{
  std::optional<QuantisationGrid> finest;
  for (const auto& source : sources)
  {
    const auto& grid = source->description().grid;
    if (!grid || !usable(*grid))
    {
      continue;
    }
    if (!finest)
    {
      finest = grid;
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      if (grid->scale[axis] < finest->scale[axis] * (1.0 - wholeTolerance))
      {
        finest->scale[axis] = grid->scale[axis];
        finest->offset[axis] = grid->offset[axis];
      }
    }
  }
  return finest;
}

void warnOfRounding(const Sources& sources, GridChoice& choice)
{
  const glm::dvec3& s = choice.grid.scale;
  for (const auto& source : sources)
  {
    const SourceDescription& description = source->description();
    if (description.grid && usable(*description.grid) && liesOn(*description.grid, choice.grid))
    {
      continue;
    }
    choice.warnings.push_back("Coordinates of '" + description.path +
                              "' do not lie on the store's grid and are rounded, by at most " +
                              number(0.5 * s.x) + ", " + number(0.5 * s.y) + ", " +
                              number(0.5 * s.z) + " units in x, y, z.");
  }
}
} // namespace

Result<GridChoice> chooseGrid(const Sources& sources, const std::optional<double>& precision)
{
  if (precision && (!std::isfinite(*precision) || !(*precision > 0.0)))
  {
    return makeError(Error::Kind::BadArgument,
      "a precision of " + number(*precision) + " is not a length; give a positive number");
  }
  const std::optional<QuantisationGrid> finest = finestGrid(sources);
  if (!precision && !finest)
  {
    return defaultGrid(sources);
  }
  GridChoice choice;
  choice.grid = finest ? *finest : QuantisationGrid{};
  if (!finest)
  {
    choice.grid.offset = roundOffset(declaredBounds(sources));
  }
  if (precision)
  {
    choice.grid.scale = glm::dvec3(*precision);
  }
  warnOfRounding(sources, choice);
  return choice;
}

} // namespace pointfront
