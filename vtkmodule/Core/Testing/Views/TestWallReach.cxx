#include "pointfront/Front/ScreenError.h"
#include "pointfront/Views/WallReach.h"

#include "StyledStore.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

using namespace pointfront;
using namespace pointfront::test;

/// A point is in the view if any point below it, down to the wall's foot, was in it before.
TEST(WallReach, AViewHasAllWhoseWallsReachIntoIt)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-40.0, 40.0);
  int added = 0;
  for (int i = 0; i < 4000; ++i)
  {
    const glm::dvec3 eye(place(random), place(random), place(random));
    const glm::dvec3 focus(place(random), place(random), place(random));
    const View view = View::perspective(eye, focus, { 0.3, 0.2, 1.0 }, 0.7, 0.1, 200.0, 400, 300);
    const View wider = withWallsFromAbove(view, 12.0);
    const glm::dvec3 top(place(random), place(random), place(random));
    bool seen = false;
    for (double down = 0.0; down <= 12.0; down += 0.25)
    {
      seen =
        seen || sphereVisibility(view, top - glm::dvec3(0.0, 0.0, down), 0.0) == Visibility::Inside;
    }
    const bool chosen = sphereVisibility(wider, top, 0.0) == Visibility::Inside;
    ASSERT_TRUE(chosen || !seen) << i;
    added += seen && sphereVisibility(view, top, 0.0) == Visibility::Outside;
  }
  EXPECT_GT(added, 50);
  const View view = View::perspective(
    { 0.0, 0.0, 5.0 }, { 1.0, 2.0, 4.0 }, { 0.0, 0.0, 1.0 }, 0.7, 0.1, 200.0, 400, 300);
  EXPECT_TRUE(withWallsFromAbove(view, 0.0) == view);
}

TEST(WallReach, AWallIsNoTallerThanTheStoreSays)
{
  StoreDescription store = styledStore({ 2, 6 });
  addColumn(store, { "height_above_ground", ScalarType::Float32, 1 }, -0.5, 31.0);
  StyleSheet sheet;
  sheet.standard.technique = Technique::Splats;
  EXPECT_EQ(tallestWall(store, *sheet.resolveAll(store)), 0.0);
  sheet.classes[6].technique = Technique::Solid;
  EXPECT_EQ(tallestWall(store, *sheet.resolveAll(store)), 31.0);
  sheet.classes[6].visible = false;
  EXPECT_EQ(tallestWall(store, *sheet.resolveAll(store)), 0.0);
  sheet.classes[6].visible = true;
  const auto layers = *sheet.resolveAll(store);
  store.rangesAreSampled = true; // others may be taller
  EXPECT_EQ(tallestWall(store, layers), store.bounds.high.z - store.bounds.low.z);
  store.rangesAreSampled = false;
  store.ranges.back().components[0][1] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(tallestWall(store, layers), store.bounds.high.z - store.bounds.low.z);
}
