#include "TestBuildClouds.h"

#include "pointfront/Build/PrefixOrder.h"
#include "pointfront/Build/Sampler.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <set>

namespace pointfront
{
namespace
{
using test::Random;

/// Records of positions only, in Morton order.
struct Cloud
{
  std::vector<std::byte> records;
  std::vector<std::uint32_t> all;

  explicit Cloud(const std::vector<TreePosition>& positions)
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
  RecordView view() const { return {records.data(), RecordLayout::positionBytes}; }
};

/// A gently sloped plane through a cube of 2^16 steps.
Cloud plane(std::size_t count)
{
  Random random(3);
  std::vector<TreePosition> positions;
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::uint32_t x = random.next() & 0xffff;
    const std::uint32_t y = random.next() & 0xffff;
    positions.emplace_back(x, y, 20000 + x / 8 + y / 16);
  }
  return Cloud(positions);
}

std::vector<std::uint32_t> sampled(const Cloud& cloud, unsigned cellLog2)
{
  std::vector<bool> chosen;
  SubsetSampler().choose(cloud.view(), cloud.all, cellLog2, chosen);
  std::vector<std::uint32_t> points;
  for (std::size_t i = 0; i < chosen.size(); ++i)
  {
    if (chosen[i])
    {
      points.push_back(cloud.all[i]);
    }
  }
  return points;
}

using Cell = std::array<std::uint32_t, 3>;

std::set<Cell> cellsOf(
  const Cloud& cloud, const std::vector<std::uint32_t>& points, unsigned cellLog2)
{
  std::set<Cell> cells;
  for (const std::uint32_t i : points)
  {
    const TreePosition p = cloud.view().position(i);
    cells.insert({p.x >> cellLog2, p.y >> cellLog2, p.z >> cellLog2});
  }
  return cells;
}

/// Mean distance to the nearest other point, brute force.
double meanNearestDistance(const Cloud& cloud, const std::vector<std::uint32_t>& points)
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

TEST(Sampler, CountsOccupiedCellsOfEverySize)
{
  const Cloud cloud = plane(3000);
  const CellOccupancy occupancy = cellOccupancy(cloud.view(), cloud.all);
  for (const unsigned level : {0u, 5u, 9u, 12u, 16u, 32u})
  {
    EXPECT_EQ(occupancy.distinct[level], level == 32 ? 1 : cellsOf(cloud, cloud.all, level).size());
  }
}

TEST(Sampler, CoversAllPointsWithoutClumps)
{
  const unsigned cellLog2 = 11;
  const double cell = 2048.0;
  const Cloud cloud = plane(20000);
  const std::vector<std::uint32_t> points = sampled(cloud, cellLog2);
  EXPECT_EQ(cellsOf(cloud, points, cellLog2).size(), points.size()); // at most one a cell
  EXPECT_GT(points.size(), 900u);
  for (const std::uint32_t i : cloud.all)
  {
    double nearest = HUGE_VAL;
    for (const std::uint32_t k : points)
    {
      const glm::dvec3 a(cloud.view().position(i));
      const double distance = glm::length(a - glm::dvec3(cloud.view().position(k)));
      nearest = i == k ? nearest : std::min(nearest, distance);
    }
    const bool taken = std::binary_search(points.begin(), points.end(), i);
    ASSERT_TRUE(taken ? nearest >= 0.5 * cell : nearest <= 2.3 * cell) << i << ' ' << nearest;
  }
}

TEST(Sampler, TakesThePointNearestToTheTarget)
{
  // One cell of 2^4 = 16 steps, target at 16 / 3; of 2^3 = 8, target at 2 * 8 / 3.
  const Cloud cloud({{0, 0, 0}, {5, 5, 5}, {7, 5, 5}, {15, 15, 15}});
  EXPECT_EQ(sampled(cloud, 4), (std::vector<std::uint32_t>{1}));
  EXPECT_EQ(sampled(cloud, 3), (std::vector<std::uint32_t>{1, 3}));
  const Cloud equal({{2, 2, 2}, {2, 2, 2}});
  EXPECT_EQ(sampled(equal, 4), (std::vector<std::uint32_t>{0})); // input order decides
}

TEST(Sampler, FindsClumpsAcrossTheEdgesOfTheTree)
{
  const std::uint32_t top = ~0u;
  const Cloud cloud({{15, 0, 0}, {16, 0, 0}, {top, top, top}});
  EXPECT_EQ(sampled(cloud, 4), (std::vector<std::uint32_t>{0, 2})); // 15 comes first
  EXPECT_EQ(sampled(cloud, 32).size(), 1u);
  EXPECT_EQ(sampled(cloud, 0).size(), 3u);
}

TEST(Sampler, TargetsOfCoarseCellsAreTargetsOfFineOnes)
{
  const Cloud cloud = plane(200000);
  std::vector<std::uint32_t> fine = sampled(cloud, 9);
  std::vector<bool> chosen;
  SubsetSampler().choose(cloud.view(), fine, 10, chosen);
  std::vector<std::uint32_t> fromFine;
  for (std::size_t i = 0; i < fine.size(); ++i)
  {
    if (chosen[i])
    {
      fromFine.push_back(fine[i]);
    }
  }
  const std::vector<std::uint32_t> fromAll = sampled(cloud, 10);
  std::vector<std::uint32_t> same;
  std::set_intersection(
    fromFine.begin(), fromFine.end(), fromAll.begin(), fromAll.end(), std::back_inserter(same));
  EXPECT_GT(static_cast<double>(same.size()), 0.5 * static_cast<double>(fromAll.size()));
}

TEST(Sampler, SpreadsPointsBetterThanChance)
{
  const Cloud cloud = plane(60000);
  const std::vector<std::uint32_t> points = sampled(cloud, 11);
  ASSERT_GT(points.size(), 1000u);
  Random random(4);
  std::set<std::uint32_t> picked;
  while (picked.size() < points.size())
  {
    picked.insert(static_cast<std::uint32_t>(random.next() % cloud.all.size()));
  }
  const double byChance = meanNearestDistance(cloud, {picked.begin(), picked.end()});
  EXPECT_GT(meanNearestDistance(cloud, points), 1.4 * byChance);
}

TEST(Sampler, KeepsANodeWithinItsPointsAndTwiceAsCoarseAsItsChildren)
{
  SamplingRule rule;
  EXPECT_EQ(rule.finestGrid(), 7u);
  CellOccupancy occupancy; // a block: eight times more cells for half the size
  for (unsigned level = 0; level <= 32; ++level)
  {
    occupancy.distinct[level] = level >= 20 ? 1 : std::uint64_t(1) << (3 * (20 - level));
  }
  EXPECT_EQ(samplingCell(occupancy, 20, -1, rule), 15u); // 32^3 = 32768 = 2 * 16384
  for (unsigned level = 0; level <= 32; ++level)
  {
    occupancy.distinct[level] = level >= 20 ? 1 : std::uint64_t(1) << (2 * (20 - level));
  }
  EXPECT_EQ(samplingCell(occupancy, 20, -1, rule), 13u); // a plane: all 128^2 cells
  EXPECT_EQ(samplingCell(occupancy, 20, 13, rule), 14u);
  EXPECT_EQ(samplingCell(occupancy, 0, -1, rule), 0u);
}

TEST(Sampler, EstimatesTheSpacingOfASurface)
{
  const std::size_t count = 20000;
  const Cloud cloud = plane(count);
  const double expected = std::sqrt(65536.0 * 65536.0 / static_cast<double>(count));
  const double estimate = surfaceSpacing(cellOccupancy(cloud.view(), cloud.all), count, 16);
  EXPECT_NEAR(estimate, expected, 0.15 * expected);
}

TEST(BuildPrefixOrder, EveryPrefixCoversTheNode)
{
  const Cloud cloud = plane(16384);
  const std::vector<std::uint32_t> order = prefixOrder(cloud.view(), cloud.all);
  ASSERT_TRUE(std::is_permutation(order.begin(), order.end(), cloud.all.begin()));
  Random random(5);
  for (const std::size_t prefix : {64u, 300u, 1000u, 5000u, 16000u})
  {
    // Cells of which about half would be hit by chance.
    const auto level = static_cast<unsigned>(std::lround(16.0 - 0.5 * std::log2(prefix)));
    const auto size = [&](const std::vector<std::uint32_t>& points)
    {
      std::set<std::pair<std::uint32_t, std::uint32_t>> cells;
      for (const std::uint32_t i : points)
      {
        const TreePosition p = cloud.view().position(i);
        cells.insert({p.x >> level, p.y >> level});
      }
      return static_cast<double>(cells.size());
    };
    std::vector<std::uint32_t> byChance;
    for (std::size_t i = 0; i < prefix; ++i)
    {
      byChance.push_back(static_cast<std::uint32_t>(random.next() % order.size()));
    }
    const std::vector<std::uint32_t> first(
      order.begin(), order.begin() + static_cast<std::ptrdiff_t>(prefix));
    EXPECT_GT(size(first), 1.1 * size(byChance)) << prefix;
  }
}

TEST(BuildPrefixOrder, BatchesAreInMortonOrder)
{
  const Cloud cloud = plane(4096);
  const std::vector<std::uint32_t> order = prefixOrder(cloud.view(), cloud.all);
  std::size_t turns = 0;
  for (std::size_t i = 1; i < order.size(); ++i)
  {
    turns += order[i] < order[i - 1] ? 1 : 0;
  }
  EXPECT_LE(turns, 10u); // 4096 = 4 + 4 + 8 + ... + 2048: eleven batches
  EXPECT_EQ(prefixOrder(cloud.view(), {}).size(), 0u);
  EXPECT_EQ(prefixOrder(cloud.view(), {7}), (std::vector<std::uint32_t>{7}));
}

} // namespace
} // namespace pointfront
