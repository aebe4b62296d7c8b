#pragma once

#include "TestBuildClouds.h"

#include "pointfront/Records/MortonOrder.h"
#include "pointfront/Records/RecordLayout.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace pointfront::test
{

/// Records of positions only, in Morton order.
struct SortedCloud
{
  std::vector<std::byte> records;
  std::vector<std::uint32_t> all;

  explicit SortedCloud(const std::vector<TreePosition>& positions)
  {
    std::vector<TreePosition> sorted = positions;
    std::stable_sort(sorted.begin(), sorted.end(), mortonLess);
    records.resize(sorted.size() * RecordLayout::positionBytes);
    for (std::size_t i = 0; i < sorted.size(); ++i)
    {
      setPosition(records.data() + i * RecordLayout::positionBytes, sorted[i]);
    }
    all.resize(sorted.size());
    std::iota(all.begin(), all.end(), 0u);
  }
  RecordSpan view() const { return { records.data(), RecordLayout::positionBytes }; }
};

/// A gently sloped plane through a cube of 2^16 steps.
inline SortedCloud plane(std::size_t count)
{
  Random random(3);
  std::vector<TreePosition> positions;
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::uint32_t x = random.next() & 0xffff;
    const std::uint32_t y = random.next() & 0xffff;
    positions.emplace_back(x, y, 20000 + x / 8 + y / 16);
  }
  return SortedCloud(positions);
}

/// Mean distance to the nearest other point, brute force.
inline double meanNearestDistance(
  const SortedCloud& cloud, const std::vector<std::uint32_t>& points)
{
  double sum = 0.0;
  for (const std::uint32_t i : points)
  {
    double nearest = HUGE_VAL;
    for (const std::uint32_t k : points)
    {
      const glm::dvec3 d =
        glm::dvec3(cloud.view().position(i)) - glm::dvec3(cloud.view().position(k));
      nearest = i == k ? nearest : std::min(nearest, glm::length(d));
    }
    sum += nearest;
  }
  return sum / static_cast<double>(points.size());
}

} // namespace pointfront::test
