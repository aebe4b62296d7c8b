#include "SortedCloud.h"
#include "TestBuildClouds.h"

#include "pointfront/Trees/ExactSampler.h"

#include <gtest/gtest.h>

#include <set>

namespace pointfront
{
namespace
{
using test::plane;
using test::Random;
using test::SortedCloud;

/// The points that are chosen.
std::vector<std::uint32_t> exactly(const SortedCloud& cloud, std::uint64_t wanted)
{
  std::vector<std::uint32_t> places;
  ExactSampler().choose(
    cloud.view(), cloud.all, cellOccupancy(cloud.view(), cloud.all), wanted, places);
  EXPECT_TRUE(std::is_sorted(places.begin(), places.end()));
  EXPECT_EQ(std::adjacent_find(places.begin(), places.end()), places.end());
  return places; // places of all points: these are their numbers
}

TEST(ExactSampler, ChoosesExactlyAsManyAsWanted)
{
  const SortedCloud cloud = plane(5000);
  for (const std::uint64_t wanted : { 0u, 1u, 2u, 3u, 100u, 1666u, 2500u, 4999u, 5000u })
  {
    EXPECT_EQ(exactly(cloud, wanted).size(), wanted);
  }
}

TEST(ExactSampler, EqualPointsAreChosenEvenly)
{
  const SortedCloud equal(std::vector<TreePosition>(1000, TreePosition(7, 7, 7)));
  const std::vector<std::uint32_t> points = exactly(equal, 250);
  ASSERT_EQ(points.size(), 250u);
  for (std::size_t begin = 0; begin < 1000; begin += 100)
  {
    const auto of = [&](std::size_t place)
    { return std::lower_bound(points.begin(), points.end(), place) - points.begin(); };
    EXPECT_NEAR(static_cast<double>(of(begin + 100) - of(begin)), 25.0, 5.0) << begin;
  }
}

TEST(ExactSampler, ADenseHeapDoesNotTakeThePlacesOfTheRest)
{
  // Nine of ten points lie in one of 256 cells of the plane.
  const SortedCloud thin = plane(2000);
  std::vector<TreePosition> positions;
  for (const std::uint32_t i : thin.all)
  {
    positions.push_back(thin.view().position(i));
  }
  Random random(8);
  for (int i = 0; i < 18000; ++i)
  {
    positions.emplace_back(random.next() % 4096, random.next() % 4096, 20000);
  }
  const SortedCloud cloud(positions);
  const auto points = exactly(cloud, 1000);
  std::size_t inHeap = 0;
  for (const std::uint32_t i : points)
  {
    const TreePosition p = cloud.view().position(i);
    inHeap += p.x < 4096 && p.y < 4096 ? 1 : 0;
  }
  EXPECT_LT(inHeap, 100u); // 900 by chance
}

TEST(ExactSampler, SpreadsPointsWiderThanChance)
{
  const SortedCloud cloud = plane(20000);
  Random random(4);
  for (const std::size_t wanted : { 300u, 2000u })
  {
    std::set<std::uint32_t> picked;
    while (picked.size() < wanted)
    {
      picked.insert(static_cast<std::uint32_t>(random.next() % cloud.all.size()));
    }
    // 1.5 for a maximal Poisson-disk sample; thinning it takes some of that.
    EXPECT_GT(test::meanNearestDistance(cloud, exactly(cloud, wanted)),
      1.35 * test::meanNearestDistance(cloud, { picked.begin(), picked.end() }))
      << wanted;
  }
}

TEST(ExactSampler, OneInstanceForgetsWhatItChoseBefore)
{
  const SortedCloud cloud = plane(3000);
  const CellOccupancy occupancy = cellOccupancy(cloud.view(), cloud.all);
  ExactSampler sampler;
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> again;
  sampler.choose(cloud.view(), cloud.all, occupancy, 700, first);
  sampler.choose(cloud.view(), cloud.all, occupancy, 90, again);
  sampler.choose(cloud.view(), cloud.all, occupancy, 700, again);
  EXPECT_EQ(first, again);
}

} // namespace
} // namespace pointfront
