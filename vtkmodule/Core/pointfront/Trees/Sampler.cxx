#include "pointfront/Trees/Sampler.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pointfront
{
namespace
{
constexpr int mostQuarters = 4 * 32;
/// From level to level spacing falls by at least that: the square root of two.
constexpr int leastRise = 2;
/// Further from everything than any distance; its square is finite.
constexpr double nowhere = 1e30;

/// How many neighbours share cells of 2^n but not 2^(n-1); in turn in some tables, since
/// neighbours often differ alike and the same counter twice in a row waits for itself.
template <std::size_t Tables>
using Steps = std::array<std::array<std::uint32_t, 34>, Tables>;

template <std::size_t Tables>
CellOccupancy occupancyOf(const Steps<Tables>& stepsAt)
{
  CellOccupancy occupancy;
  std::uint64_t sum = 1;
  for (int level = 32; level >= 0; --level)
  {
    for (const auto& table : stepsAt)
    {
      sum += table[static_cast<std::size_t>(level) + 1];
    }
    occupancy.distinct[static_cast<std::size_t>(level)] = sum;
  }
  return occupancy;
}

double fourthPower(double v)
{
  return v * v * v * v;
}
} // namespace

void CellOccupancy::append(const CellOccupancy& others, unsigned between)
{
  const bool first = distinct[0] == 0;
  for (unsigned level = 0; level < distinct.size(); ++level)
  {
    distinct[level] += others.distinct[level] - (!first && level >= between ? 1u : 0u);
  }
}

CellOccupancy cellOccupancy(const RecordSpan& records, const std::vector<std::uint32_t>& points)
{
  if (points.empty())
  {
    return {};
  }
  Steps<2> stepsAt{};
  TreePosition previous = records.position(points.front());
  for (std::size_t i = 1; i < points.size(); ++i)
  {
    const TreePosition position = records.position(points[i]);
    ++stepsAt[i & 1][differingBits(position, previous)];
    previous = position;
  }
  return occupancyOf(stepsAt);
}

std::uint64_t placesOf(const RecordSpan& records, const std::vector<std::uint32_t>& points)
{
  std::uint64_t places = points.empty() ? 0 : 1;
  for (std::size_t i = 1; i < points.size(); ++i)
  {
    places += records.position(points[i]) != records.position(points[i - 1]) ? 1u : 0u;
  }
  return places;
}

CellOccupancy cellOccupancy(const std::uint8_t* steps, std::size_t points)
{
  if (points == 0)
  {
    return {};
  }
  Steps<4> stepsAt{};
  for (std::size_t i = 1; i < points; ++i)
  {
    ++stepsAt[i & 3][steps[i]];
  }
  return occupancyOf(stepsAt);
}

double SamplingDistance::squaredSteps() const
{
  const double half = quarters % 2 == 0 ? 1.0 : 1.41421356237309504880; // 2^(quarters / 2)
  return std::ldexp(half, quarters / 2);
}

double SamplingDistance::steps() const
{
  return std::sqrt(squaredSteps());
}

SamplingDistance samplingDistance(const CellOccupancy& occupancy, std::uint64_t candidates,
  int coarsestBelow, const SamplingRule& rule)
{
  // In fourth powers, so that interpolating by quarters takes multiplications only: the same
  // result on every machine.
  const double most =
    fourthPower(std::min(double(rule.nodePoints) * 4.0 / 3.0, double(candidates) / 2.0));
  const auto cells = [&](int quarters)
  {
    const auto level = static_cast<std::size_t>(quarters / 4);
    const auto next = std::min<std::size_t>(level + 1, 32);
    const auto fine = static_cast<double>(occupancy.distinct[level]);
    const auto coarse = static_cast<double>(occupancy.distinct[next]);
    double product = 1.0;
    for (int i = 0; i < 4; ++i)
    {
      product *= i < quarters % 4 ? coarse : fine;
    }
    return product;
  };
  int quarters = coarsestBelow < 0 ? 0 : coarsestBelow + leastRise;
  while (quarters < mostQuarters && cells(quarters) > most)
  {
    ++quarters;
  }
  return { std::min(quarters, mostQuarters) };
}

SubsetSampler::SubsetSampler()
  : slots_(std::size_t(1) << slotBits, none)
{
}

SubsetSampler::Reach SubsetSampler::reachOf(const glm::dvec3& p) const
{
  // Odd constants of large period (those of xxHash): a sum of products spreads a lattice evenly.
  constexpr std::array<std::uint32_t, 3> factors{ 0x9e3779b1u, 0x85ebca77u, 0xc2b2ae3du };
  Reach reach;
  const auto axis = [&](double coordinate, std::uint32_t factor, std::array<std::uint32_t, 2>& out)
  {
    const double cells = coordinate * cellsPerStep_;
    const auto own = static_cast<std::int64_t>(cells);
    const bool upper = cells - static_cast<double>(own) >= 0.5;
    out[0] = static_cast<std::uint32_t>(own) * factor;
    out[1] = upper ? out[0] + factor : out[0] - factor; // beyond the nearer side
  };
  axis(p.x, factors[0], reach.x);
  axis(p.y, factors[1], reach.y);
  axis(p.z, factors[2], reach.z);
  return reach;
}

std::uint32_t SubsetSampler::slotOf(const Reach& reach, unsigned octant)
{
  return (reach.x[octant & 1u] + reach.y[(octant >> 1) & 1u] + reach.z[octant >> 2]) >>
    (32 - slotBits);
}

SubsetSampler::Mask SubsetSampler::near(const Query& query, const Taken& a, const Taken& b)
{
  Pair da;
  Pair db;
  std::memcpy(&da, &a.position, sizeof(Pair)); // x and y
  std::memcpy(&db, &b.position, sizeof(Pair));
  da -= query.xy;
  db -= query.xy;
  da *= da;
  db *= db;
  const Pair dz = Pair{ a.position.z, b.position.z } - query.z;
  return Pair{ da[0], db[0] } + Pair{ da[1], db[1] } + dz * dz < query.squared;
}

bool SubsetSampler::nearRecent(const Query& query) const
{
  // All of them, without a branch in between: which one it is cannot be foretold.
  const Taken* end = taken_.data() + taken_.size();
  static_assert(recentPoints == 6);
  const Mask found =
    near(query, end[-1], end[-2]) | near(query, end[-3], end[-4]) | near(query, end[-5], end[-6]);
  return (found[0] | found[1]) != 0;
}

bool SubsetSampler::crowded(const Query& query, const Reach& reach) const
{
  // All eight lists at once, an entry of each a round: how long each of them is cannot be foretold,
  // how long the longest is can. A list that is over goes on with an entry near to nothing.
  std::array<std::uint32_t, 8> at;
  for (unsigned octant = 0; octant < 8; ++octant)
  {
    at[octant] = slots_[slotOf(reach, octant)];
  }
  std::uint32_t more = 1;
  while (more != 0)
  {
    Mask found{ 0, 0 };
    more = 0;
    for (unsigned list = 0; list < 8; list += 2)
    {
      const Taken& a = taken_[at[list]];
      const Taken& b = taken_[at[list + 1]];
      found |= near(query, a, b);
      at[list] = a.next;
      at[list + 1] = b.next;
      more |= a.next | b.next;
    }
    if ((found[0] | found[1]) != 0)
    {
      return true;
    }
  }
  return false;
}

void SubsetSampler::choose(const RecordSpan& records, const std::vector<std::uint32_t>& points,
  SamplingDistance distance, std::vector<std::uint32_t>& chosen)
{
  chosen.clear();
  taken_.assign(recentPoints, { glm::dvec3(nowhere), none }); // there are always that many
  std::fill(slots_.begin(), slots_.end(), none);
  Query query;
  query.squared = Pair{ distance.squaredSteps(), distance.squaredSteps() };
  cellsPerStep_ = 0.499999 / distance.steps(); // a hair larger than twice the distance
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const glm::dvec3 p(records.position(points[i]));
    query.xy = Pair{ p.x, p.y };
    query.z = Pair{ p.z, p.z };
    if (nearRecent(query))
    {
      continue;
    }
    const Reach reach = reachOf(p);
    if (crowded(query, reach))
    {
      continue;
    }
    chosen.push_back(static_cast<std::uint32_t>(i));
    std::uint32_t& head = slots_[slotOf(reach, 0)];
    taken_.push_back({ p, head });
    head = static_cast<std::uint32_t>(taken_.size() - 1);
  }
}

double surfaceSpacing(const CellOccupancy& occupancy, unsigned nodeLog2Side)
{
  const std::uint64_t places = occupancy.places();
  unsigned level = 0;
  while (level < nodeLog2Side && places < 4 * occupancy.distinct[level])
  {
    ++level;
  }
  const double cells = static_cast<double>(occupancy.distinct[level]);
  return std::ldexp(std::sqrt(cells / static_cast<double>(places)), static_cast<int>(level));
}

double surfaceSpacing(const RecordSpan& records, const std::vector<std::uint32_t>& points)
{
  const unsigned side =
    differingBits(records.position(points.front()), records.position(points.back()));
  return surfaceSpacing(cellOccupancy(records, points), side);
}

} // namespace pointfront
