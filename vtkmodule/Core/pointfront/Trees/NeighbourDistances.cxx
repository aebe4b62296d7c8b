#include "pointfront/Trees/NeighbourDistances.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pointfront
{
namespace
{
double medianOf(std::vector<double>& values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}
} // namespace

NeighbourDistances NeighbourDistances::of(
  const std::vector<TreePosition>& positions, const glm::dvec3& scale)
{
  constexpr double none = std::numeric_limits<double>::infinity();
  std::vector<double> inSpace;
  std::vector<double> fromAbove;
  const std::size_t count = std::min(asked, positions.size());
  for (std::size_t i = 0; i < count; ++i)
  {
    const glm::dvec3 here(positions[(2 * i + 1) * positions.size() / (2 * count)]);
    double space = none;
    double above = none;
    for (const TreePosition& position : positions)
    {
      const glm::dvec3 way = (glm::dvec3(position) - here) * scale;
      const double flat = way.x * way.x + way.y * way.y;
      const double whole = flat + way.z * way.z;
      const bool apart = whole > 0.0;
      space = apart && whole < space ? whole : space;
      above = apart && flat < above ? flat : above;
    }
    if (space < none)
    {
      inSpace.push_back(std::sqrt(space));
      fromAbove.push_back(std::sqrt(above));
    }
  }
  NeighbourDistances distances;
  if (!inSpace.empty())
  {
    distances.inSpace = medianOf(inSpace);
    distances.fromAbove = medianOf(fromAbove);
  }
  return distances;
}

} // namespace pointfront
