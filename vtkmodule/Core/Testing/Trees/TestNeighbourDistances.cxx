// How far points lie from each other in space, and as they are seen from above.

#include "pointfront/Trees/NeighbourDistances.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

namespace pointfront
{
namespace
{
/// 20,000 points at place(u, v, w), each from 0 to 1, in metres.
NeighbourDistances distancesOf(const std::function<glm::dvec3(double, double, double)>& place,
  const glm::dvec3& scale = glm::dvec3(0.001))
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::vector<TreePosition> positions;
  for (std::size_t i = 0; i < 20000; ++i)
  {
    const double u = share(random);
    const double v = share(random);
    positions.push_back(TreePosition((place(u, v, share(random)) + 100.0) / scale));
  }
  return NeighbourDistances::of(positions, scale);
}

// Points at random on a plane are half as far from the nearest one as the side of the square that
// each of them has: 0.05 m for 20,000 on 200 square metres.

TEST(NeighbourDistances, AreTheSameOnAFloor)
{
  const NeighbourDistances floor = distancesOf(
    [](double u, double v, double w) { return glm::dvec3(20.0 * u, 10.0 * v, 0.004 * w); });
  EXPECT_NEAR(floor.inSpace, 0.05, 0.02);
  EXPECT_NEAR(floor.fromAbove, floor.inSpace, 0.05 * floor.inSpace);
}

TEST(NeighbourDistances, AreSmallerOfAWallFromAbove)
{
  for (const glm::dvec3& scale : { glm::dvec3(0.001), glm::dvec3(0.001, 0.001, 0.01) })
  {
    const NeighbourDistances wall = distancesOf([](double u, double v, double w)
      { return glm::dvec3(20.0 * u, 0.004 * w, 10.0 * v); },
      scale);
    EXPECT_NEAR(wall.inSpace, 0.05, 0.02);
    EXPECT_LT(wall.fromAbove, 0.1 * wall.inSpace);
  }
}

TEST(NeighbourDistances, AreSmallerOfAVolumeFromAbove)
{
  const NeighbourDistances block =
    distancesOf([](double u, double v, double w) { return 10.0 * glm::dvec3(u, v, w); });
  EXPECT_NEAR(block.inSpace, 0.55 * 10.0 / 27.1, 0.1) << "a 20,000th of its space has 0.37 m";
  EXPECT_LT(block.fromAbove, 0.3 * block.inSpace);
}

TEST(NeighbourDistances, AreNoneOfOnePlace)
{
  const glm::dvec3 scale(1.0);
  EXPECT_EQ(NeighbourDistances::of({}, scale).inSpace, 0.0);
  EXPECT_EQ(NeighbourDistances::of({ TreePosition(7), TreePosition(7) }, scale).inSpace, 0.0);
  const auto far = NeighbourDistances::of({ TreePosition(0), TreePosition(~0u) }, scale);
  EXPECT_NEAR(far.inSpace, 7.44e9, 1e7);
  const auto above = NeighbourDistances::of({ { 5, 5, 0 }, { 5, 5, 3 }, { 5, 5, 6 } }, scale);
  EXPECT_EQ(above.inSpace, 3.0);
  EXPECT_EQ(above.fromAbove, 0.0);
}

} // namespace
} // namespace pointfront
