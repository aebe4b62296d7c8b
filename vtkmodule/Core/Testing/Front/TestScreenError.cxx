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

/// A model whose matrix stretches it is as large on screen as one that was stretched before: for
/// small spheres, the farthest of their points from the middle show it.
TEST(ScreenError, OfAStretchedModelIsThatOfItsStretchedPoints)
{
  const glm::dvec3 eye(30.0, -50.0, 40.0);
  const glm::dmat4 camera = glm::lookAt(eye, glm::dvec3(0.0), glm::dvec3(0, 0, 1));
  const glm::dmat4 lens[] = { glm::perspective(0.5, 1.0, 0.5, 500.0),
    glm::ortho(-20.0, 20.0, -20.0, 20.0, 1.0, 500.0) };
  const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), 0.7, glm::dvec3(1, 2, 3));
  for (const glm::dvec3& scale : { glm::dvec3(1, 1, 10), glm::dvec3(20, 1, 1),
         glm::dvec3(1, 0.05, 1), glm::dvec3(3, 3, 3), glm::dvec3(-1, 1, 4) })
  {
    const glm::dmat4 model =
      glm::scale(glm::translate(glm::dmat4(1.0), { 2, 3, 1 }), scale) * turned;
    for (const glm::dmat4& projection : lens)
    {
      const glm::dmat4 toClip = projection * camera;
      const View view = View::ofModel(model, toClip, 400, 400);
      const glm::dvec3 centre(0.2, -0.3, 0.1);
      constexpr double spacing = 1e-4;
      const auto pixelOf = [&](const glm::dvec3& p)
      {
        const glm::dvec4 clip = toClip * model * glm::dvec4(p, 1.0);
        return glm::dvec2(clip) / clip.w * 200.0;
      };
      double most = 0.0;
      for (int i = 0; i < 20000; ++i)
      {
        const double z = 2.0 * (i + 0.5) / 20000 - 1.0;
        const double angle = 2.399963 * i;
        const double around = std::sqrt(1.0 - z * z);
        const glm::dvec3 way(around * std::cos(angle), around * std::sin(angle), z);
        most = std::max(most, glm::length(pixelOf(centre + spacing * way) - pixelOf(centre)));
      }
      // The place is off the middle of the picture, where a length shows larger by a few percent.
      const double error = screenError(view, sphere(centre, 1e-6f, float(spacing)));
      EXPECT_NEAR(error / most, 1.0, 0.03) << scale.x << " " << scale.y << " " << scale.z;
    }
  }
}

TEST(ScreenError, OfAStretchedSphereIsThatOfItsNearestPoint)
{
  const glm::dmat4 projection = glm::perspective(0.5, 1.0, 0.5, 500.0);
  const glm::dmat4 camera =
    glm::lookAt(glm::dvec3(100.0, 0, 0), glm::dvec3(0.0), glm::dvec3(0, 0, 1));
  const glm::dmat4 model = glm::scale(glm::dmat4(1.0), glm::dvec3(5.0, 1.0, 2.0));
  const View view = View::ofModel(model, projection * camera, 400, 400);
  // Ten times five towards the eye, and twice as large across.
  EXPECT_NEAR(distanceToNode(view, sphere({ 0, 0, 0 }, 10.0f, 1.0f)), 50.0 / 2.0, 1e-9);
  EXPECT_EQ(distanceToNode(view, sphere({ 0, 0, 0 }, 20.0f, 1.0f)), 0.0);
  EXPECT_FALSE(
    View::ofModel(glm::scale(glm::dmat4(1.0), glm::dvec3(-2.0)), projection * camera, 9, 9)
      .stretch);
}

} // namespace pointfront
