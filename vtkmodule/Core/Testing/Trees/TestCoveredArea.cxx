// How much surface points lie on, and how much of it is seen from above.

#include "pointfront/Trees/CoveredArea.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace pointfront
{
namespace
{
const glm::dvec3 millimetres(0.001);

/// Points of a place(u, v, w), each from 0 to 1, in metres.
CoveredArea areaOf(const std::function<glm::dvec3(double, double, double)>& place,
  std::size_t count = 20000, const glm::dvec3& scale = millimetres)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::vector<TreePosition> positions;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double u = share(random);
    const double v = share(random);
    const glm::dvec3 steps = (place(u, v, share(random)) + 100.0) / scale;
    positions.push_back(TreePosition(steps));
  }
  return CoveredArea::of(positions, scale);
}

TEST(CoveredArea, AFloorIsSeenFromAbove)
{
  const CoveredArea area =
    areaOf([](double u, double v, double w) { return glm::dvec3(20.0 * u, 10.0 * v, 0.004 * w); });
  EXPECT_EQ(area.surface, area.fromAbove);
  EXPECT_NEAR(area.surface, 200.0, 50.0);
}

TEST(CoveredArea, AWallIsNot)
{
  for (const glm::dvec3& scale : { millimetres, glm::dvec3(0.001, 0.001, 0.01) })
  {
    const CoveredArea area =
      areaOf([](double u, double v, double w) { return glm::dvec3(20.0 * u, 0.004 * w, 10.0 * v); },
        20000, scale);
    EXPECT_NEAR(area.surface, 200.0, 50.0);
    EXPECT_LT(area.fromAbove, 0.2 * area.surface);
  }
}

TEST(CoveredArea, ASlopeHasTheAreaOfItsSurface)
{
  const CoveredArea area =
    areaOf([](double u, double v, double) { return glm::dvec3(10.0 * u, 10.0 * v, 20.0 * u); });
  EXPECT_GT(area.surface, 1.8 * area.fromAbove) << "it is 2.24 times as large";
  EXPECT_LT(area.surface, 3.5 * area.fromAbove);
}

TEST(CoveredArea, AVolumeHasMoreThanItsBase)
{
  const CoveredArea area =
    areaOf([](double u, double v, double w) { return 10.0 * glm::dvec3(u, v, w); });
  EXPECT_GT(area.surface, 3.0 * area.fromAbove);
}

TEST(CoveredArea, OnePlaceHasNone)
{
  EXPECT_EQ(CoveredArea::of({}, millimetres).surface, 0.0);
  EXPECT_EQ(areaOf([](double, double, double) { return glm::dvec3(1.0); }).surface, 0.0);
  const CoveredArea huge = CoveredArea::of({ TreePosition(0), TreePosition(~0u) }, glm::dvec3(1.0));
  EXPECT_GT(huge.surface, 0.0);
  EXPECT_TRUE(std::isfinite(huge.surface));
}

} // namespace
} // namespace pointfront
