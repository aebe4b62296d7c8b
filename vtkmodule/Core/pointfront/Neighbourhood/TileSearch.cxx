#include "pointfront/Neighbourhood/TileSearch.h"

#include "pointfront/Base/Infinity.h"
#include "pointfront/Points/KnownRegion.h"

#include <algorithm>
#include <cmath>

namespace pointfront
{
namespace
{
constexpr int keyBits = 21; // an axis

/// Bit i of v goes to bit 3 i.
std::uint64_t spread(std::uint64_t v)
{
  v = (v | v << 32) & 0x001f00000000ffffull;
  v = (v | v << 16) & 0x001f0000ff0000ffull;
  v = (v | v << 8) & 0x100f00f00f00f00full;
  v = (v | v << 4) & 0x10c30c30c30c30c3ull;
  return (v | v << 2) & 0x1249249249249249ull;
}

bool samePlace(const glm::dvec3& a, const glm::dvec3& b, unsigned axes)
{
  return a.x == b.x && a.y == b.y && (axes < 3 || a.z == b.z);
}
} // namespace

PlaceOrder placeOrder(const std::vector<TilePoint>& points)
{
  Bounds bounds;
  for (const TilePoint& point : points)
  {
    bounds.add(point.position);
  }
  struct Keyed
  {
    std::uint64_t key;
    std::uint32_t index;
  };
  std::vector<Keyed> keyed(points.size());
  const glm::dvec3 size = points.empty() ? glm::dvec3(1.0) : bounds.size();
  const double longest = std::max({ size.x, size.y, size.z });
  const double scale = longest > 0.0 ? ((1 << keyBits) - 1) / longest : 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const glm::dvec3 at = (points[i].position - bounds.low) * scale;
    keyed[i] = { spread(static_cast<std::uint64_t>(at.x)) |
        spread(static_cast<std::uint64_t>(at.y)) << 1 |
        spread(static_cast<std::uint64_t>(at.z)) << 2,
      static_cast<std::uint32_t>(i) };
  }
  std::sort(keyed.begin(), keyed.end(),
    [&](const Keyed& a, const Keyed& b)
    {
      return a.key != b.key ? a.key < b.key
                            : positionLess(points[a.index].position, points[b.index].position);
    });
  PlaceOrder order;
  order.points.reserve(points.size());
  order.keys.reserve(points.size());
  for (const Keyed& k : keyed)
  {
    order.points.push_back(k.index);
    order.keys.push_back(k.key);
  }
  return order;
}

PlaceOrder queriesOf(const PlaceOrder& order, const std::vector<TilePoint>& points, std::size_t own,
  const ClassSet& queries, const KnownRegion* region)
{
  PlaceOrder chosen;
  chosen.points.reserve(own);
  chosen.keys.reserve(own);
  for (std::size_t i = 0; i < order.points.size(); ++i)
  {
    const std::uint32_t point = order.points[i];
    if (point < own && queries[points[point].objectClass()] &&
      (region == nullptr || region->wants(points[point].position)))
    {
      chosen.points.push_back(point);
      chosen.keys.push_back(order.keys[i]);
    }
  }
  return chosen;
}

std::size_t runEnd(
  const std::vector<std::uint64_t>& keys, std::size_t begin, std::size_t end, std::size_t longest)
{
  if (end - begin <= longest)
  {
    return end;
  }
  std::size_t leaving = begin + longest;
  std::uint64_t largest = 0; // the highest bit that differs tells the cell that is left
  for (std::size_t i = begin + longest / 2; i <= begin + longest; ++i)
  {
    const std::uint64_t difference = keys[i] ^ keys[i - 1];
    if (difference > largest)
    {
      largest = difference;
      leaving = i;
    }
  }
  return leaving;
}

void collectReferences(const std::vector<TilePoint>& points, const PlaceOrder& order,
  const ClassSet& references, unsigned axes, std::uint32_t mostCount, PositionSet& set)
{
  set.clear();
  for (const std::uint32_t i : order.points)
  {
    const glm::dvec3& p = points[i].position;
    if (!references[points[i].objectClass()])
    {
      continue;
    }
    if (!set.positions.empty() && samePlace(p, set.positions.back(), axes))
    {
      set.counts.back() = std::min(set.counts.back() + 1, mostCount);
      continue;
    }
    set.positions.push_back(p);
    set.counts.push_back(1);
  }
  if (axes > 2)
  {
    return;
  }
  // Points above one another are apart on the curve: bring them together.
  std::vector<glm::dvec3>& all = set.positions;
  std::sort(all.begin(), all.end(), positionLess); // the lowest of a column first
  all.erase(std::unique(all.begin(), all.end(),
              [](const glm::dvec3& a, const glm::dvec3& b) { return samePlace(a, b, 2); }),
    all.end());
  set.counts.assign(all.size(), 1);
}

void collectNear(const PositionSet& set, const NeighbourList& list, std::uint32_t wanted,
  std::vector<NearPoint>& near)
{
  near.resize(list.entries().size());
  std::uint32_t total = 0;
  auto place = near.begin();
  for (const NeighbourList::Entry& entry : list.entries())
  {
    place->position = set.positions[entry.index];
    place->squaredDistance = entry.squaredDistance;
    place->count = wanted > 0 ? std::min(entry.count, wanted - total) : entry.count;
    total += place->count;
    ++place;
  }
}

void collectNear(const PositionSet& set, const std::vector<std::uint32_t>& places,
  const glm::dvec3& from, std::vector<NearPoint>& near)
{
  near.resize(places.size());
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const glm::dvec3& position = set.positions[places[i]];
    const glm::dvec3 d = position - from;
    near[i].position = position;
    near[i].squaredDistance = d.x * d.x + d.y * d.y + d.z * d.z;
    near[i].count = 1;
  }
}

double squaredClearance(const Bounds& box, const glm::dvec3& p)
{
  double clearance = infinity;
  for (int axis = 0; axis < 3; ++axis)
  {
    clearance = std::min({ clearance, p[axis] - box.low[axis], box.high[axis] - p[axis] });
  }
  return clearance <= 0.0 ? 0.0 : clearance * clearance * (1.0 - 1e-12);
}

double squaredDistanceTo(const Bounds& box, const glm::dvec3& p, unsigned axes)
{
  double sum = 0.0;
  for (int axis = 0; axis < static_cast<int>(axes); ++axis)
  {
    const double out = std::max({ 0.0, box.low[axis] - p[axis], p[axis] - box.high[axis] });
    sum += out * out;
  }
  return sum;
}

double squaredDistanceAcross(const Bounds& box, const glm::dvec3& p, unsigned axes)
{
  double sum = 0.0;
  for (int axis = 0; axis < static_cast<int>(axes); ++axis)
  {
    const double across = std::max(p[axis] - box.low[axis], box.high[axis] - p[axis]);
    sum += across * across;
  }
  return sum;
}

} // namespace pointfront
