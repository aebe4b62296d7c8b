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

/// The best point of one cell.
struct Candidate
{
  std::size_t rank = 0; // in the list of points
  std::uint64_t distance = 0;
  TreePosition position{0};
};

/// One for each occupied cell, in Morton order; of equally near ones the first.
std::vector<Candidate> nearestToTargets(
  const RecordView& records, const std::vector<std::uint32_t>& points, unsigned cellLog2)
{
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const TreePosition position = records.position(points[i]);
    const Candidate candidate{i, targetDistance(position, cellLog2), position};
    if (candidates.empty() || differingBits(position, candidates.back().position) > cellLog2)
    {
      candidates.push_back(candidate);
    }
    else if (candidate.distance < candidates.back().distance)
    {
      candidates.back() = candidate;
    }
  }
  return candidates;
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

SubsetSampler::SubsetSampler() : slots_(std::size_t(1) << (3 * slotBits)) {}

std::uint32_t& SubsetSampler::slotOf(const TreePosition& cell)
{
  constexpr std::uint32_t mask = (1u << slotBits) - 1;
  return slots_[((cell.z & mask) << (2 * slotBits)) | ((cell.y & mask) << slotBits) |
                (cell.x & mask)];
}

bool SubsetSampler::crowded(const TreePosition& p, unsigned cellLog2)
{
  const double half = std::ldexp(0.5, static_cast<int>(cellLog2));
  const std::uint32_t halfBit = 1u << (cellLog2 - 1);
  const TreePosition cell(p.x >> cellLog2, p.y >> cellLog2, p.z >> cellLog2);
  TreePosition beside; // the neighbour on the nearer side of each axis: nothing else is in reach
  for (int axis = 0; axis < 3; ++axis)
  {
    beside[axis] = (p[axis] & halfBit) != 0 ? cell[axis] + 1 : cell[axis] - 1;
  }
  for (unsigned octant = 1; octant < 8; ++octant)
  {
    const std::uint32_t taken = slotOf({(octant & 1u) != 0 ? beside.x : cell.x,
      (octant & 2u) != 0 ? beside.y : cell.y, (octant & 4u) != 0 ? beside.z : cell.z});
    if (taken == 0)
    {
      continue;
    }
    const glm::dvec3 d = glm::dvec3(taken_[taken - 1]) - glm::dvec3(p);
    if (d.x * d.x + d.y * d.y + d.z * d.z < half * half)
    {
      return true;
    }
  }
  return false;
}

void SubsetSampler::choose(const RecordView& records, const std::vector<std::uint32_t>& points,
  unsigned cellLog2, std::vector<bool>& chosen)
{
  chosen.assign(points.size(), false);
  taken_.clear();
  const bool thin = cellLog2 > 0 && cellLog2 < 32; // else no two candidates can be that close
  for (const Candidate& candidate : nearestToTargets(records, points, cellLog2))
  {
    const TreePosition& p = candidate.position;
    if (thin && crowded(p, cellLog2))
    {
      continue;
    }
    chosen[candidate.rank] = true;
    taken_.push_back(p);
    if (thin)
    {
      slotOf({p.x >> cellLog2, p.y >> cellLog2, p.z >> cellLog2}) =
        static_cast<std::uint32_t>(taken_.size());
    }
  }
  for (const TreePosition& p : taken_)
  {
    if (thin)
    {
      slotOf({p.x >> cellLog2, p.y >> cellLog2, p.z >> cellLog2}) = 0;
    }
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
