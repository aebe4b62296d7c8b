// Silhouettes and solids, against rays that are cast in double precision.

#include "PlanOfPoints.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

constexpr int wallWidth = 120;
constexpr int wallHeight = 90;
constexpr std::uint32_t black = 0xff000000u;
constexpr std::uint32_t white = 0xffffffffu;

struct Ray
{
  glm::dvec3 from;
  glm::dvec3 along; ///< unit vector along the line of sight
};

/// View space.
Ray rayThrough(const FrameCamera& camera, int x, int y)
{
  const glm::dmat4& clip = camera.viewToClip;
  const double right = ((x + 0.5) / camera.width * 2.0 - 1.0) / clip[0][0];
  const double up = ((y + 0.5) / camera.height * 2.0 - 1.0) / clip[1][1];
  return camera.parallel ? Ray{ { right, up, 0.0 }, { 0.0, 0.0, -1.0 } }
                         : Ray{ glm::dvec3(0.0), { right, up, -1.0 } };
}

glm::dvec3 inView(const FrameCamera& camera, const glm::dvec3& position)
{
  return glm::dvec3(camera.storeToView * glm::dvec4(position, 1.0));
}

std::shared_ptr<ResolvedStyle> styleOf(Technique technique, double size, bool normals)
{
  auto style = std::make_shared<ResolvedStyle>();
  style->technique = technique;
  style->accuracy = SplatAccuracy::Exact;
  style->colouring.kind = PointColouring::Kind::Direct;
  style->size = { SplatSize::Mode::World, size, 0 };
  style->normalColumn = normals ? std::optional<std::uint32_t>(1) : std::nullopt;
  if (technique == Technique::Solid)
  {
    style->heightColumn = 4;
  }
  return style;
}

/// A scene for a technique, in the view from aside, perspective or parallel.
PlanOfPoints sceneOf(Technique technique, double size, bool normals, bool parallel = false)
{
  PlanOfPoints scene;
  scene.style = styleOf(technique, size, normals);
  scene.plan.batches[0].style = scene.style;
  const glm::dvec3 eye(0.7, -2.9, 1.6), up(0.1, 0.0, 1.0);
  scene.plan.camera = parallel
    ? FrameCamera::parallelView(eye, { 0, 0, 0 }, up, 0.9, 0.1, 30.0, wallWidth, wallHeight)
    : FrameCamera::perspective(eye, { 0, 0, 0 }, up, 0.6, 0.1, 30.0, wallWidth, wallHeight);
  return scene;
}

std::vector<TestPoint> gridOfPoints(int side, double extent, double z)
{
  std::vector<TestPoint> points;
  for (int i = 0; i < side * side; ++i)
  {
    TestPoint point;
    point.position = { extent * ((i % side + 0.5) / side - 0.5),
      extent * ((i / side + 0.5) / side - 0.5), z };
    point.normal = { 0.0f, 0.0f, 1.0f };
    points.push_back(point);
  }
  return points;
}

int countOf(const SoftwareTarget& target, std::uint32_t colour)
{
  return static_cast<int>(std::count(target.rgba.begin(), target.rgba.end(), colour));
}

/// Where a ray meets the wall below a point: down from the point, aside, and the depth.
struct WallHit
{
  double down;
  double aside;
  double depth;
};
WallHit hitOf(const FrameCamera& camera, const Ray& ray, const glm::dvec3& top)
{
  const glm::dvec3 c = inView(camera, top);
  const glm::dvec3 up = glm::normalize(glm::dvec3(camera.storeToView[2]));
  const glm::dvec3 away = camera.parallel ? glm::dvec3(0.0, 0.0, -1.0) : c;
  const glm::dvec3 normal = glm::normalize(away - glm::dot(away, up) * up);
  const double t = glm::dot(normal, c - ray.from) / glm::dot(normal, ray.along);
  const glm::dvec3 hit = ray.from + t * ray.along;
  return { -glm::dot(hit - c, up), glm::dot(hit - c, glm::cross(up, normal)), -hit.z };
}

/// The nearest of the walls, 0.06 wide, that a ray meets below points of solids.
struct WallSeen
{
  double depth = std::numeric_limits<double>::infinity();
  std::size_t point = 0;
  bool doubtful = false; ///< within the disc on top of one, or on an edge of a wall
};
WallSeen wallSeen(const PlanOfPoints& scene, const std::vector<TestPoint>& points, const Ray& ray)
{
  const FrameCamera& camera = scene.plan.camera;
  const QuantisationGrid& grid = scene.plan.grid;
  const glm::dvec3 n = glm::dmat3(camera.storeToView) * glm::dvec3(0.0, 0.0, 1.0);
  WallSeen seen;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const glm::dvec3 top = grid.toWorld(grid.toGrid(points[i].position));
    const WallHit hit = hitOf(camera, ray, top);
    const double h = points[i].height > 0.0f ? points[i].height : 0.0;
    const glm::dvec3 c = inView(camera, top);
    const double t = glm::dot(n, c - ray.from) / glm::dot(n, ray.along);
    const bool onDisc = glm::length(ray.from + t * ray.along - c) < 0.04;
    const bool onEdge = std::abs(std::abs(hit.aside) - 0.03) < 1e-3 || std::abs(hit.down) < 1e-3 ||
      std::abs(hit.down - h) < 1e-3;
    const bool inside = std::abs(hit.aside) <= 0.03 && hit.down >= 0.0 && hit.down <= h;
    const bool near = std::abs(hit.aside) <= 0.032 && hit.down >= -0.001 && hit.down <= h + 0.001;
    seen.doubtful = seen.doubtful || onDisc || (near && onEdge);
    if (inside && hit.depth < seen.depth)
    {
      seen.depth = hit.depth;
      seen.point = i;
    }
  }
  return seen;
}

} // namespace

TEST(Silhouettes, ADiscHasARimHalfAsWideAsItsRadius)
{
  for (const bool parallel : { false, true })
  {
    for (const bool normals : { false, true })
    {
      PlanOfPoints scene = sceneOf(Technique::Silhouettes, 0.4, normals, parallel);
      TestPoint point;
      point.normal = glm::normalize(glm::vec3(0.3f, -1.0f, 0.6f));
      scene.add({ point });
      const SoftwareTarget target = scene.draw();
      const FrameCamera& camera = scene.plan.camera;
      const glm::dvec3 c = inView(camera, point.position);
      const glm::dvec3 n = normals
        ? glm::dvec3(glm::dmat3(camera.storeToView) * glm::dvec3(point.normal))
        : glm::dvec3(0.0, 0.0, 1.0);
      int inner = 0, rim = 0;
      for (int y = 0; y < wallHeight; ++y)
      {
        for (int x = 0; x < wallWidth; ++x)
        {
          const Ray ray = rayThrough(camera, x, y);
          const double t = glm::dot(n, c - ray.from) / glm::dot(n, ray.along);
          const double reach = glm::length(ray.from + t * ray.along - c);
          if (std::abs(reach - 0.2) < 3e-3 || std::abs(reach - 0.3) < 3e-3)
          {
            continue; // on an edge
          }
          const auto pixel = static_cast<std::size_t>(y * wallWidth + x);
          const std::uint32_t expected = reach < 0.2 ? white : reach < 0.3 ? black : 0u;
          ASSERT_EQ(target.rgba[pixel], expected) << parallel << normals << " " << x << " " << y;
          inner += expected == white;
          rim += expected == black;
          if (expected != 0u)
          {
            ASSERT_NEAR(target.depth[pixel], t, 1e-4) << "depths are where the disc is";
          }
        }
      }
      EXPECT_GT(inner, 100);
      EXPECT_GT(rim, inner);
    }
  }
}

TEST(Silhouettes, AClosedSurfaceHasAnOutlineWhereItEndsAndNoneWithin)
{
  for (const bool normals : { false, true })
  {
    for (const float share : { 1.0f, 0.02f }) // near, and far away: splats of less than a pixel
    {
      PlanOfPoints scene = sceneOf(Technique::Silhouettes, 0.075, normals);
      scene.add(gridOfPoints(40, 1.6, 0.0));
      const glm::dvec3 eye = glm::dvec3(0.7, -2.9, 1.6) / double(share);
      scene.look(eye, { 0, 0, 0 }, 0.6 * share, wallWidth, wallHeight);
      const SoftwareTarget target = scene.draw();
      EXPECT_GT(countOf(target, white), 2000);
      EXPECT_GT(countOf(target, black), 100);
      const FrameCamera& camera = scene.plan.camera;
      const glm::dvec3 n = glm::dmat3(camera.storeToView) * glm::dvec3(0.0, 0.0, 1.0);
      const glm::dmat4 toStore = glm::inverse(camera.storeToView);
      for (int y = 0; y < wallHeight; ++y)
      {
        for (int x = 0; x < wallWidth; ++x)
        {
          const Ray ray = rayThrough(camera, x, y);
          const double t = glm::dot(n, inView(camera, glm::dvec3(0.0))) / glm::dot(n, ray.along);
          const glm::dvec3 at(toStore * glm::dvec4(t * ray.along, 1.0));
          if (t > 0.0 && std::max(std::abs(at.x), std::abs(at.y)) < 0.76)
          {
            ASSERT_EQ(target.rgba[static_cast<std::size_t>(y * wallWidth + x)], white)
              << normals << share << " " << x << " " << y;
          }
        }
      }
    }
  }
}

/// A sheet before another one: an outline where they are further apart than two radii of the whole
/// disc, none where they are nearer.
TEST(Silhouettes, OutlineWhatIsDeeperThanTheirOffset)
{
  for (const double gap : { 0.01, 0.6 })
  {
    PlanOfPoints scene;
    scene.style = styleOf(Technique::Silhouettes, 0.05, true);
    scene.plan.batches[0].style = scene.style;
    scene.look({ 0.0, 0.0, 4.0 }, { 0.0, 0.001, 0.0 }, 0.3, 100, 100);
    scene.add(gridOfPoints(64, 1.6, 0.0));
    std::vector<TestPoint> near = gridOfPoints(20, 0.5, gap);
    scene.add(near);
    const SoftwareTarget target = scene.draw();
    EXPECT_EQ(countOf(target, black) > 50, gap > 0.1) << gap;
    EXPECT_EQ(countOf(target, black) + countOf(target, white), 100 * 100) << gap;
  }
}

TEST(Silhouettes, ARimIsOfItsPointAndOfTheStylesColour)
{
  PlanOfPoints scene = sceneOf(Technique::Silhouettes, 0.4, true);
  scene.style->rim = { 200, 100, 50, 255 };
  scene.add({ TestPoint() });
  const SoftwareTarget target = scene.draw(true);
  int rims = 0;
  for (std::size_t pixel = 0; pixel < target.rgba.size(); ++pixel)
  {
    rims += target.rgba[pixel] == 0xff3264c8u;
    EXPECT_EQ(target.rgba[pixel] != 0u, target.points[pixel].store == 0);
  }
  EXPECT_GT(rims, 100);
}

TEST(Walls, AreWhatRaysMeet)
{
  std::vector<TestPoint> points = gridOfPoints(5, 1.2, 0.0);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i].position.z = 0.1 * double(i % 4);
    points[i].height = i % 6 == 0 ? 0.0f : 0.05f * static_cast<float>(i % 9);
    points[i].rgb = { static_cast<std::uint8_t>(9 * i), 7, static_cast<std::uint8_t>(i) };
  }
  points[3].height = std::numeric_limits<float>::quiet_NaN();
  points[8].height = -4.0f;
  for (const bool parallel : { false, true })
  {
    PlanOfPoints scene = sceneOf(Technique::Solid, 0.06, true, parallel);
    scene.add(points);
    const FrameCamera& camera = scene.plan.camera;
    const SoftwareTarget target = scene.draw(true);
    int walls = 0;
    for (int y = 0; y < wallHeight; ++y)
    {
      for (int x = 0; x < wallWidth; ++x)
      {
        const WallSeen seen = wallSeen(scene, points, rayThrough(camera, x, y));
        const auto pixel = static_cast<std::size_t>(y * wallWidth + x);
        if (seen.doubtful)
        {
          continue;
        }
        ASSERT_EQ(std::isinf(seen.depth), target.rgba[pixel] == 0u) << parallel << x << " " << y;
        if (!std::isinf(seen.depth))
        {
          ++walls;
          ASSERT_NEAR(target.depth[pixel], seen.depth, 1e-4) << parallel << x << " " << y;
          ASSERT_EQ(target.points[pixel].index, seen.point) << parallel << x << " " << y;
          ASSERT_EQ(target.rgba[pixel] & 255u, points[seen.point].rgb[0]) << "as its point";
        }
      }
    }
    EXPECT_GT(walls, 200);
  }
}

TEST(Walls, FadeFromTheirUpperToTheirLowerColour)
{
  PlanOfPoints scene = sceneOf(Technique::Solid, 0.5, true);
  scene.style->wall = { Rgba8{ 255, 128, 0, 255 }, Rgba8{ 55, 128, 200, 255 } };
  TestPoint point;
  point.position = { 0.0, 0.0, 0.5 };
  point.normal = { 0.0f, 0.0f, 1.0f };
  point.height = 1.0f;
  scene.add({ point });
  const SoftwareTarget target = scene.draw();
  const FrameCamera& camera = scene.plan.camera;
  int wall = 0;
  for (int y = 0; y < wallHeight; ++y)
  {
    for (int x = 0; x < wallWidth; ++x)
    {
      const WallHit hit = hitOf(camera, rayThrough(camera, x, y), point.position);
      if (hit.down > 0.3 && hit.down < 0.99 && std::abs(hit.aside) < 0.24)
      {
        ++wall;
        const std::uint32_t rgba = target.rgba[static_cast<std::size_t>(y * wallWidth + x)];
        ASSERT_NEAR(double(rgba & 255u), 255.0 - 200.0 * hit.down, 1.0);
        ASSERT_EQ(rgba >> 8 & 255u, 128u);
        ASSERT_NEAR(double(rgba >> 16 & 255u), 200.0 * hit.down, 1.0);
      }
    }
  }
  EXPECT_GT(wall, 300);
}

/// Heights are the store's: an actor that is scaled along z has as much taller walls.
TEST(Walls, AreScaledWithTheirCloud)
{
  std::vector<int> pixels;
  for (const double scale : { 1.0, 2.0 })
  {
    PlanOfPoints scene = sceneOf(Technique::Solid, 0.1, true, true);
    scene.style->wall = { Rgba8{ 0, 0, 0, 255 }, Rgba8{ 0, 0, 0, 255 } };
    scene.plan.camera =
      FrameCamera::parallelView({ 0, -3, 0 }, { 0, 0, 0 }, { 0, 0, 1 }, 1.0, 0.1, 10.0, 100, 100);
    scene.plan.camera.storeToView[2] *= scale;
    TestPoint point;
    point.height = 0.4f;
    point.normal = { 0.0f, -1.0f, 0.0f };
    scene.add({ point });
    pixels.push_back(countOf(scene.draw(), black));
  }
  EXPECT_GT(pixels[0], 60);
  EXPECT_GT(pixels[1], 1.9 * pixels[0]);
}

TEST(Walls, CloseTheFacadeBelowARoof)
{
  PlanOfPoints scene;
  scene.style = styleOf(Technique::Solid, 0.0, true);
  scene.style->size = { SplatSize::Mode::Spacing, 1.0, 0 };
  scene.style->wall = { Rgba8{ 0, 0, 0, 255 }, Rgba8{ 0, 0, 0, 255 } };
  scene.plan.batches[0].style = scene.style;
  std::vector<TestPoint> roof = gridOfPoints(20, 2.0, 1.0);
  for (TestPoint& point : roof)
  {
    point.height = 1.0f;
  }
  scene.add(roof, 0.08); // 0.1 apart
  for (const glm::dvec3 eye : { glm::dvec3(5, -4, 3), { 5, -4, 0.2 }, { -6, 0.5, 0.5 } })
  {
    scene.look(eye, { 0, 0, 0.5 }, 0.6, 200, 150);
    const SoftwareTarget target = scene.draw();
    const FrameCamera& camera = scene.plan.camera;
    int below = 0;
    for (int y = 0; y < 150; ++y)
    {
      for (int x = 0; x < 200; ++x)
      {
        // Rays that go through the box of the building.
        const glm::dmat4 toStore = glm::inverse(camera.storeToView);
        const glm::dvec3 along(toStore * glm::dvec4(rayThrough(camera, x, y).along, 0.0));
        double begin = 0.0, end = 1e9;
        const glm::dvec3 low(-0.93, -0.93, 0.03), high(0.93, 0.93, 0.97);
        for (int axis = 0; axis < 3; ++axis)
        {
          const double a = (low[axis] - eye[axis]) / along[axis];
          const double b = (high[axis] - eye[axis]) / along[axis];
          begin = std::max(begin, std::min(a, b));
          end = std::min(end, std::max(a, b));
        }
        if (begin < end)
        {
          ++below;
          ASSERT_NE(target.rgba[static_cast<std::size_t>(y * 200 + x)], 0u) << x << " " << y;
        }
      }
    }
    EXPECT_GT(below, 2000);
    EXPECT_GT(countOf(target, black), 1000);
    EXPECT_GT(countOf(target, white), eye.z > 1.0 ? 500 : -1) << "walls are no roof";
  }
}

TEST(Walls, ARoofIsNotCoveredByThem)
{
  for (const bool normals : { false, true })
  {
    PlanOfPoints scene;
    scene.style = styleOf(Technique::Solid, 0.0, normals);
    scene.style->accuracy = SplatAccuracy::Affine;
    scene.style->size = { SplatSize::Mode::Spacing, 1.0, 0 };
    scene.style->wall = { Rgba8{ 0, 0, 0, 255 }, Rgba8{ 0, 0, 0, 255 } };
    scene.plan.batches[0].style = scene.style;
    std::vector<TestPoint> roof = gridOfPoints(60, 6.0, 1.0);
    for (TestPoint& point : roof)
    {
      point.height = 1.0f;
    }
    scene.add(roof, 0.1);
    scene.look({ 0, -4, 5 }, { 0, 0, 1 }, 0.3, 120, 120);
    EXPECT_LE(countOf(scene.draw(), black), normals ? 0 : 14) << normals;
  }
}

TEST(Walls, EndWhereTheViewEndsAndWithTheirPoint)
{
  PlanOfPoints scene = sceneOf(Technique::Solid, 0.2, true);
  TestPoint point;
  point.position = { 0.0, 0.0, 2.0 };
  point.normal = { 0.0f, 0.0f, 1.0f };
  point.height = 4.0f;
  scene.add({ point });
  // From below, looking up: the wall goes down to behind the eye.
  scene.look({ 0.0, -0.5, 0.5 }, { 0.0, 0.0, 1.7 }, 0.8, wallWidth, wallHeight, 0.2);
  const SoftwareTarget target = scene.draw();
  EXPECT_GT(countOf(target, white), 500);
  for (const float depth : target.depth)
  {
    ASSERT_GE(depth, 0.2f);
  }
  scene.plan.clippingPlanes = { { 0.0, 0.0, -1.0, 1.9 } }; // z <= 1.9
  EXPECT_EQ(countOf(scene.draw(), white), 0);
}
