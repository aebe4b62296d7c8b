#include "pointfront/Build/Sampler.h"

#include <algorithm>
#include <cmath>

namespace pointfront
{
namespace
{
/// Squared distance to the target of the cell, in thirds of a step: all integers, no rounding.
/// Bounds  an offset is below 3 * 2^32, its square below 2^68: so it is scaled down by `drop`.
std::uint64_t targetDistance(const TreePosition& p, unsigned cellLog2)
{
  const std::uint64_t side = std::uint64_t(1) << cellLog2;
  const std::uint64_t mask = side - 1;
  const std::int64_t target = static_cast<std::int64_t>(cellLog2 % 2 == 0 ? side : 2 * side);
  const unsigned drop = cellLog2 > 28 ? cellLog2 - 28 : 0;
  std::uint64_t sum = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::int64_t inCell = 3 * static_cast<std::int64_t>(p[axis] & mask);
    const std::int64_t d = std::abs(inCell - target) >> drop;
    sum += static_cast<std::uint64_t>(d * d);
  }
  return sum;
}
} // namespace

CellOccupancy cellOccupancy(const RecordView& records, const std::vector<std::uint32_t>& points)
{
  CellOccupancy occupancy;
  if (points.empty())
  {
    return occupancy;
  }
  std::array<std::uint64_t, 34> stepsAt{}; // neighbours that share cells of 2^n but not 2^(n-1)
  TreePosition previous = records.position(points.front());
  for (std::size_t i = 1; i < points.size(); ++i)
  {
    const TreePosition position = records.position(points[i]);
    ++stepsAt[differingBits(position, previous)];
    previous = position;
  }
  std::uint64_t sum = 1;
  for (int level = 32; level >= 0; --level)
  {
    sum += stepsAt[static_cast<std::size_t>(level) + 1];
    occupancy.distinct[static_cast<std::size_t>(level)] = sum;
  }
  return occupancy;
}

unsigned SamplingRule::finestGrid() const
{
  return static_cast<unsigned>(std::max(1L, std::lround(0.5 * std::log2(double(nodePoints)))));
}

unsigned samplingCell(const CellOccupancy& occupancy, unsigned nodeLog2Side, int coarsestBelow,
  const SamplingRule& rule)
{
  const unsigned grid = std::min(rule.finestGrid(), nodeLog2Side);
  unsigned cell = std::max(nodeLog2Side - grid, static_cast<unsigned>(coarsestBelow + 1));
  while (cell < nodeLog2Side && occupancy.distinct[cell] > rule.mostPoints())
  {
    ++cell;
  }
  return std::min(cell, nodeLog2Side);
}

void chooseNearTargets(const RecordView& records, const std::vector<std::uint32_t>& points,
  unsigned cellLog2, std::vector<bool>& chosen)
{
  chosen.assign(points.size(), false);
  std::size_t best = 0;
  std::uint64_t bestDistance = 0;
  TreePosition cellMember{0};
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const TreePosition position = records.position(points[i]);
    const std::uint64_t distance = targetDistance(position, cellLog2);
    const bool newCell = i == 0 || differingBits(position, cellMember) > cellLog2;
    if (newCell && i > 0)
    {
      chosen[best] = true;
    }
    if (newCell || distance < bestDistance)
    {
      best = i;
      bestDistance = distance;
      cellMember = position;
    }
  }
  if (!points.empty())
  {
    chosen[best] = true;
  }
}

double surfaceSpacing(const CellOccupancy& occupancy, std::uint64_t points, unsigned nodeLog2Side)
{
  unsigned level = 0;
  while (level < nodeLog2Side && points < 4 * occupancy.distinct[level])
  {
    ++level;
  }
  const double cells = static_cast<double>(occupancy.distinct[level]);
  return std::ldexp(std::sqrt(cells / static_cast<double>(points)), static_cast<int>(level));
}

} // namespace pointfront
