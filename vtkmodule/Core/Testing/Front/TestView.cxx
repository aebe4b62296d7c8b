#include "pointfront/Front/ScreenError.h"
#include "pointfront/Front/View.h"

#include <glm/gtc/matrix_transform.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace pointfront
{
namespace
{

constexpr double rightAngle = 1.57079632679489661923;

double signedDistance(const glm::dvec4& plane, const glm::dvec3& p)
{
  return glm::dot(glm::dvec3(plane), p) + plane.w;
}

bool seen(const View& view, const glm::dvec3& p)
{
  return sphereVisibility(view, p, 0.0) == Visibility::Inside;
}

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance)
{
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

/// Eye at (10, 20, 30), looking down -z, y up.
View symmetric(double nearDistance, double farDistance)
{
  const glm::dmat4 camera =
    glm::lookAt(glm::dvec3(10, 20, 30), glm::dvec3(10, 20, 0), glm::dvec3(0, 1, 0));
  return View::fromMatrix(
    glm::perspective(rightAngle, 2.0, nearDistance, farDistance) * camera, 800, 400);
}

} // namespace

TEST(View, PerspectiveMatrixGivesEyeDirectionAndScale)
{
  const View view = symmetric(0.5, 100.0);
  EXPECT_FALSE(view.parallel);
  expectNear(view.position, { 10, 20, 30 }, 1e-12);
  expectNear(view.direction, { 0, 0, -1 }, 1e-15);
  EXPECT_NEAR(view.nearDistance, 0.5, 1e-12);
  // 90 degrees on 400 pixels: at depth 1 two units fill the height.
  EXPECT_NEAR(view.pixelsPerUnit, 200.0, 1e-9);
}

TEST(View, PlanesAreUnitAndAtTheirPlaces)
{
  const View view = symmetric(0.5, 100.0);
  for (const glm::dvec4& plane : view.planes)
  {
    EXPECT_NEAR(glm::length(glm::dvec3(plane)), 1.0, 1e-14);
  }
  // At depth 10 the frustum reaches 10 up and down, 20 to the sides.
  EXPECT_TRUE(seen(view, { 10 + 19.9, 20, 20 }));
  EXPECT_FALSE(seen(view, { 10 + 20.1, 20, 20 }));
  EXPECT_TRUE(seen(view, { 10 - 19.9, 20, 20 }));
  EXPECT_FALSE(seen(view, { 10 - 20.1, 20, 20 }));
  EXPECT_TRUE(seen(view, { 10, 29.9, 20 }));
  EXPECT_FALSE(seen(view, { 10, 30.1, 20 }));
  EXPECT_TRUE(seen(view, { 10, 10.1, 20 }));
  EXPECT_FALSE(seen(view, { 10, 9.9, 20 }));
  EXPECT_FALSE(seen(view, { 10, 20, 29.6 })); // before the near plane
  EXPECT_TRUE(seen(view, { 10, 20, 29.4 }));
  EXPECT_TRUE(seen(view, { 10, 20, -69.9 }));
  EXPECT_FALSE(seen(view, { 10, 20, -70.1 })); // behind the far plane
  EXPECT_FALSE(seen(view, { 10, 20, 31 })); // behind the eye
  EXPECT_NEAR(signedDistance(view.planes[4], { 10, 20, 20 }), 9.5, 1e-12);
  EXPECT_NEAR(signedDistance(view.planes[5], { 10, 20, 20 }), 90.0, 1e-9);
}

TEST(View, OffAxisFrustumKeepsItsEye)
{
  // One eye of a stereo pair, or one tile of a wall: the line of sight is not in the middle.
  const glm::dmat4 camera =
    glm::lookAt(glm::dvec3(1, 2, 3), glm::dvec3(-4, 2, 3), glm::dvec3(0, 0, 1));
  const View view =
    View::fromMatrix(glm::frustum(0.5, 1.5, -0.25, 0.75, 1.0, 50.0) * camera, 640, 640);
  expectNear(view.position, { 1, 2, 3 }, 1e-12);
  expectNear(view.direction, { -1, 0, 0 }, 1e-14);
  EXPECT_NEAR(view.nearDistance, 1.0, 1e-12);
  EXPECT_NEAR(view.pixelsPerUnit, 640.0, 1e-9); // one unit at depth 1 fills the window
  EXPECT_FALSE(seen(view, { -9, 2, 3 })); // straight on, and yet beside the window
  EXPECT_TRUE(seen(view, { -9, 2 + 10, 3 + 2.5 }));
}

TEST(View, ParallelMatrixIsRecognised)
{
  const glm::dmat4 camera =
    glm::lookAt(glm::dvec3(0, 0, 100), glm::dvec3(0, 0, 0), glm::dvec3(0, 1, 0));
  const View view =
    View::fromMatrix(glm::ortho(-20.0, 20.0, -10.0, 10.0, 1.0, 200.0) * camera, 400, 200);
  EXPECT_TRUE(view.parallel);
  expectNear(view.direction, { 0, 0, -1 }, 1e-15);
  EXPECT_NEAR(view.pixelsPerUnit, 10.0, 1e-12);
  EXPECT_GT(view.nearDistance, 0.0);
  expectNear(view.position, { 0, 0, 99 + view.nearDistance }, 1e-9);
  EXPECT_TRUE(seen(view, { 19.9, 9.9, 0 }));
  EXPECT_FALSE(seen(view, { 20.1, 0, 0 }));
  EXPECT_FALSE(seen(view, { 0, 0, 99.1 }));
  EXPECT_FALSE(seen(view, { 0, 0, -100.1 }));
}

TEST(View, NearPlanesFromOneMillionthToOneBillion)
{
  const View close = symmetric(1e-6, 1e9);
  EXPECT_NEAR(close.nearDistance, 1e-6, 1e-12);
  expectNear(close.position, { 10, 20, 30 }, 1e-9);
  EXPECT_TRUE(seen(close, { 10, 20, 30 - 1e6 }));
  EXPECT_TRUE(seen(close, { 10, 20, 30 - 1e-5 }));
  EXPECT_FALSE(seen(close, { 10, 20, 30.1 }));

  const View far = symmetric(1e9, 3e9);
  EXPECT_NEAR(far.nearDistance, 1e9, 1.0);
  EXPECT_FALSE(seen(far, { 10, 20, 0 }));
  EXPECT_TRUE(seen(far, { 10, 20, -2e9 }));
  EXPECT_FALSE(seen(far, { 10, 20, -4e9 }));
}

TEST(View, AFarPlaneThatTheMatrixCannotResolveHidesNothing)
{
  const View view = symmetric(1e-9, 1e12);
  for (const glm::dvec4& plane : view.planes)
  {
    EXPECT_NEAR(glm::length(glm::dvec3(plane)), 1.0, 1e-9);
  }
  EXPECT_TRUE(seen(view, { 10, 20, -1e9 }));
}

TEST(View, NationalGridCoordinatesKeepMillimetres)
{
  const glm::dvec3 eye(3.4e7, 1.2e7, 842.25);
  const glm::dmat4 camera = glm::lookAt(eye, eye + glm::dvec3(1, 1, -0.5), glm::dvec3(0, 0, 1));
  for (const double angle : { 1e-4, 0.5, 2.8 })
  {
    const View view =
      View::fromMatrix(glm::perspective(angle, 1.5, 1e-2, 1e5) * camera, 1500, 1000);
    EXPECT_FALSE(view.parallel);
    expectNear(view.position, eye, 1e-3);
    EXPECT_NEAR(view.nearDistance, 1e-2, 1e-4);
    EXPECT_NEAR(view.pixelsPerUnit / (500.0 / std::tan(0.5 * angle)), 1.0, 1e-6);
    EXPECT_TRUE(seen(view, eye + 10.0 * view.direction));
    EXPECT_FALSE(seen(view, eye - 10.0 * view.direction));
  }
}

TEST(View, PerspectiveAgreesWithItsMatrix)
{
  const glm::dvec3 eye(100, -50, 20);
  const glm::dvec3 focus(0, 10, 5);
  const View direct = View::perspective(eye, focus, { 0, 0, 1 }, 0.7, 0.1, 1000.0, 300, 200);
  const View derived = View::fromMatrix(
    glm::perspective(0.7, 1.5, 0.1, 1000.0) * glm::lookAt(eye, focus, glm::dvec3(0, 0, 1)), 300,
    200);
  expectNear(direct.position, derived.position, 1e-9);
  expectNear(direct.direction, derived.direction, 1e-12);
  EXPECT_NEAR(direct.pixelsPerUnit, derived.pixelsPerUnit, 1e-9);
  EXPECT_NEAR(direct.nearDistance, derived.nearDistance, 1e-9);
  for (int i = 0; i < 6; ++i)
  {
    expectNear(direct.planes[i], derived.planes[i], 1e-9);
    EXPECT_NEAR(direct.planes[i].w, derived.planes[i].w, 1e-6);
  }
  EXPECT_EQ(direct, direct);
  EXPECT_NE(direct, derived);
}

TEST(View, LookingAlongUpStillHasAFrame)
{
  const View view =
    View::perspective({ 0, 0, 9 }, { 0, 0, 0 }, { 0, 0, 1 }, 1.0, 0.1, 99, 100, 100);
  EXPECT_TRUE(seen(view, { 0, 0, 0 }));
  EXPECT_FALSE(seen(view, { 0, 0, 10 }));
}

TEST(View, ScaledModelMatrixGivesModelUnits)
{
  // An actor in millimetres: 1000 model units to the metre.
  const glm::dmat4 clip = glm::perspective(rightAngle, 1.0, 0.5, 100.0) *
    glm::lookAt(glm::dvec3(0, 0, 3), glm::dvec3(0), glm::dvec3(0, 1, 0)) *
    glm::scale(glm::dmat4(1.0), glm::dvec3(1e-3));
  const View view = View::fromMatrix(clip, 200, 200);
  expectNear(view.position, { 0, 0, 3000 }, 1e-9);
  EXPECT_NEAR(view.nearDistance, 500.0, 1e-9);
  EXPECT_NEAR(view.pixelsPerUnit, 100.0, 1e-9); // a ratio of lengths: no unit in it
}

} // namespace pointfront
