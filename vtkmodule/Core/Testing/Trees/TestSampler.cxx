#include "SortedCloud.h"
#include "TestBuildClouds.h"

#include "pointfront/Trees/PrefixOrder.h"
#include "pointfront/Trees/Sampler.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <set>

namespace pointfront
{
namespace
{
using test::meanNearestDistance;
using test::plane;
using test::Random;
using Cloud = test::SortedCloud;

std::vector<std::uint32_t> sampled(
  const Cloud& cloud, const std::vector<std::uint32_t>& candidates, SamplingDistance distance)
{
  std::vector<std::uint32_t> chosen;
  SubsetSampler().choose(cloud.view(), candidates, distance, chosen);
  std::vector<std::uint32_t> points;
  for (const std::uint32_t place : chosen)
  {
    points.push_back(candidates[place]);
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
    cells.insert({ p.x >> cellLog2, p.y >> cellLog2, p.z >> cellLog2 });
  }
  return cells;
}

TEST(Sampler, CountsOccupiedCellsOfEverySize)
{
  const Cloud cloud = plane(3000);
  const CellOccupancy occupancy = cellOccupancy(cloud.view(), cloud.all);
  for (const unsigned level : { 0u, 5u, 9u, 12u, 16u, 32u })
  {
    EXPECT_EQ(occupancy.distinct[level], level == 32 ? 1 : cellsOf(cloud, cloud.all, level).size());
  }
}

/// Between two points on the curve, the largest step is the one between them alone.
TEST(Sampler, CountsOccupiedCellsByStepsAlone)
{
  const Cloud cloud = plane(3000);
  for (const std::size_t every : { 1u, 2u, 7u })
  {
    std::vector<std::uint32_t> points;
    std::vector<std::uint8_t> steps;
    std::uint8_t step = 200; // that of the first says nothing
    for (std::size_t i = 0; i < cloud.all.size(); ++i)
    {
      if (i > 0)
      {
        step = std::max(step,
          std::uint8_t(differingBits(cloud.view().position(i), cloud.view().position(i - 1))));
      }
      if (i % every == every - 1)
      {
        points.push_back(cloud.all[i]);
        steps.push_back(std::exchange(step, std::uint8_t(0)));
      }
    }
    const CellOccupancy asked = cellOccupancy(cloud.view(), points);
    EXPECT_EQ(cellOccupancy(steps.data(), steps.size()).distinct, asked.distinct) << every;
  }
  EXPECT_EQ(cellOccupancy(nullptr, 0).distinct[32], 0u);
}

TEST(Sampler, CountsCellsOfRunsThatFollowEachOther)
{
  const Cloud cloud = plane(3000);
  const CellOccupancy whole = cellOccupancy(cloud.view(), cloud.all);
  CellOccupancy joined;
  std::size_t begin = 0;
  for (const std::size_t end : { 1u, 2u, 700u, 2999u, 3000u })
  {
    const auto first = cloud.all.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = cloud.all.begin() + static_cast<std::ptrdiff_t>(end);
    const unsigned between = begin == 0
      ? 0
      : differingBits(cloud.view().position(begin - 1), cloud.view().position(begin));
    joined.append(cellOccupancy(cloud.view(), { first, last }), between);
    begin = end;
  }
  EXPECT_EQ(joined.distinct, whole.distinct);
}

double distanceOf(const Cloud& cloud, std::uint32_t a, std::uint32_t b)
{
  return glm::length(glm::dvec3(cloud.view().position(a)) - glm::dvec3(cloud.view().position(b)));
}

double nearest(const Cloud& cloud, std::uint32_t point, const std::vector<std::uint32_t>& points)
{
  double least = HUGE_VAL;
  for (const std::uint32_t k : points)
  {
    least = k == point ? least : std::min(least, distanceOf(cloud, point, k));
  }
  return least;
}

TEST(Sampler, DistancesAreQuartersOfAnOctave)
{
  EXPECT_EQ(SamplingDistance{ 0 }.squaredSteps(), 1.0);
  EXPECT_EQ(SamplingDistance{ 8 }.steps(), 4.0);
  EXPECT_NEAR(SamplingDistance{ 3 }.steps(), std::pow(2.0, 0.75), 1e-12);
  EXPECT_NEAR(SamplingDistance{ 126 }.steps(), std::pow(2.0, 31.5), 1e-3);
}

TEST(Sampler, KeepsTheDistanceAndCoversAllPoints)
{
  const Cloud cloud = plane(20000);
  for (const int quarters : { 41, 43, 44, 46 })
  {
    const SamplingDistance distance{ quarters };
    const std::vector<std::uint32_t> points = sampled(cloud, cloud.all, distance);
    ASSERT_GT(points.size(), 300u);
    for (const std::uint32_t i : cloud.all)
    {
      const bool taken = std::binary_search(points.begin(), points.end(), i);
      const double reach = nearest(cloud, i, points);
      ASSERT_TRUE(taken ? reach >= distance.steps() : reach < distance.steps()) << i;
    }
  }
}

TEST(Sampler, KeepsTheDistanceInABlockToo)
{
  Random random(6);
  std::vector<TreePosition> positions;
  for (int i = 0; i < 8000; ++i)
  {
    positions.emplace_back(random.next() % 4096, random.next() % 4096, random.next() % 4096);
  }
  const Cloud cloud(positions);
  const SamplingDistance distance{ 33 };
  const std::vector<std::uint32_t> points = sampled(cloud, cloud.all, distance);
  for (const std::uint32_t i : cloud.all)
  {
    const bool taken = std::binary_search(points.begin(), points.end(), i);
    const double reach = nearest(cloud, i, points);
    ASSERT_TRUE(taken ? reach >= distance.steps() : reach < distance.steps()) << i;
  }
}

TEST(Sampler, TakesOneOfEqualPoints)
{
  const Cloud equal({ { 2, 2, 2 }, { 2, 2, 2 }, { 2, 2, 2 } });
  EXPECT_EQ(
    sampled(equal, equal.all, { 0 }), (std::vector<std::uint32_t>{ 0 })); // input order decides
  EXPECT_TRUE(sampled(equal, {}, { 8 }).empty());
}

TEST(Sampler, DoesNotWrapAroundTheEdgesOfTheTree)
{
  const std::uint32_t top = ~0u;
  const Cloud cloud({ { 15, 0, 0 }, { 16, 0, 0 }, { top, top, top } });
  EXPECT_EQ(
    sampled(cloud, cloud.all, { 16 }), (std::vector<std::uint32_t>{ 0, 2 })); // 15 comes first
  EXPECT_EQ(sampled(cloud, cloud.all, { 128 }).size(), 2u); // the diagonal is longer than an edge
  EXPECT_EQ(sampled(cloud, cloud.all, { 0 }).size(), 3u);
}

TEST(Sampler, SpreadsPointsAsDartsThatKeepTheirDistance)
{
  const Cloud cloud = plane(60000);
  const SamplingDistance distance{ 44 };
  const std::vector<std::uint32_t> points = sampled(cloud, cloud.all, distance);
  ASSERT_GT(points.size(), 600u);
  Random random(4);
  std::set<std::uint32_t> picked;
  while (picked.size() < points.size())
  {
    picked.insert(static_cast<std::uint32_t>(random.next() % cloud.all.size()));
  }
  // Darts: points in random order, each kept if it is not too close to one before.
  std::vector<std::uint32_t> order = cloud.all;
  for (std::size_t i = order.size(); i-- > 1;)
  {
    std::swap(order[i], order[random.next() % (i + 1)]);
  }
  std::vector<std::uint32_t> darts;
  for (const std::uint32_t i : order)
  {
    if (nearest(cloud, i, darts) >= distance.steps())
    {
      darts.push_back(i);
    }
  }
  // The mean distance in units of the largest that so many points allow.
  const auto spread = [&](const std::vector<std::uint32_t>& set)
  { return meanNearestDistance(cloud, set) * std::sqrt(static_cast<double>(set.size())); };
  EXPECT_GT(spread(points), 1.5 * spread({ picked.begin(), picked.end() }));
  EXPECT_GT(spread(points), 0.97 * spread(darts));
}

/// Cells of a block or a plane of 2^20 steps an edge.
CellOccupancy filled(unsigned dimensions)
{
  CellOccupancy occupancy;
  for (unsigned level = 0; level <= 32; ++level)
  {
    occupancy.distinct[level] = level >= 20 ? 1 : std::uint64_t(1) << (dimensions * (20 - level));
  }
  return occupancy;
}

TEST(Sampler, ChoosesTheDistanceThatFillsANode)
{
  const SamplingRule rule; // 16384 points: up to 21845 cells
  const std::uint64_t many = std::uint64_t(1) << 40;
  EXPECT_EQ(samplingDistance(filled(2), many, -1, rule).quarters, 52); // 2^14 cells
  EXPECT_EQ(samplingDistance(filled(3), many, -1, rule).quarters, 61); // 2^14.25 cells
  EXPECT_EQ(samplingDistance(filled(2), many, 51, rule).quarters, 53); // coarser than its children
  EXPECT_EQ(samplingDistance(filled(2), 2048, -1, rule).quarters, 60); // half of 2048: 2^10 cells
  EXPECT_EQ(samplingDistance(filled(2), many, 127, rule).quarters, 128);
}

TEST(Sampler, AFullerNodeThanExpectedIsStillOfItsOrder)
{
  const Cloud cloud = plane(60000);
  SamplingRule rule;
  rule.nodePoints = 2000;
  const SamplingDistance distance =
    samplingDistance(cellOccupancy(cloud.view(), cloud.all), cloud.all.size(), -1, rule);
  const std::size_t held = sampled(cloud, cloud.all, distance).size();
  EXPECT_GT(held, 1000u);
  EXPECT_LT(held, 2400u);
}

TEST(Sampler, EstimatesTheSpacingOfASurface)
{
  const std::size_t count = 20000;
  const Cloud cloud = plane(count);
  const double expected = std::sqrt(65536.0 * 65536.0 / static_cast<double>(count));
  const double estimate = surfaceSpacing(cellOccupancy(cloud.view(), cloud.all), 16);
  EXPECT_NEAR(estimate, expected, 0.15 * expected);
}

TEST(Sampler, SpacingIsThatOfPlaces)
{
  const Cloud once = plane(2000);
  std::vector<TreePosition> positions;
  for (std::size_t i = 0; i < 7 * once.all.size(); ++i)
  {
    positions.push_back(once.view().position(i / 7));
  }
  const Cloud copies(positions);
  const CellOccupancy occupancy = cellOccupancy(copies.view(), copies.all);
  EXPECT_EQ(occupancy.places(), placesOf(copies.view(), copies.all));
  EXPECT_EQ(occupancy.places(), cellOccupancy(once.view(), once.all).places());
  EXPECT_EQ(
    surfaceSpacing(occupancy, 16), surfaceSpacing(cellOccupancy(once.view(), once.all), 16));
  EXPECT_EQ(surfaceSpacing(copies.view(), copies.all), surfaceSpacing(once.view(), once.all));
}

TEST(BuildPrefixOrder, EveryPrefixCoversTheNode)
{
  const Cloud cloud = plane(16384);
  const std::vector<std::uint32_t> order = prefixOrder(cloud.view(), cloud.all);
  ASSERT_TRUE(std::is_permutation(order.begin(), order.end(), cloud.all.begin()));
  Random random(5);
  for (const std::size_t prefix : { 64u, 300u, 1000u, 5000u, 16000u })
  {
    // Cells of which about half would be hit by chance.
    const auto level = static_cast<unsigned>(std::lround(16.0 - 0.5 * std::log2(prefix)));
    const auto size = [&](const std::vector<std::uint32_t>& points)
    {
      std::set<std::pair<std::uint32_t, std::uint32_t>> cells;
      for (const std::uint32_t i : points)
      {
        const TreePosition p = cloud.view().position(i);
        cells.insert({ p.x >> level, p.y >> level });
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
  EXPECT_EQ(prefixOrder(cloud.view(), { 7 }), (std::vector<std::uint32_t>{ 7 }));
}

} // namespace
} // namespace pointfront
