#include "pointfront/Front/ScreenError.h"

#include <glm/gtc/matrix_transform.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pointfront
{
namespace
{

/// Eye in the origin, looking down -z, 90 degrees on 200 x 200 pixels: 100 pixels a unit at depth
/// 1.
View fromOrigin(double nearDistance = 0.1)
{
  return View::perspective(
    { 0, 0, 0 }, { 0, 0, -1 }, { 0, 1, 0 }, 0.5 * 3.14159265358979, nearDistance, 1e4, 200, 200);
}

Node sphere(const glm::dvec3& centre, float radius, float spacing)
{
  Node node;
  node.centre = centre;
  node.radius = radius;
  node.spacing = spacing;
  return node;
}

} // namespace

TEST(ScreenError, ProjectsTheSpacingAtTheNearestPointOfTheSphere)
{
  const View view = fromOrigin();
  EXPECT_NEAR(screenError(view, sphere({ 0, 0, -12 }, 2.0f, 0.5f)), 100.0 * 0.5 / 10.0, 1e-6);
  EXPECT_NEAR(distanceToNode(view, sphere({ 0, 0, -12 }, 2.0f, 0.5f)), 10.0, 1e-6);
}

TEST(ScreenError, InsideTheSphereItIsTheErrorAtTheNearPlane)
{
  const View view = fromOrigin(0.1);
  const Node coarse = sphere({ 0, 0, -1 }, 50.0f, 1.0f);
  const Node fine = sphere({ 0, 0, -1 }, 50.0f, 0.5f);
  EXPECT_EQ(distanceToNode(view, coarse), 0.0);
  EXPECT_NEAR(screenError(view, coarse), 100.0 * 1.0 / 0.1, 1e-3);
  EXPECT_GT(screenError(view, coarse), screenError(view, fine));
}

TEST(ScreenError, IsFiniteAndOrderedWhateverTheNumbers)
{
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float infinity = std::numeric_limits<float>::infinity();
  View view = fromOrigin(1e-6);
  view.nearDistance = std::numeric_limits<double>::min();
  for (const float spacing : { 0.0f, -1.0f, nan })
  {
    EXPECT_EQ(screenError(view, sphere({ 0, 0, -3 }, 1.0f, spacing)), 0.0);
  }
  EXPECT_TRUE(std::isfinite(screenError(view, sphere({ 0, 0, 0 }, 9.0f, 1.0f))));
  EXPECT_TRUE(std::isfinite(screenError(view, sphere({ 0, 0, -3 }, 1.0f, infinity))));
  EXPECT_TRUE(std::isfinite(screenError(view, sphere({ 0, 0, -3 }, nan, 1.0f))));
  EXPECT_GT(screenError(view, sphere({ 0, 0, -3 }, 1.0f, infinity)),
    screenError(view, sphere({ 0, 0, -3 }, 1.0f, 1.0f)));
}

TEST(ScreenError, ParallelViewsDoNotShrinkWithDepth)
{
  const View view = View::fromMatrix(glm::ortho(-10.0, 10.0, -10.0, 10.0, 1.0, 100.0), 200, 200);
  ASSERT_TRUE(view.parallel);
  EXPECT_NEAR(screenError(view, sphere({ 0, 0, -5 }, 1.0f, 0.5f)), 5.0, 1e-9);
  EXPECT_NEAR(screenError(view, sphere({ 5, 5, -90 }, 1.0f, 0.5f)), 5.0, 1e-9);
  // Near to far is along the line of sight, not round a point that parallel views do not have.
  EXPECT_LT(distanceToNode(view, sphere({ 9, 9, -5 }, 1.0f, 0.5f)),
    distanceToNode(view, sphere({ 0, 0, -6 }, 1.0f, 0.5f)));
}

TEST(ScreenError, ASphereIsOutsideOnlyWhenWhollyBeyondAPlane)
{
  const View view = fromOrigin();
  // The left plane at depth 10 is x = -10; the distance to it is along its normal.
  EXPECT_EQ(sphereVisibility(view, { -12, 0, -10 }, 1.5), Visibility::Inside);
  EXPECT_EQ(sphereVisibility(view, { -12, 0, -10 }, 1.4), Visibility::Outside);
  EXPECT_EQ(sphereVisibility(view, { 0, 0, 5 }, 4.0), Visibility::Outside);
  EXPECT_EQ(sphereVisibility(view, { 0, 0, 5 }, 6.0), Visibility::Inside); // eye inside
}

} // namespace pointfront
