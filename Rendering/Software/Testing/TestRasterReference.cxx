// Pictures against the same computed pixel by pixel in double precision.

#include "PlanOfPoints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

constexpr double pi = 3.14159265358979323846;

/// Depth along the line of sight and the pixel of a point, in double.
struct Projected
{
  double x;
  double y;
  double depth;
};
Projected project(const FrameCamera& camera, const glm::dvec3& position)
{
  const glm::dvec4 view = camera.storeToView * glm::dvec4(position, 1.0);
  const glm::dvec4 clip = camera.viewToClip * view;
  return { (clip.x / clip.w * 0.5 + 0.5) * camera.width,
    (clip.y / clip.w * 0.5 + 0.5) * camera.height, -view.z };
}

glm::dvec3 directionThrough(const FrameCamera& camera, int x, int y)
{
  const double tangentX = ((x + 0.5) / camera.width * 2.0 - 1.0) / camera.viewToClip[0][0];
  const double tangentY = ((y + 0.5) / camera.height * 2.0 - 1.0) / camera.viewToClip[1][1];
  return { tangentX, tangentY, -1.0 };
}

std::shared_ptr<ResolvedStyle> worldSized(Technique technique, SplatAccuracy accuracy, double size)
{
  auto style = std::make_shared<ResolvedStyle>();
  style->technique = technique;
  style->accuracy = accuracy;
  style->colouring.kind = PointColouring::Kind::Direct;
  style->size = { SplatSize::Mode::World, size, 0 };
  style->normalColumn = 1;
  return style;
}

struct Overlap
{
  int both = 0;
  int either = 0;
  double share() const { return either > 0 ? double(both) / either : 1.0; }
};

/// One disc, drawn and cast by rays.
Overlap overlapOf(
  PlanOfPoints& scene, const glm::dvec3& centre, const glm::dvec3& normal, double radius)
{
  scene.plan.batches[0].items.clear();
  TestPoint point;
  point.position = centre;
  point.normal = glm::vec3(normal);
  scene.add({ point });
  const SoftwareTarget target = scene.draw();
  const FrameCamera& camera = scene.plan.camera;
  const glm::dvec3 c(
    camera.storeToView * glm::dvec4(scene.plan.grid.toWorld(scene.plan.grid.toGrid(centre)), 1.0));
  const glm::dvec3 n(camera.storeToView * glm::dvec4(normal, 0.0));
  Overlap overlap;
  for (int y = 0; y < camera.height; ++y)
  {
    for (int x = 0; x < camera.width; ++x)
    {
      const glm::dvec3 ray = directionThrough(camera, x, y);
      const double t = glm::dot(n, c) / glm::dot(n, ray);
      const bool inside = t > 0.0 && glm::length(t * ray - c) <= radius;
      const bool drawn = target.depth[static_cast<std::size_t>(y * camera.width + x)] < 1e30f;
      overlap.both += inside && drawn;
      overlap.either += inside || drawn;
    }
  }
  return overlap;
}

} // namespace

TEST(RasterReference, PointsHaveTheirDepthAndWinnerInEachPixel)
{
  PlanOfPoints scene;
  scene.look({ 0.3, -1.6, 0.9 }, { 0, 0, 0 }, 0.9, 160, 120);
  std::vector<std::vector<TestPoint>> nodes;
  for (unsigned node = 0; node < 4; ++node)
  {
    nodes.push_back(wavySurface(4000, node + 10));
    scene.add(nodes.back());
  }
  const SoftwareTarget target = scene.draw(true);
  std::vector<double> depth(160 * 120, std::numeric_limits<double>::infinity());
  std::vector<std::pair<std::size_t, std::size_t>> winner(depth.size());
  std::vector<bool> doubtful(depth.size());
  // Floats of steps and of the matrix are right to 2^-24 each, over some ten operations: that far
  // from a pixel's edge, or from a nearer point's depth, rounding may decide otherwise.
  const double slackPixels = 160 * 10 * std::ldexp(1.0, -24);
  const double slackDepth = 10 * std::ldexp(1.0, -23);
  for (std::size_t node = 0; node < nodes.size(); ++node)
  {
    for (std::size_t i = 0; i < nodes[node].size(); ++i)
    {
      const QuantisationGrid& grid = scene.plan.grid;
      const Projected at =
        project(scene.plan.camera, grid.toWorld(grid.toGrid(nodes[node][i].position)));
      if (at.x < 0 || at.x >= 160 || at.y < 0 || at.y >= 120)
      {
        continue;
      }
      const auto pixel = static_cast<std::size_t>(at.y) * 160 + static_cast<std::size_t>(at.x);
      const auto nearEdge = [&](double place)
      { return std::abs(place - std::round(place)) < slackPixels; };
      doubtful[pixel] = doubtful[pixel] || nearEdge(at.x) || nearEdge(at.y) ||
        std::abs(at.depth - depth[pixel]) < slackDepth * at.depth;
      if (at.depth < depth[pixel])
      {
        depth[pixel] = at.depth;
        winner[pixel] = { node, i };
      }
    }
  }
  int compared = 0;
  for (std::size_t pixel = 0; pixel < depth.size(); ++pixel)
  {
    if (doubtful[pixel])
    {
      continue;
    }
    ++compared;
    if (std::isinf(depth[pixel]))
    {
      EXPECT_TRUE(std::isinf(target.depth[pixel])) << pixel;
      continue;
    }
    EXPECT_NEAR(target.depth[pixel], depth[pixel], slackDepth * depth[pixel]) << pixel;
    EXPECT_EQ(target.points[pixel].node, winner[pixel].first) << pixel;
    EXPECT_EQ(target.points[pixel].index, winner[pixel].second) << pixel;
  }
  EXPECT_GT(compared, 160 * 120 * 98 / 100);
}

TEST(RasterReference, DiscsCoverWhatRaysSayInAnyPose)
{
  std::mt19937 random(4711);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  PlanOfPoints scene;
  constexpr double radius = 0.35;
  double leastExact = 1.0, leastAffine = 1.0;
  for (int pose = 0; pose < 200; ++pose)
  {
    scene.look({ 0, -4, 0 }, { 0, 0, 0 }, 1.0, 320, 240);
    const glm::dvec3 centre(1.2 * unit(random), unit(random), 0.9 * unit(random));
    glm::dvec3 normal = glm::normalize(glm::dvec3(unit(random), unit(random), unit(random)));
    const glm::dvec3 towards = glm::normalize(glm::dvec3(0, -4, 0) - centre);
    // Every fourth one grazes the line of sight, to 5 degrees.
    const double cosine = glm::dot(normal, towards);
    if (pose % 4 == 0)
    {
      normal = glm::normalize(normal - towards * cosine + 0.09 * towards);
    }
    else if (std::abs(cosine) < 0.09)
    {
      normal = glm::normalize(normal + 0.1 * towards);
    }
    scene.plan.batches[0].style = worldSized(Technique::Ewa, SplatAccuracy::Exact, 2.0 * radius);
    const Overlap exact = overlapOf(scene, centre, normal, radius);
    // One pixel is the centre's, which is covered always.
    EXPECT_GE(exact.both + 1, 0.98 * exact.either) << "pose " << pose << ", " << exact.both;
    leastExact = std::min(leastExact, exact.share());
    scene.plan.batches[0].style = worldSized(Technique::Ewa, SplatAccuracy::Affine, 2.0 * radius);
    leastAffine = std::min(leastAffine, overlapOf(scene, centre, normal, radius).share());
  }
  RecordProperty("least_overlap_exact", std::to_string(leastExact));
  RecordProperty("least_overlap_affine", std::to_string(leastAffine));
  // Half a radian off the axis, grazing: there the affine image is what it costs to be cheap.
  EXPECT_GT(leastAffine, 0.25);
}

TEST(RasterReference, SpheresHaveTheirDepthInEachPixel)
{
  PlanOfPoints scene;
  for (const double distance : { 1.5, 4.0, 40.0 })
  {
    scene.plan.batches[0].items.clear();
    scene.look({ 0, -distance, 0 }, { 0, 0, 0 }, 1.2 / distance + 0.1, 200, 200);
    scene.plan.batches[0].style = worldSized(Technique::Spheres, SplatAccuracy::Affine, 1.0);
    const glm::dvec3 centre(0.25, 0.125, -0.125);
    scene.add({ { centre } });
    const SoftwareTarget target = scene.draw();
    const FrameCamera& camera = scene.plan.camera;
    const glm::dvec3 c(camera.storeToView * glm::dvec4(centre, 1.0));
    int inside = 0;
    for (int y = 0; y < 200; ++y)
    {
      for (int x = 0; x < 200; ++x)
      {
        const glm::dvec3 ray = glm::normalize(directionThrough(camera, x, y));
        const double along = glm::dot(ray, c);
        const double aside2 = glm::dot(c, c) - along * along;
        const float drawn = target.depth[static_cast<std::size_t>(y * 200 + x)];
        const double rim = std::abs(std::sqrt(aside2) - 0.5);
        if (rim < 0.5e-3)
        {
          continue; // on the outline
        }
        ASSERT_EQ(aside2 < 0.25, drawn < 1e30f) << distance << " at " << x << ", " << y;
        if (aside2 < 0.25)
        {
          ++inside;
          const double depth = (along - std::sqrt(0.25 - aside2)) * -ray.z;
          ASSERT_NEAR(drawn, depth, 1e-4 * depth) << distance << " at " << x << ", " << y;
        }
      }
    }
    EXPECT_GT(inside, 1000);
  }
}

TEST(RasterReference, AConstantColourStaysWhatItIs)
{
  for (const bool normals : { false, true })
  {
    PlanOfPoints scene;
    scene.look({ 0.3, -1.6, 0.9 }, { 0, 0, 0 }, 0.9, 160, 120);
    scene.style->technique = Technique::Splats;
    scene.style->blended = true;
    scene.style->size = { SplatSize::Mode::Spacing, 1.0, 0 };
    scene.style->normalColumn = normals ? std::optional<std::uint32_t>(1) : std::nullopt;
    std::vector<TestPoint> points = wavySurface(5000, 3);
    for (TestPoint& point : points)
    {
      point.rgb = { 201, 102, 3 };
    }
    scene.add(points, 0.05);
    const SoftwareTarget target = scene.draw();
    for (std::size_t pixel = 0; pixel < target.rgba.size(); ++pixel)
    {
      if (target.depth[pixel] < 1e30f)
      {
        ASSERT_EQ(target.rgba[pixel], 0xff0366c9u) << pixel;
      }
    }
  }
}

TEST(RasterReference, AFilterAndAPlaneLeaveOutWhatTheySay)
{
  PlanOfPoints scene;
  scene.look({ 0.3, -1.6, 0.9 }, { 0, 0, 0 }, 0.9, 160, 120);
  scene.add(wavySurface(3000, 1), 0.0, 2);
  scene.add(wavySurface(3000, 2), 0.0, 6);
  AttributeCondition building;
  building.column = 3;
  building.values = { 6.0 };
  scene.style->filter.conditions = { building };
  scene.plan.clippingPlanes = { { 1.0, 0.0, 0.0, -0.25 } }; // x >= 0.25
  const SoftwareTarget target = scene.draw(true);
  std::size_t drawn = 0;
  const NodeColumns& node = *scene.plan.batches[0].items[1].node;
  for (const PixelPoint& point : target.points)
  {
    if (point.store == PixelPoint::nothing)
    {
      continue;
    }
    ++drawn;
    ASSERT_EQ(point.node, 1u);
    const glm::dvec3 place =
      scene.plan.grid.toWorld(node.origin + GridPosition(node.positions[point.index]));
    ASSERT_GE(place.x, 0.25 - 1e-6);
  }
  EXPECT_GT(drawn, 500u);
}

TEST(RasterReference, EyeDomeLightingLeavesPlanesAsTheyAre)
{
  PlanOfPoints scene;
  scene.look({ 0, -3, 1 }, { 0, 0, 0 }, 0.5, 120, 120);
  SoftwareTarget target;
  target.reset(120, 120);
  const FrameCamera& camera = scene.plan.camera;
  for (int y = 0; y < 120; ++y)
  {
    for (int x = 0; x < 120; ++x)
    {
      // The ground, and a box in front of its upper half.
      const glm::dvec3 up(camera.storeToView * glm::dvec4(0, 0, 1, 0));
      const glm::dvec3 origin(camera.storeToView * glm::dvec4(0, 0, 0, 1));
      const double t = glm::dot(up, origin) / glm::dot(up, directionThrough(camera, x, y));
      const auto pixel = static_cast<std::size_t>(y * 120 + x);
      target.depth[pixel] = static_cast<float>(y > 60 && x > 60 ? 2.0 : t);
      target.rgba[pixel] = 0xffc8c8c8u;
    }
  }
  FrameShading shading;
  shading.eyeDomeStrength = 0.4f;
  shade(camera, shading, target);
  EXPECT_EQ(target.rgba[20 * 120 + 20], 0xffc8c8c8u); // the ground
  EXPECT_LT(target.rgba[80 * 120 + 60] & 255u, 100u); // behind the box's edge
}

TEST(RasterReference, HolesAreFilledFromWhatAgreesInDepth)
{
  PlanOfPoints scene;
  scene.look({ 0, -3, 1 }, { 0, 0, 0 }, 0.5, 64, 64);
  SoftwareTarget target;
  target.reset(64, 64);
  for (int y = 0; y < 64; ++y)
  {
    for (int x = 0; x < 32; ++x)
    {
      const auto pixel = static_cast<std::size_t>(y * 64 + x);
      target.depth[pixel] = 2.0f;
      target.rgba[pixel] = 0xff102030u;
    }
  }
  const std::size_t hole = 30 * 64 + 15, through = 40 * 64 + 10;
  target.depth[hole] = std::numeric_limits<float>::infinity();
  target.rgba[hole] = 0;
  target.depth[through] = 9.0f; // a farther surface shows through
  target.rgba[through] = 0xffffffffu;
  FrameShading shading;
  shading.fillHoles = true;
  shade(scene.plan.camera, shading, target);
  EXPECT_EQ(target.rgba[hole], 0xff102030u);
  EXPECT_EQ(target.depth[hole], 2.0f);
  EXPECT_EQ(target.rgba[through], 0xff102030u);
  EXPECT_TRUE(std::isinf(target.depth[30 * 64 + 40])) << "background stays background";
}

/// Among points of finer nodes, of which some are left out, a point's own radius says how far it is
/// from all that the store has: not from what is drawn, which is a matter of pixels.
TEST(RasterReference, PointsAmongThinnedOnesCloseTheSurface)
{
  const auto covered = [](bool refined, bool unfinished)
  {
    PlanOfPoints scene;
    scene.style->technique = Technique::Splats;
    scene.style->size = { SplatSize::Mode::Spacing, 1.0, 0 };
    scene.style->radiusColumn = 2;
    scene.plan.splatRadiusBase = 1e-3;
    scene.plan.spacingPx = 20.0f;
    scene.look({ 0, -3, 0 }, { 0, 0, 0 }, 0.9, 101, 101);
    PlanItem& item = scene.add({ { { 0.0, 0.0, 0.0 } } }, 1e-3);
    item.refined = refined;
    item.unfinished = unfinished;
    const SoftwareTarget target = scene.draw();
    return static_cast<double>(std::count_if(
      target.rgba.begin(), target.rgba.end(), [](std::uint32_t c) { return c != 0; }));
  };
  const double pi = 3.14159265358979;
  const double spacingRadius = 0.85 * 20.0;
  EXPECT_NEAR(covered(false, false), pi * spacingRadius * spacingRadius, 20.0);
  EXPECT_NEAR(covered(true, false), covered(false, false), 1e-9);
  EXPECT_NEAR(covered(true, true), 1.4 * 1.4 * pi * spacingRadius * spacingRadius, 40.0);
}
