#include "pointfront/Front/ScreenError.h"
#include "pointfront/Views/SplatReach.h"

#include "StyledStore.h"

#include <gtest/gtest.h>

using namespace pointfront;
using namespace pointfront::test;

TEST(SplatReach, IsThatOfTheLargestSizeInMetres)
{
  const StoreDescription store = styledStore({ 2, 6 });
  StyleSheet sheet;
  sheet.standard.technique = Technique::Splats;
  EXPECT_EQ(largestSplat(*sheet.resolveAll(store)), 0.0) << "what closes the surface";
  sheet.standard.size = StyleSize{ SplatSize::Mode::Pixels, 40.0, "" };
  EXPECT_EQ(largestSplat(*sheet.resolveAll(store)), 0.0);
  sheet.classes[6].size = StyleSize{ SplatSize::Mode::World, 3.0, "" };
  EXPECT_EQ(largestSplat(*sheet.resolveAll(store)), 2.25) << "a silhouette's rim";
}

TEST(SplatReach, AViewHasWhatReachesIntoItFromAside)
{
  const View view = View::perspective(
    { 0.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 }, 1.5707963, 0.1, 200.0, 100, 100);
  const View wider = withSplatsFromAside(view, 2.0);
  const auto sees = [](const View& one, const glm::dvec3& place)
  { return sphereVisibility(one, place, 0.0) == Visibility::Inside; };
  EXPECT_FALSE(sees(view, { 12.0, 10.0, 0.0 }));
  EXPECT_TRUE(sees(wider, { 12.0, 10.0, 0.0 })) << "1.4 from the plane";
  EXPECT_FALSE(sees(wider, { 14.0, 10.0, 0.0 })) << "2.8 from it";
  EXPECT_FALSE(sees(wider, { 0.0, -1.0, 0.0 })) << "behind the eye";
  EXPECT_TRUE(withSplatsFromAside(view, 0.0) == view);
}
