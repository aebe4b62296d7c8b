#include "PoissonOrder.h"

#include "RandomStream.h"

#include "pointfront/Base/Bounds.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pointfront::truth
{
namespace
{
constexpr std::uint32_t nobody = 0xffffffffu;
constexpr double rounding = 1.0 + 1e-9; // radii are multiplied up and divided down again

/// Points that are asked whether one of them is near: a table of cells of twice the distance asked
/// for, so that eight cells hold all that can be near.
class PickedPoints
{
public:
  PickedPoints(double distance, std::size_t expected)
    : squaredDistance_(distance * distance)
    , perCell_(0.5 / distance)
  {
    std::size_t slots = 1024;
    while (slots < expected)
    {
      slots *= 2;
    }
    first_.assign(slots, nobody);
  }

  void add(const glm::dvec3& place)
  {
    std::uint32_t& first = first_[slotOf(glm::floor(perCell_ * place))];
    entries_.push_back({ place, first });
    first = std::uint32_t(entries_.size() - 1);
  }

  bool isNear(const glm::dvec3& place) const
  {
    const glm::dvec3 corner = glm::floor(perCell_ * place - 0.5);
    for (int side = 0; side < 8; ++side)
    {
      const glm::dvec3 cell = corner + glm::dvec3(side & 1, side >> 1 & 1, side >> 2);
      for (std::uint32_t e = first_[slotOf(cell)]; e != nobody; e = entries_[e].next)
      {
        const glm::dvec3 apart = entries_[e].place - place;
        if (apart.x * apart.x + apart.y * apart.y + apart.z * apart.z < squaredDistance_)
        {
          return true;
        }
      }
    }
    return false;
  }

private:
  struct Entry
  {
    glm::dvec3 place;
    std::uint32_t next; ///< in the slot
  };
  /// Cells of a block of 4 x 4 x 4 have slots beside each other: what is near is near in memory.
  std::size_t slotOf(const glm::dvec3& cell) const
  {
    const auto x = std::int64_t(cell.x);
    const auto y = std::int64_t(cell.y);
    const auto z = std::int64_t(cell.z);
    const std::uint64_t block = std::uint64_t(x >> 2) * 0x9e3779b97f4a7c15ull +
      std::uint64_t(y >> 2) * 0xc2b2ae3d27d4eb4full + std::uint64_t(z >> 2) * 0x165667b19e3779f9ull;
    const auto within = std::size_t((z & 3) << 4 | (y & 3) << 2 | (x & 3));
    return (std::size_t(block ^ (block >> 32)) * 64 & (first_.size() - 1)) | within;
  }

  double squaredDistance_;
  double perCell_;
  std::vector<std::uint32_t> first_;
  std::vector<Entry> entries_;
};

struct Candidate
{
  glm::dvec3 place;
  double radius;
  std::uint32_t index;
};

std::vector<std::uint32_t> shuffled(std::size_t count, RandomStream& random)
{
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  for (std::size_t i = count; i > 1; --i)
  {
    std::swap(order[i - 1], order[random.next() % i]);
  }
  return order;
}

double radiusAt(std::size_t step, double first)
{
  return first * std::exp2(-0.5 * double(step));
}

/// The candidates, in random order, by the first step at which they are looked at: at a large
/// distance a share of them, as dense for that distance as all of them are for their own.
std::vector<std::vector<Candidate>> bySteps(const std::vector<glm::dvec3>& places,
  const std::vector<double>& radii, double first, std::size_t steps, RandomStream& random)
{
  std::vector<std::vector<Candidate>> waiting(steps);
  for (std::uint32_t index : shuffled(places.size(), random))
  {
    const double ratio = first / radii[index];
    const double step = std::ceil(std::log2(random.uniform() * ratio * ratio / rounding));
    const auto bucket = std::size_t(std::clamp(step, 0.0, double(steps - 1)));
    waiting[bucket].push_back({ places[index], radii[index], index });
  }
  return waiting;
}

/// The largest radius times a power of two, so that halving it meets the radius of every candidate
/// whose radii differ by powers of two; about the size of the scene.
double firstRadius(const std::vector<glm::dvec3>& candidates, double largest)
{
  Bounds box;
  for (const glm::dvec3& place : candidates)
  {
    box.add(place);
  }
  const glm::dvec3 size = box.size();
  const double extent = std::max({ size.x, size.y, size.z, largest });
  return std::ldexp(largest, int(std::ceil(std::log2(extent / largest))));
}
} // namespace

std::vector<std::uint32_t> poissonOrder(
  const std::vector<glm::dvec3>& candidates, const std::vector<double>& radii, std::uint64_t seed)
{
  std::vector<std::uint32_t> picked;
  if (candidates.empty())
  {
    return picked;
  }
  RandomStream random(seed);
  const double smallest = *std::min_element(radii.begin(), radii.end());
  const double first = firstRadius(candidates, *std::max_element(radii.begin(), radii.end()));
  std::size_t steps = 1;
  while (radiusAt(steps, first) * rounding >= smallest)
  {
    ++steps;
  }
  std::vector<std::vector<Candidate>> waiting = bySteps(candidates, radii, first, steps, random);
  std::vector<glm::dvec3> places; // places of the picked points
  for (std::size_t step = 0; step < steps; ++step)
  {
    const double radius = radiusAt(step, first);
    PickedPoints near(radius, 8 * places.size());
    std::for_each(places.begin(), places.end(), [&](const glm::dvec3& p) { near.add(p); });
    for (const Candidate& candidate : waiting[step])
    {
      if (!near.isNear(candidate.place))
      {
        near.add(candidate.place);
        places.push_back(candidate.place);
        picked.push_back(candidate.index);
      }
      else if (candidate.radius * rounding < radius && step + 1 < steps)
      {
        waiting[step + 1].push_back(candidate);
      }
    }
    waiting[step] = {};
  }
  return picked;
}

} // namespace pointfront::truth
