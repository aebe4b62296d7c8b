#include "Camera.h"
#include "CameraPath.h"

#include "pointfront/Front/View.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <fstream>

namespace pointfront
{

namespace
{
/// A flat cloud at UTM coordinates.
Bounds terrain()
{
  return Bounds{ { 500000.0, 4649776.0, 100.0 }, { 502000.0, 4650776.0, 180.0 } };
}

std::string written(const std::string& name, const std::string& text)
{
  const std::string path = testing::TempDir() + name;
  std::ofstream(path) << text;
  return path;
}

bool inside(const View& view, const glm::dvec3& p)
{
  for (int plane = 0; plane < 4; ++plane) // left, right, bottom, top
  {
    const glm::dvec4& n = view.planes[static_cast<std::size_t>(plane)];
    if (n.x * p.x + n.y * p.y + n.z * p.z + n.w < 0.0)
    {
      return false;
    }
  }
  return true;
}

int cornersInside(const Camera& camera, double aspect, const Bounds& b)
{
  const View view = View::perspective(camera.position, camera.focalPoint, camera.viewUp,
    glm::radians(camera.viewAngleDegrees), 1.0, 1.0e6, static_cast<int>(aspect * 1000.0), 1000);
  int corners = 0;
  for (int i = 0; i < 8; ++i)
  {
    corners += inside(
      view, { i & 1 ? b.high.x : b.low.x, i & 2 ? b.high.y : b.low.y, i & 4 ? b.high.z : b.low.z });
  }
  return corners;
}
} // namespace

TEST(Camera, NamedViewsShowTheWholeBoxAndLittleMore)
{
  for (const char* name : { "iso", "top", "front", "back", "left", "right" })
  {
    for (const double aspect : { 0.5, 1.0, 16.0 / 9.0 })
    {
      const Camera camera = cameraFitting(terrain(), *namedView(name), aspect);
      EXPECT_EQ(cornersInside(camera, aspect, terrain()), 8) << name << ' ' << aspect;
      Camera nearer = camera;
      nearer.position = glm::mix(camera.position, camera.focalPoint, 0.1);
      EXPECT_LT(cornersInside(nearer, aspect, terrain()), 8) << name << ' ' << aspect;
    }
  }
  EXPECT_FALSE(namedView("below"));
}

TEST(Camera, TopLooksDownWithNorthUp)
{
  const Camera camera = cameraFitting(terrain(), ViewDirection::Top, 1.0);
  EXPECT_NEAR(glm::dot(camera.direction(), glm::dvec3(0.0, 0.0, -1.0)), 1.0, 1e-12);
  EXPECT_NEAR(glm::dot(camera.viewUp, glm::dvec3(0.0, 1.0, 0.0)), 1.0, 1e-12);
}

TEST(Camera, OnePointHasACamera)
{
  const Bounds point{ glm::dvec3(5.0), glm::dvec3(5.0) };
  const Camera camera = cameraFitting(point, ViewDirection::Iso, 1.0);
  EXPECT_GT(glm::length(camera.focalPoint - camera.position), 0.0);
}

TEST(Camera, FileKeepsDoubles)
{
  const auto camera = readCameraFile(written("camera.json",
    R"({"position":[500000.123456789,4649776.5,900],"focal_point":[500001,4649776,100],
        "view_up":[0,1,0],"view_angle":42.5})"));
  ASSERT_TRUE(camera) << camera.error().what;
  EXPECT_EQ(camera.value().position.x, 500000.123456789);
  EXPECT_EQ(camera.value().viewAngleDegrees, 42.5);
  EXPECT_FALSE(camera.value().parallelScale);
}

TEST(Camera, ParallelScaleMakesAParallelCamera)
{
  const auto camera = readCameraFile(written("parallel.json",
    R"({"position":[0,0,9],"focal_point":[0,0,0],"view_up":[0,1,0],"parallel_scale":250})"));
  ASSERT_TRUE(camera) << camera.error().what;
  EXPECT_EQ(camera.value().parallelScale, 250.0);
}

TEST(Camera, WrongFilesAreErrorsThatNameTheKey)
{
  const std::pair<const char*, const char*> cases[] = {
    { R"({"focal_point":[0,0,0],"view_up":[0,1,0]})", "position" },
    { R"({"position":[0,0],"focal_point":[0,0,0],"view_up":[0,1,0]})", "position" },
    { R"({"position":[0,0,1],"focal_point":[0,0,"a"],"view_up":[0,1,0]})", "focal_point" },
    { R"({"position":[0,0,1],"focal_point":[0,0,0],"view_up":[0,0,1]})", "view_up" },
    { R"({"position":[0,0,1],"focal_point":[0,0,0],"view_up":[0,1,0],"view_angle":180})",
      "view_angle" },
    { R"({"position":[0,0,1],"focal_point":[0,0,0],"view_up":[0,1,0],"parallel_scale":0})",
      "parallel_scale" },
    { R"({"position":[1e999,0,1],"focal_point":[0,0,0],"view_up":[0,1,0]})", "too large" },
    { R"({"position":[1e300,0,1],"focal_point":[0,0,0],"view_up":[0,1,0]})", "position" },
    { R"({"position":[0,0,1],"focal_point":[0,0,0],"view_up":[0,1,0],"parallel_scale":1e99})",
      "parallel_scale" },
    { "[1,2", "wrong.json: not JSON: line 1, column 5: " },
    { "{\"position\":[0,0,1],\n\"focal_pont\":[0,0,0],\n\"view_up\":[0,1,0]}",
      "wrong.json: line 2: there is no key 'focal_pont'; did you mean 'focal_point'?" },
    { "{\"position\":[0,0,1],\n\"focal_point\":[0,0,0],\n\"view_up\":[0,1]}",
      "wrong.json: line 3: \"view_up\"" },
    { "[]", "object" }
  };
  for (const auto& [text, expected] : cases)
  {
    const auto camera = readCameraFile(written("wrong.json", text));
    ASSERT_FALSE(camera) << text;
    EXPECT_NE(camera.error().what.find(expected), std::string::npos) << camera.error().what;
  }
  EXPECT_FALSE(readCameraFile(testing::TempDir() + "no such camera.json"));
}

TEST(CameraPath, OrbitKeepsItsDistance)
{
  const CameraPath path = orbitPath({ terrain(), 120.0, 1.5 }, 12);
  ASSERT_EQ(path.size(), 12u);
  for (const Camera& camera : path)
  {
    EXPECT_NEAR(glm::length(camera.position - terrain().centre()),
      glm::length(path[0].position - terrain().centre()), 1e-6);
  }
  EXPECT_GT(glm::length(path[6].position - path[0].position), 1000.0);
}

TEST(CameraPath, ZoomEndsNear)
{
  const CameraPath path = zoomPath({ terrain(), 120.0, 1.5 }, 5);
  const auto distance = [](const Camera& c) { return glm::length(c.position - c.focalPoint); };
  EXPECT_NEAR(distance(path[4]) / distance(path[0]), 0.02, 1e-9);
  EXPECT_NEAR(distance(path[1]) / distance(path[0]), distance(path[2]) / distance(path[1]), 1e-9);
}

TEST(CameraPath, FlightCrossesTheLongerSide)
{
  const CameraPath path = flightPath({ terrain(), 120.0, 1.5 }, 3);
  EXPECT_NEAR(path[0].position.x, 500000.0, 1e-6);
  EXPECT_NEAR(path[2].position.x, 502000.0, 1e-6);
  EXPECT_NEAR(path[1].position.z, 120.0 + 100.0, 1e-6);
}

TEST(CameraPath, FileInterpolatesBetweenItsCameras)
{
  const std::string file = written("path.json",
    R"([{"position":[0,0,10],"focal_point":[0,0,0],"view_up":[0,1,0],"frames":4},
        {"position":[8,0,10],"focal_point":[8,0,0],"view_up":[0,1,0]}])");
  const auto path = readPathFile(file, 0);
  ASSERT_TRUE(path) << path.error().what;
  ASSERT_EQ(path.value().size(), 5u);
  EXPECT_DOUBLE_EQ(path.value()[1].position.x, 2.0);
  EXPECT_DOUBLE_EQ(path.value()[4].position.x, 8.0);
  const auto longer = readPathFile(file, 9);
  ASSERT_TRUE(longer);
  ASSERT_EQ(longer.value().size(), 9u);
  EXPECT_DOUBLE_EQ(longer.value()[1].position.x, 1.0);
  EXPECT_FALSE(readPathFile(written("wrongpath.json", "{}"), 0));
}

} // namespace pointfront
