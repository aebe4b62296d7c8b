#include "pointfront/Neighbourhood/FourLanes.h"
#include "pointfront/Neighbourhood/PlaceSelection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace
{
using namespace pointfront;

/// `count` places around a middle; with `steps`, on a grid of so many an axis, full of ties.
PlaceBall someBall(std::size_t count, int steps, unsigned seed)
{
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  const auto coordinate = [&]
  {
    const float value = uniform(random);
    return steps > 0 ? std::round(value * float(steps)) / float(steps) : value;
  };
  PlaceBall ball;
  ball.resize(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    ball.places[i] = static_cast<std::uint32_t>(i);
    ball.x[i] = coordinate();
    ball.y[i] = coordinate();
    ball.z[i] = coordinate();
  }
  return ball;
}

std::vector<float> sortedDistances(const PlaceSelection& selection)
{
  const auto& squared = selection.distances().squared;
  std::vector<float> sorted(
    squared.begin(), squared.begin() + static_cast<std::ptrdiff_t>(selection.size()));
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

TEST(PlaceSelection, SelectsWhatIsWithinTheLimitInTheOrderOfTheBall)
{
  for (std::size_t count = 0; count < 40; ++count)
  {
    const PlaceBall ball = someBall(count, 3, unsigned(count));
    PlaceSelection selection;
    selection.measure(ball, glm::dvec3(0.25), 3);
    for (const float limit : { 0.0f, 0.5f, 1.0f, 1e6f, PlaceSelection::everything })
    {
      selection.select(limit);
      std::vector<std::uint32_t> expected;
      for (std::uint32_t i = 0; i < count; ++i)
      {
        if (selection.measured().squared[i] <= limit)
        {
          expected.push_back(i);
        }
      }
      ASSERT_EQ(selection.size(), expected.size());
      EXPECT_EQ(PlaceSelection::countWithin(selection.measured(), limit), expected.size());
      for (std::size_t i = 0; i < expected.size(); ++i)
      {
        EXPECT_EQ(selection[i], expected[i]);
        EXPECT_EQ(selection.distances().squared[i], selection.measured().squared[expected[i]]);
      }
    }
  }
}

TEST(PlaceSelection, KeepsTheNearestOrSaysThatTiesLeaveNone)
{
  int kept = 0;
  int tied = 0;
  for (unsigned seed = 0; seed < 200; ++seed)
  {
    const std::size_t count = 1 + seed % PlaceSelection::mostToKeepFrom;
    const PlaceBall ball = someBall(count, seed % 2 == 0 ? 0 : 4, seed);
    for (const std::size_t wanted : { std::size_t(1), (count + 1) / 2, count })
    {
      PlaceSelection selection;
      selection.measure(ball, glm::dvec3(0.0), 3);
      selection.select(PlaceSelection::everything);
      const std::vector<float> sorted = sortedDistances(selection);
      const bool tie = wanted < count && sorted[wanted - 1] == sorted[wanted];
      const auto gap = selection.keepNearest(wanted);
      ASSERT_EQ(gap.has_value(), !tie) << "seed " << seed << ", " << wanted << " of " << count;
      tied += tie ? 1 : 0;
      if (!gap)
      {
        continue;
      }
      ++kept;
      EXPECT_EQ(gap->last, sorted[wanted - 1]);
      EXPECT_EQ(gap->next, wanted < count ? sorted[wanted] : PlaceSelection::everything);
      ASSERT_EQ(selection.size(), wanted);
      const std::vector<float> nearest = sortedDistances(selection);
      EXPECT_TRUE(std::equal(nearest.begin(), nearest.end(), sorted.begin()));
      for (std::size_t i = 0; i < wanted; ++i)
      {
        EXPECT_EQ(selection.distances().squared[i], selection.measured().squared[selection[i]]);
      }
    }
  }
  EXPECT_GT(kept, 300);
  EXPECT_GT(tied, 20);
}

TEST(PlaceSelection, KeepsNothingOfTooFewOrTooMany)
{
  const PlaceBall ball = someBall(PlaceSelection::mostToKeepFrom + 1, 0, 1);
  PlaceSelection selection;
  selection.measure(ball, glm::dvec3(0.0), 3);
  selection.select(PlaceSelection::everything);
  EXPECT_FALSE(selection.keepNearest(1).has_value());
  selection.select(0.01f);
  EXPECT_FALSE(selection.keepNearest(selection.size() + 1).has_value());
}

TEST(FourLanes, BitsAreThoseOfTheLanes)
{
  const FourFloats numbers{ 1.0f, -2.0f, 3.0f, -4.0f };
  EXPECT_EQ(bitsOf(numbers < 0.0f), 0xau);
  EXPECT_EQ(bitsOf(numbers > 0.0f), 0x5u);
  EXPECT_EQ(bitsOf(numbers > 9.0f), 0x0u);
  std::uint32_t list[6] = { 7, 7, 7, 7, 7, 7 };
  EXPECT_EQ(appendSet(numbers < 0.0f, 40, list + 1), 2u);
  EXPECT_EQ(list[0], 7u);
  EXPECT_EQ(list[1], 41u);
  EXPECT_EQ(list[2], 43u);
  EXPECT_EQ(list[5], 7u);
}
} // namespace
