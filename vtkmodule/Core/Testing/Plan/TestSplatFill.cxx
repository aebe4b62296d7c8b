// How large splats of thinned points are, and how much they fill.

#include "PlannerScene.h"

#include <gtest/gtest.h>

using namespace pointfront;

/// The threshold is that of the nearest node: 6000 points that share a million pixels are not a
/// thousand pixels apart.
TEST(SplatFill, AThresholdAroundTheEyeMakesNoPointLarge)
{
  test::PlannerScene scene;
  scene.frameRequest.view =
    View::perspective({ 0, 0, 0.5 }, { 0, 0, 0 }, { 0, 1, 0 }, 0.9, 0.001, 1e5, 1000, 1000);
  scene.request.camera.width = 1000;
  scene.request.camera.height = 1000;
  scene.request.styles.assign(3, test::styleOfSize(SplatSize::Mode::Spacing));
  const FramePlan coarse = scene.plan(1000.0);
  ASSERT_EQ(scene.front.last().thresholdPx, 1000.0);
  ASSERT_EQ(coarse.pointCount(), 6000u);
  EXPECT_LE(coarse.spacingPx, 60.0f);
  EXPECT_GE(coarse.spacingPx, 13.0f) << "evenly spread points are as far apart";
  EXPECT_LT(coarse.fillPx(), 60.0 * 1e6);
}

TEST(SplatFill, ASmallThresholdIsTakenAtItsWord)
{
  test::PlannerScene scene;
  scene.request.camera.width = 10; // as if thousands of points lay behind each other
  scene.request.camera.height = 10;
  scene.request.styles.assign(3, test::styleOfSize(SplatSize::Mode::Spacing));
  const FramePlan plan = scene.plan(4.0);
  EXPECT_EQ(plan.spacingPx, 4.0f);
  const double all = 3.14159265 * 16.0 * static_cast<double>(plan.pointCount());
  EXPECT_NEAR(plan.fillPx(), all, 1e-4 * all);
  scene.request.styles.assign(3, test::styleOfSize(SplatSize::Mode::Pixels));
  EXPECT_EQ(scene.plan(4.0).fillPx(), 0.0);
}
