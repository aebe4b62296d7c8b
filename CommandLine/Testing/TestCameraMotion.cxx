#include "CameraMotion.h"

#include "pointfront/Front/View.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <random>

namespace pointfront
{
namespace
{

const glm::ivec2 size(800, 600);

Camera overTerrain()
{
  Camera camera;
  camera.position = { 500100.0, 4649900.0, 900.0 };
  camera.focalPoint = { 501000.0, 4650300.0, 120.0 };
  camera.viewUp = { 0.0, 0.0, 1.0 };
  return camera;
}

/// Where a point is in the picture, pixels from the lower left corner.
glm::dvec2 pixelOf(const Camera& camera, const glm::dvec3& point)
{
  const glm::dvec3 forward = camera.direction();
  const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.viewUp));
  const glm::dvec3 up = glm::cross(right, forward);
  const glm::dvec3 to = point - camera.position;
  const double half = camera.parallelScale
    ? *camera.parallelScale
    : glm::dot(to, forward) * std::tan(0.5 * glm::radians(camera.viewAngleDegrees));
  const glm::dvec2 at(glm::dot(to, right), glm::dot(to, up));
  return at * (0.5 * size.y / half) + 0.5 * glm::dvec2(size);
}

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance)
{
  EXPECT_LT(glm::length(a - b), tolerance)
    << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

/// A hand that moves without a plan.
Camera anywhere(std::mt19937& random)
{
  std::uniform_real_distribution<double> angle(-1.0, 1.0);
  Camera camera = overTerrain();
  for (int i = 0; i < 5; ++i)
  {
    camera = orbited(camera, camera.focalPoint, 3.0 * angle(random), angle(random));
  }
  return random() % 2 == 0 ? camera : otherProjection(camera);
}

} // namespace

TEST(CameraMotion, AnOrbitKeepsThePivotInItsPlaceAndTheHorizonLevel)
{
  std::mt19937 random(7);
  for (int i = 0; i < 200; ++i)
  {
    const Camera camera = anywhere(random);
    const glm::dvec3 pivot = camera.focalPoint;
    const glm::dvec2 before = pixelOf(camera, pivot);
    const Camera moved = orbited(camera, pivot, 0.3, 0.1);
    EXPECT_NEAR(glm::length(moved.position - pivot), glm::length(camera.position - pivot), 1e-5);
    EXPECT_LT(glm::length(pixelOf(moved, pivot) - before), 1e-3);
    const glm::dvec3 right = glm::cross(moved.direction(), moved.viewUp);
    EXPECT_NEAR(right.z, 0.0, 1e-9) << i;
  }
}

TEST(CameraMotion, AnOrbitStopsStraightAboveAndBelow)
{
  Camera camera = overTerrain();
  camera = orbited(camera, camera.focalPoint, 0.0, -10.0);
  expectNear(camera.direction(), { 0.0, 0.0, -1.0 }, 1e-9);
  const glm::dvec3 north = camera.viewUp;
  camera = orbited(camera, camera.focalPoint, glm::half_pi<double>(), -1.0);
  expectNear(camera.direction(), { 0.0, 0.0, -1.0 }, 1e-9);
  EXPECT_NEAR(glm::dot(camera.viewUp, north), 0.0, 1e-9); // but it turns
  camera = orbited(camera, camera.focalPoint, 0.0, 10.0);
  expectNear(camera.direction(), { 0.0, 0.0, 1.0 }, 1e-9);
}

TEST(CameraMotion, TurningTheHeadLeavesTheEye)
{
  const Camera camera = overTerrain();
  const Camera moved = turned(camera, 0.2, 0.1);
  expectNear(moved.position, camera.position, 1e-9);
  EXPECT_NEAR(std::asin(moved.direction().z) - std::asin(camera.direction().z), 0.1, 1e-9);
}

TEST(CameraMotion, APanFollowsTheMouse)
{
  std::mt19937 random(8);
  for (int i = 0; i < 100; ++i)
  {
    const Camera camera = anywhere(random);
    const glm::dvec3 anchor = underPixel(camera, camera.focalPoint, { 200.0, 450.0 }, size);
    const Camera moved = panned(camera, anchor, { 30.0, -20.0 }, size.y);
    const glm::dvec2 by = pixelOf(moved, anchor) - pixelOf(camera, anchor);
    EXPECT_NEAR(by.x, 30.0, 1e-3);
    EXPECT_NEAR(by.y, -20.0, 1e-3);
  }
}

TEST(CameraMotion, AZoomLeavesThePointUnderTheMouse)
{
  std::mt19937 random(9);
  for (int i = 0; i < 100; ++i)
  {
    const Camera camera = anywhere(random);
    const glm::dvec3 anchor = underPixel(camera, camera.focalPoint, { 700.0, 50.0 }, size);
    const Camera moved = zoomed(camera, anchor, 0.5);
    EXPECT_LT(glm::length(pixelOf(moved, anchor) - pixelOf(camera, anchor)), 1e-3);
    // And what lies beside it is twice as far from it in the picture.
    const glm::dvec3 beside = underPixel(camera, anchor, { 650.0, 80.0 }, size);
    const double before = glm::length(pixelOf(camera, beside) - pixelOf(camera, anchor));
    EXPECT_NEAR(glm::length(pixelOf(moved, beside) - pixelOf(moved, anchor)), 2.0 * before, 1e-2);
  }
}

TEST(CameraMotion, APixelIsWhereItIsDrawn)
{
  std::mt19937 random(10);
  for (int i = 0; i < 100; ++i)
  {
    const Camera camera = anywhere(random);
    const glm::dvec3 point = underPixel(camera, camera.focalPoint, { 123.0, 456.0 }, size);
    EXPECT_LT(glm::length(pixelOf(camera, point) - glm::dvec2(123.5, 456.5)), 1e-3);
  }
}

TEST(CameraMotion, FlyingGoesAlongTheEyesAxes)
{
  const Camera camera = overTerrain();
  const Camera forward = flown(camera, { 0.0, 0.0, 12.0 });
  expectNear(forward.position, camera.position + 12.0 * camera.direction(), 1e-6);
  expectNear(forward.focalPoint - forward.position, camera.focalPoint - camera.position, 1e-6);
  const Camera aside = flown(camera, { 5.0, 0.0, 0.0 });
  EXPECT_NEAR(aside.position.z, camera.position.z, 1e-9);
}

TEST(CameraMotion, TheOtherProjectionShowsTheFocalPointAsLarge)
{
  const Camera camera = overTerrain();
  const Camera parallel = otherProjection(camera);
  ASSERT_TRUE(parallel.parallelScale);
  const glm::dvec3 beside = underPixel(camera, camera.focalPoint, { 500.0, 400.0 }, size);
  EXPECT_LT(glm::length(pixelOf(parallel, beside) - pixelOf(camera, beside)), 1e-3);
  const Camera back = otherProjection(parallel);
  expectNear(back.position, camera.position, 1e-5);
}

} // namespace pointfront
