#include "Frustum.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <array>
#include <cmath>

namespace pointfront
{

namespace
{
Bounds town()
{
  Bounds bounds;
  bounds.add(glm::dvec3(637000.0, 851000.0, 400.0));
  bounds.add(glm::dvec3(640000.0, 853000.0, 600.0));
  return bounds;
}

glm::dvec4 clipOf(const FrameCamera& camera, const glm::dvec3& point)
{
  return camera.storeToClip() * glm::dvec4(point, 1.0);
}

bool inSight(const View& view, const glm::dvec3& point)
{
  for (const glm::dvec4& plane : view.planes)
  {
    if (glm::dot(glm::dvec3(plane), point) + plane.w < 0.0)
    {
      return false;
    }
  }
  return true;
}
} // namespace

// Values of vtkRenderer::ResetCameraClippingRange() of VTK 9.1 for these cameras and boxes.
TEST(Frustum, ClippingRangeIsVTKs)
{
  Bounds cube;
  cube.add(glm::dvec3(-1.0));
  cube.add(glm::dvec3(1.0));
  Camera camera;
  camera.position = { 0.0, 0.0, 10.0 };
  camera.focalPoint = glm::dvec3(0.0);
  std::array<double, 2> range = clippingRange(camera, cube); // depths 9 to 11
  EXPECT_NEAR(range[0], 0.99 * 9.0 - 1.0, 1e-12);
  EXPECT_NEAR(range[1], 1.01 * 11.0 + 1.0, 1e-12);

  camera.position = glm::dvec3(0.0, 0.0, 0.5); // inside: nothing behind the eye
  range = clippingRange(camera, cube);
  EXPECT_NEAR(range[1], 1.01 * 1.5 + 0.75, 1e-12);
  EXPECT_NEAR(range[0], 0.001 * range[1], 1e-15);

  Bounds plane;
  plane.add(glm::dvec3(-1.0, -1.0, 0.0));
  plane.add(glm::dvec3(1.0, 1.0, 0.0));
  camera.position = { 0.0, 0.0, 10.0 };
  camera.parallelScale = 5.0; // a tenth of it: 9.75 to 10.25
  range = clippingRange(camera, plane);
  EXPECT_NEAR(range[0], 0.99 * 9.75 - 0.25, 1e-12);
  EXPECT_NEAR(range[1], 1.01 * 10.25 + 0.25, 1e-12);
}

TEST(Frustum, CutsNothingOfTheBox)
{
  for (const ViewDirection named : { ViewDirection::Iso, ViewDirection::Top, ViewDirection::Left })
  {
    const Camera camera = cameraFitting(town(), named, 1.5);
    const FrameCamera frame = frameCameraOf(camera, town(), 1200, 800);
    for (int corner = 0; corner < 8; ++corner)
    {
      const glm::dvec3 point((corner & 1 ? town().high : town().low).x,
        (corner & 2 ? town().high : town().low).y, (corner & 4 ? town().high : town().low).z);
      const glm::dvec4 clip = clipOf(frame, point);
      EXPECT_GT(clip.z, -clip.w);
      EXPECT_LT(clip.z, clip.w);
      EXPECT_TRUE(inSight(viewOf(frame), point));
    }
  }
}

TEST(Frustum, RowsSeeTheirPartOfThePicture)
{
  for (const bool parallel : { false, true })
  {
    Camera camera = cameraFitting(town(), ViewDirection::Iso, 1.5);
    if (parallel)
    {
      camera.parallelScale = 1500.0;
    }
    const FrameCamera frame = frameCameraOf(camera, town(), 1200, 800);
    const View whole = viewOf(frame);
    const View rows = viewOfRows(frame, 200, 300);
    EXPECT_EQ(rows.width, 1200);
    EXPECT_EQ(rows.height, 100);
    EXPECT_EQ(rows.parallel, parallel);
    EXPECT_NEAR(rows.pixelsPerUnit, whole.pixelsPerUnit, 1e-9 * whole.pixelsPerUnit);
    EXPECT_TRUE(parallel || glm::distance(rows.position, whole.position) < 1e-6);
    int inRows = 0;
    for (int i = 0; i < 400; ++i)
    {
      const glm::dvec3 share(i % 20 / 19.0, i / 20 / 19.0, 0.5);
      const glm::dvec3 point = town().low + share * town().size();
      const glm::dvec4 clip = clipOf(frame, point);
      const double y = 400.0 * (clip.y / clip.w + 1.0);
      if (std::abs(y - 200.0) < 0.01 || std::abs(y - 300.0) < 0.01)
      {
        continue;
      }
      const bool inside = inSight(whole, point) && y > 200.0 && y < 300.0;
      EXPECT_EQ(inSight(rows, point), inside) << "row " << y;
      inRows += inside ? 1 : 0;
    }
    EXPECT_GT(inRows, 10);
  }
}

} // namespace pointfront
