#include "pointfront/Points/KnownRegion.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace pointfront;

namespace
{
Bounds columnsBetween(double west, double south, double east, double north)
{
  Bounds box;
  box.low = { west, south, -infinity };
  box.high = { east, north, infinity };
  return box;
}

TEST(KnownRegion, SaysHowFarAValueLookedBeyondIt)
{
  KnownRegion region(columnsBetween(0, 0, 10, 10), columnsBetween(-5, -5, 15, 15));
  region.note({ 1, 5, 900 }, 5.9 * 5.9); // 6 to the west
  EXPECT_EQ(region.squaredMissing(), 0.0);
  region.note({ 1, 5, 900 }, 7.0 * 7.0);
  EXPECT_NEAR(std::sqrt(region.squaredMissing()), 7.0, 1e-6);
  region.note({ 9, 9, 0 }, 6.5 * 6.5);
  EXPECT_NEAR(std::sqrt(region.squaredMissing()), 7.0, 1e-6);
}

TEST(KnownRegion, TakesAReachUpToItsEdgeAsTooFar)
{
  KnownRegion region(columnsBetween(0, 0, 10, 10), columnsBetween(-5, -5, 15, 15));
  region.note({ 0, 5, 0 }, 25.0);
  EXPECT_GT(region.squaredMissing(), 0.0);
}

TEST(KnownRegion, DoesNotMindWhereNoValueIsWanted)
{
  KnownRegion region(columnsBetween(0, 0, 10, 10), columnsBetween(-5, -5, 15, 15));
  region.note({ -1, 5, 0 }, infinity);
  EXPECT_EQ(region.squaredMissing(), 0.0);
}

TEST(KnownRegion, IsEnoughIfItIsTheWholeCloud)
{
  KnownRegion all(
    columnsBetween(0, 0, 10, 10), columnsBetween(-infinity, -infinity, infinity, infinity));
  all.note({ 5, 5, 0 }, infinity);
  EXPECT_EQ(all.squaredMissing(), 0.0);
  KnownRegion part(columnsBetween(0, 0, 10, 10), columnsBetween(-5, -5, 15, 15));
  part.note({ 5, 5, 0 }, infinity); // fewer points than neighbours
  EXPECT_EQ(part.squaredMissing(), infinity);
}
} // namespace
