#include "COPCGrid.h"

#include "LASBytes.h"

#include <algorithm>
#include <cmath>

namespace pointfront
{
namespace
{
/// `steps`, rounded up to a multiple of a power of two that is 1/128 of it or less.
std::uint64_t withEvenHalves(std::uint64_t steps)
{
  std::uint64_t unit = 1;
  while (steps / (2 * unit) >= 128)
  {
    unit *= 2;
  }
  return (steps + unit - 1) / unit * unit;
}
} // namespace

COPCGrid::COPCGrid(const LASTotals& totals, const QuantisationGrid& grid)
{
  const double step = std::max({ grid.scale.x, grid.scale.y, grid.scale.z });
  double extent = step;
  for (int axis = 0; axis < 3 && totals.points > 0; ++axis)
  {
    const auto steps = static_cast<double>(totals.high[axis] - totals.low[axis] + 1);
    extent = std::max(extent, steps * grid.scale[axis]);
  }
  const auto steps = static_cast<std::uint64_t>(std::ceil(extent / step * (1.0 - 1e-12)));
  const double side = static_cast<double>(withEvenHalves(steps)) * step;
  halfSize_ = 0.5 * side;
  const glm::dvec3 low = totals.points > 0 ? grid.toWorld(totals.low) : grid.offset;
  centre_ = low - 0.5 * grid.scale + glm::dvec3(halfSize_);
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto a = static_cast<std::size_t>(axis);
    low_[a] = totals.points > 0 ? totals.low[axis] : 0;
    sideSteps_[a] = side / grid.scale[axis];
  }
}

glm::uvec3 COPCGrid::cell(const std::byte* record) const
{
  constexpr double cells = 1 << keyLevels;
  glm::uvec3 found;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto a = static_cast<std::size_t>(axis);
    const std::int64_t steps = loadNumber<std::int32_t>(record + 4 * a) - low_[a];
    const double place = (static_cast<double>(steps) + 0.5) / sideSteps_[a];
    found[axis] = static_cast<std::uint32_t>(std::clamp(place * cells, 0.0, cells - 1.0));
  }
  return found;
}

std::uint64_t COPCGrid::key(const glm::uvec3& cell)
{
  std::uint64_t key = 0;
  std::uint64_t path = 1; // the cell so far, led by a 1: paths of two levels are never the same
  for (int level = keyLevels - 1; level >= 0; --level)
  {
    const std::uint64_t child =
      ((cell.x >> level) & 1) | (((cell.y >> level) & 1) << 1) | (((cell.z >> level) & 1) << 2);
    const std::uint64_t scramble = (path * 0x9E3779B97F4A7C15u) >> 61;
    key = (key << 3) | (child ^ scramble);
    path = (path << 3) | child;
  }
  return key;
}

int COPCGrid::commonLevels(std::uint64_t one, std::uint64_t other)
{
  const std::uint64_t differ = one ^ other;
  return differ == 0 ? keyLevels : (__builtin_clzll(differ) - 1) / 3;
}

} // namespace pointfront
