#include "TestBuildClouds.h"

#include "pointfront/Front/PointPrefix.h"
#include "pointfront/Front/ThresholdLadder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace pointfront
{

TEST(PointPrefix, FadesInBetweenTheParentsTurnAndItsOwn)
{
  EXPECT_EQ(prefixFraction(2.0, 0.5, 4.0), 0.0); // the parent's 4 px are fine enough
  EXPECT_EQ(prefixFraction(2.0, 0.5, 9.0), 0.0);
  EXPECT_EQ(prefixFraction(2.0, 0.5, 2.0), 1.0);
  EXPECT_EQ(prefixFraction(2.0, 0.5, 0.1), 1.0);
  // Half way in density: 1/t^2 = (1/2^2 + 1/4^2) / 2.
  EXPECT_NEAR(prefixFraction(2.0, 0.5, 1.0 / std::sqrt((0.25 + 0.0625) / 2.0)), 0.5, 1e-12);
  EXPECT_NEAR(prefixFraction(2.0, 0.0, 4.0), 0.25, 1e-12); // a root: spacing ~ sqrt(n / k)
  double before = 0.0;
  for (double threshold = 5.0; threshold > 1.0; threshold *= 0.99)
  {
    const double now = prefixFraction(2.0, 0.5, threshold);
    EXPECT_GE(now, before);
    EXPECT_LT(now - before, 0.04) << "no chunk pops up at once";
    before = now;
  }
  const std::uint32_t points = prefixLength(10000, 2.0, 0.5, 3.0);
  EXPECT_NEAR(prefixErrorPx(10000, points, 2.0, 0.5), 3.0, 1e-3);
}

// Whatever the points, a prefix is as dense as the threshold asks, and no point denser.
TEST(PointPrefix, IsNeverSparserThanTheThreshold)
{
  test::Random random(3);
  for (int round = 0; round < 20000; ++round)
  {
    const auto count = static_cast<std::uint32_t>(1 + random.next() % (1u << (random.next() % 15)));
    const double parentPx = std::exp2(12.0 * random.uniform() - 4.0);
    const double ratio = round % 5 == 0 ? 1e-7 * random.uniform() : random.uniform();
    const double ownPx = parentPx * ratio;
    const double threshold = parentPx * random.uniform();
    const std::uint32_t points = prefixLength(count, ownPx, ratio, threshold);
    const bool coarse = ratio * ratio < 0.75 || threshold < ownPx / std::sqrt(0.75);
    EXPECT_GE(points, coarse ? 1u : 0u) << "the parent is too coarse";
    EXPECT_LE(points, count);
    if (points < count)
    {
      EXPECT_LE(prefixErrorPx(count, points, ownPx, ratio), 1.000000001 * threshold);
    }
    if (points > 1 && points < count)
    {
      EXPECT_GE(prefixErrorPx(count, points - 1, ownPx, ratio), 0.999999999 * threshold);
    }
  }
}

TEST(PointPrefix, OfARootIsAPointAtLeast)
{
  EXPECT_EQ(prefixLength(10000, 0.001, 0.0, 100.0), 1u);
  EXPECT_EQ(prefixLength(1, 0.001, 0.0, 100.0), 1u);
  EXPECT_EQ(prefixLength(0, 0.001, 0.0, 100.0), 0u);
  EXPECT_EQ(prefixLength(10000, 0.001, 0.5, 100.0), 0u); // its parent shows
  EXPECT_EQ(prefixLength(10000, 0.001, 0.0001, 5.0), 1u); // its parent is too coarse
}

TEST(ThresholdLadder, HasTheTargetTheInitialThresholdAndSmallSteps)
{
  const ThresholdLadder ladder(1.3, 60.0);
  EXPECT_EQ(ladder.at(0), 1.3);
  EXPECT_EQ(ladder.at(ladder.initialRung()), 60.0);
  for (int rung = 0; rung <= ladder.initialRung() + 10; ++rung)
  {
    EXPECT_EQ(ladder.rungFor(ladder.at(rung)), rung);
    EXPECT_GT(ladder.at(rung + 1), ladder.at(rung));
    EXPECT_LT(ladder.at(rung + 1), ladder.at(rung) * 1.012);
  }
  EXPECT_EQ(ladder.rungFor(0.1), 0);
  EXPECT_EQ(ThresholdLadder(5.0, 1.0).initialRung(), 0);
}

} // namespace pointfront
