#include "pointfront/Points/ColumnSource.h"
#include "pointfront/Table/PositionSurvey.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace
{
using namespace pointfront;

class ListedPoints final : public ColumnSource
{
public:
  explicit ListedPoints(std::vector<glm::dvec3> points)
    : points_(std::move(points))
  {
    description_.pointCount = points_.size();
  }

private:
  glm::dvec3 position(std::uint64_t point) const override { return points_[point]; }

  std::vector<glm::dvec3> points_;
};

PositionExtent surveyOf(std::vector<glm::dvec3> points)
{
  const Result<PositionExtent> extent = surveyPositions(ListedPoints(std::move(points)), {});
  EXPECT_TRUE(extent.ok());
  return extent ? *extent : PositionExtent{};
}

TEST(PositionSurvey, FindsBoundsAndTheDecimalStepOfAllChunks)
{
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 140000; ++i)
  {
    points.emplace_back(0.1 * i, 5.0, -i);
  }
  points.back().y = 5.0625;
  const PositionExtent extent = surveyOf(points);
  ASSERT_TRUE(extent.grid);
  EXPECT_EQ(extent.grid->scale, glm::dvec3(1e-4)); // the last point needs it
  EXPECT_EQ(extent.bounds.low, glm::dvec3(0.0, 5.0, -139999.0));
  EXPECT_EQ(extent.bounds.high, glm::dvec3(0.1 * 139999, 5.0625, 0.0));
  points.back().y = std::sqrt(26.0);
  EXPECT_FALSE(surveyOf(points).grid);
}

TEST(PositionSurvey, FloatsThatWereWidenedAreDecimalToTheirOwnRounding)
{
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 1000; ++i)
  {
    points.emplace_back(static_cast<float>(0.01 * i), 0.5, 0.0);
  }
  ASSERT_TRUE(surveyOf(points).grid);
  EXPECT_EQ(surveyOf(points).grid->scale.x, 0.01);
  points.emplace_back(0.01 + 1e-9, 0.5, 0.0); // one double: none is taken for a float
  EXPECT_FALSE(surveyOf(points).grid);
}

TEST(PositionSurvey, WhatIsNoPositionSaysNothing)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const PositionExtent some =
    surveyOf({ { 1, 2, 3 }, { nan, 1.0 / 3.0, 9 }, { 1.0 / 7.0, 2e15, 0 }, { 4, 5, 6 } });
  EXPECT_EQ(some.bounds.high, glm::dvec3(4, 5, 6));
  ASSERT_TRUE(some.grid);
  EXPECT_EQ(some.grid->scale.x, 1.0);
  for (const PositionExtent& none : { surveyOf({}), surveyOf({ { nan, nan, nan } }) })
  {
    EXPECT_TRUE(none.bounds.empty());
    EXPECT_FALSE(none.grid);
  }
}

TEST(PositionSurvey, AGridThatTheSourceStatesStays)
{
  SourceDescription stated;
  stated.grid.emplace().scale = glm::dvec3(0.25);
  const PositionExtent extent = surveyOf({ { 1, 2, 3 } });
  extent.describe(stated);
  EXPECT_EQ(stated.grid->scale.x, 0.25);
  EXPECT_EQ(stated.declaredBounds.low.x, 1.0);
  EXPECT_TRUE(stated.boundsLookedUp);
}

} // namespace
