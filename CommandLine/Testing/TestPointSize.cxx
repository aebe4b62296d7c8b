#include "PointSize.h"

#include <gtest/gtest.h>

namespace pointfront
{

namespace
{
/// One leaf at the origin, with that spacing in world units.
HierarchyTable leafOf(float spacing)
{
  Node node;
  node.halfSize = glm::vec3(1.0f);
  node.radius = 1.8f;
  node.spacing = spacing;
  node.pointCount = 1000;
  node.pointsBelow = 1000;
  return HierarchyTable({ node }, { 0 }, Refinement::Add);
}

/// 1000 pixels high, straight down at the origin from a height at which a unit is 10 pixels.
View fromAbove()
{
  return View::perspective({ 0.0, 0.0, 51.8 }, glm::dvec3(0.0), { 0.0, 1.0, 0.0 },
    1.5707963267948966, 0.1, 1000.0, 1000, 1000);
}
} // namespace

TEST(PointSize, ClosesTheGapsBetweenTheLeavesPoints)
{
  EXPECT_EQ(closingPointSize(leafOf(0.4f), fromAbove(), 1.0), 6.0); // 4 px apart
  EXPECT_EQ(closingPointSize(leafOf(0.01f), fromAbove(), 1.0), 2.0); // the error rules
  EXPECT_EQ(closingPointSize(leafOf(100.0f), fromAbove(), 1.0), 16.0);
}

TEST(PointSize, FollowsTheErrorWhereNothingIsSeen)
{
  const HierarchyTable empty({}, {}, Refinement::Add);
  EXPECT_EQ(closingPointSize(empty, fromAbove(), 3.0), 5.0);
}

} // namespace pointfront
