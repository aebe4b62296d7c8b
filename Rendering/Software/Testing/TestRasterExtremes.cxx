// Views and splats at the ends of what numbers can say.

#include "PlanOfPoints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

std::size_t pixelsCovered(const SoftwareTarget& target)
{
  return static_cast<std::size_t>(std::count_if(target.depth.begin(), target.depth.end(),
    [](float depth) { return depth < std::numeric_limits<float>::infinity(); }));
}

void expectSound(const SoftwareTarget& target)
{
  for (const float depth : target.depth)
  {
    ASSERT_FALSE(std::isnan(depth));
    ASSERT_GE(depth, 0.0f);
  }
}

/// Every technique with splats of `size` world units.
std::vector<ResolvedStyle> allStyles(double size)
{
  std::vector<ResolvedStyle> styles;
  for (const Technique technique : { Technique::Points, Technique::Splats, Technique::Spheres,
         Technique::Silhouettes, Technique::Solid, Technique::Ewa })
  {
    for (const SplatAccuracy accuracy :
      { SplatAccuracy::Affine, SplatAccuracy::Exact, SplatAccuracy::Full })
    {
      for (const bool normals : { false, true })
      {
        ResolvedStyle style;
        style.technique = technique;
        style.accuracy = accuracy;
        style.colouring.kind = PointColouring::Kind::Direct;
        style.size = { SplatSize::Mode::World, size, 0 };
        style.normalColumn = normals ? std::optional<std::uint32_t>(1) : std::nullopt;
        if (technique == Technique::Solid)
        {
          style.heightColumn = 4;
          style.wall = { Rgba8{ 250, 240, 230, 255 }, Rgba8{ 10, 60, 110, 255 } };
        }
        styles.push_back(style);
      }
    }
  }
  return styles;
}

} // namespace

TEST(RasterExtremes, NoPoints)
{
  PlanOfPoints scene;
  scene.look({ 0, -3, 0 }, { 0, 0, 0 }, 0.5, 20, 20);
  EXPECT_EQ(pixelsCovered(scene.draw()), 0u);
  scene.add({});
  EXPECT_EQ(pixelsCovered(scene.draw()), 0u);
  scene.plan.batches.clear();
  EXPECT_EQ(pixelsCovered(scene.draw()), 0u);
}

/// A cloud above the view, of which the front lists the root: it was counted as drawn in each
/// frame.
TEST(RasterExtremes, PointsBesideTheViewAreNotDrawn)
{
  PlanOfPoints scene;
  TestPoint beside;
  beside.position = { 0.0, 0.0, 50.0 };
  scene.add({ beside });
  scene.look({ 0.0, -5.0, 0.0 }, { 0.0, 0.0, 0.0 }, 0.6, 40, 30);
  SoftwareRasteriser rasteriser;
  for (int frame = 0; frame < 2; ++frame)
  {
    SoftwareTarget target;
    target.reset(40, 30);
    const RasterStatistics drawn = rasteriser.draw(scene.plan, target);
    EXPECT_EQ(drawn.points, 1u);
    EXPECT_EQ(drawn.reused, 1u) << frame;
    EXPECT_EQ(drawn.drawn, 0u) << frame;
  }
}

TEST(RasterExtremes, AnEyeOnASplatInsideASphereAndPointsBehind)
{
  for (const ResolvedStyle& style : allStyles(0.5))
  {
    PlanOfPoints scene;
    scene.plan.batches[0].style = std::make_shared<ResolvedStyle>(style);
    scene.look({ 0, 0, 0 }, { 0, 1, 0 }, 1.0, 40, 30, 1e-3);
    TestPoint here, behind, beside;
    here.normal = { 0.0f, -1.0f, 0.0f };
    behind.position = { 0.0, -1.0, 0.0 };
    beside.position = { 3.0, 0.1, 0.0 };
    beside.normal = { 0.0f, 0.0f, 1.0f };
    scene.add({ here, behind });
    expectSound(scene.draw());
    EXPECT_EQ(pixelsCovered(scene.draw()), 0u)
      << "the eye's own point, and what is behind, show nothing";
    scene.plan.batches[0].items.clear();
    scene.add({ beside });
    EXPECT_EQ(pixelsCovered(scene.draw()), 0u) << "out of sight, near the eye's plane";
  }
}

/// Splats near the eye reach behind it and over the edges of the picture.
TEST(RasterExtremes, AroundTheEyeAPartOfAViewIsThatPartOfTheWhole)
{
  const PixelRectangle part{ 30, 40, 75, 60 };
  for (const ResolvedStyle& style : allStyles(0.3))
  {
    PlanOfPoints scene;
    scene.plan.batches[0].style = std::make_shared<ResolvedStyle>(style);
    scene.add(wavySurface(2000, 7));
    scene.look({ 0.1, 0.05, 0.25 }, { 0.6, 0.7, 0.25 }, 1.6, 120, 80);
    const SoftwareTarget whole = scene.draw();
    EXPECT_GT(pixelsCovered(whole), 1000u);
    SoftwareTarget target;
    target.reset(part);
    SoftwareRasteriser().draw(scene.plan, target);
    int others = 0;
    for (int y = part.bottom; y < part.top; ++y)
    {
      for (int x = part.left; x < part.right; ++x)
      {
        const std::size_t there = static_cast<std::size_t>(y * 120 + x);
        const auto here =
          static_cast<std::size_t>((y - part.bottom) * part.width() + x - part.left);
        others +=
          whole.rgba[there] != target.rgba[here] || whole.depth[there] != target.depth[here];
      }
    }
    EXPECT_EQ(others, 0) << int(style.technique) << ' ' << int(style.accuracy) << ' '
                         << style.normalColumn.has_value();
  }
}

TEST(RasterExtremes, CoordinatesOfTenThousandKilometresChangeNoBit)
{
  // Steps of 2^-12, offsets that doubles hold exactly with them: the same numbers after the eye's
  // are taken off.
  for (const ResolvedStyle& style : allStyles(0.03125))
  {
    std::vector<SoftwareTarget> pictures;
    for (const double offset : { 0.0, 10485760.0 })
    {
      PlanOfPoints scene;
      scene.plan.batches[0].style = std::make_shared<ResolvedStyle>(style);
      const glm::dvec3 moved(offset, -offset, 0.25 * offset);
      std::vector<TestPoint> points = wavySurface(500, 5);
      for (TestPoint& point : points)
      {
        point.position = scene.plan.grid.toWorld(scene.plan.grid.toGrid(point.position)) + moved;
      }
      scene.add(points, 0.05);
      scene.look(glm::dvec3(0.25, -1.5, 0.875) + moved, moved, 0.9, 100, 80);
      pictures.push_back(scene.draw());
    }
    EXPECT_GT(pixelsCovered(pictures[0]), 200u);
    EXPECT_EQ(pictures[0].rgba, pictures[1].rgba);
    EXPECT_EQ(pictures[0].depth, pictures[1].depth);
  }
}

TEST(RasterExtremes, DepthsFromAMillimetreToTenThousandKilometres)
{
  for (const ResolvedStyle& style : allStyles(0.0))
  {
    PlanOfPoints scene;
    scene.plan.batches[0].style = std::make_shared<ResolvedStyle>(style);
    scene.look({ 0, 0, 0 }, { 0, 1, 0 }, 1.0, 33, 33, 1e-4, 1e8);
    for (const double depth : { 9765625e-10, 1.0, 1e3, 1e7 })
    {
      scene.plan.batches[0].items.clear();
      scene.add({ { { 0.0, depth, 0.0 } } });
      const SoftwareTarget target = scene.draw();
      EXPECT_GE(pixelsCovered(target), 1u) << depth;
      // A sphere is drawn a pixel wide, and shows its near side.
      const bool sphere = style.technique == Technique::Spheres;
      EXPECT_NEAR(target.depth[16 * 33 + 16] / depth, 1.0, sphere ? 0.025 : 1e-6);
    }
  }
}

TEST(RasterExtremes, SplatsOfNoSizeAndOfAMillionPixels)
{
  for (const double size : { 0.0, 1e6 })
  {
    for (const ResolvedStyle& style : allStyles(size))
    {
      PlanOfPoints scene;
      scene.plan.batches[0].style = std::make_shared<ResolvedStyle>(style);
      scene.look({ 0, -2e6, 0 }, { 0, 0, 0 }, 1.0, 48, 32, 1.0, 1e9);
      TestPoint point;
      point.normal = { 0.0f, -1.0f, 0.0f };
      scene.add({ point });
      const SoftwareTarget target = scene.draw();
      expectSound(target);
      EXPECT_GE(pixelsCovered(target), 1u);
      EXPECT_LE(pixelsCovered(target), size > 0.0 ? 48u * 32u : 9u);
      scene.look({ 0, -2.0, 0 }, { 0, 0, 0 }, 1.0, 48, 32, 1e-3, 1e9);
      expectSound(scene.draw());
    }
  }
}

TEST(RasterExtremes, NarrowAndWideViews)
{
  for (const double degrees : { 1.0, 170.0 })
  {
    for (const ResolvedStyle& style : allStyles(0.25))
    {
      PlanOfPoints scene;
      scene.plan.batches[0].style = std::make_shared<ResolvedStyle>(style);
      const double distance = degrees < 10.0 ? 100.0 : 2.0;
      scene.look({ 0, -distance, 0 }, { 0, 0, 0 }, degrees * 0.017453292519943295, 64, 48);
      scene.add(wavySurface(200, 9));
      const SoftwareTarget target = scene.draw();
      expectSound(target);
      EXPECT_GE(pixelsCovered(target), 1u);
    }
  }
}

TEST(RasterExtremes, PicturesOfOnePixelAndOfSixteenThousand)
{
  for (const ResolvedStyle& style : allStyles(0.1))
  {
    PlanOfPoints scene;
    scene.plan.batches[0].style = std::make_shared<ResolvedStyle>(style);
    scene.add(wavySurface(50, 1));
    scene.look({ 0, -3, 0 }, { 0, 0, 0 }, 0.9, 1, 1);
    EXPECT_EQ(pixelsCovered(scene.draw()), 1u);
  }
  // 16384 x 16384, of which a band is drawn: all that depends on the size is its.
  PlanOfPoints scene;
  scene.add({ { { 0.0, 0.0, 0.0 } } });
  scene.look({ 0, -3, 0 }, { 0, 0, 0 }, 0.9, 16384, 16384);
  SoftwareTarget band;
  band.keepPoints = true;
  band.reset({ 0, 8184, 16384, 8200 });
  SoftwareRasteriser rasteriser;
  rasteriser.draw(scene.plan, band);
  EXPECT_EQ(pixelsCovered(band), 1u);
  EXPECT_EQ(band.points[8 * 16384 + 8192].node, 0u);
}

TEST(RasterExtremes, NormalsThatSayNothing)
{
  const float inf = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const ResolvedStyle& style : allStyles(0.25))
  {
    for (const glm::vec3& normal : { glm::vec3(0.0f), glm::vec3(nan), glm::vec3(inf, 0.0f, 0.0f),
           glm::vec3(1e-30f), glm::vec3(1e30f, 1.0f, 0.0f) })
    {
      PlanOfPoints scene;
      scene.plan.batches[0].style = std::make_shared<ResolvedStyle>(style);
      scene.plan.shading.lit = true;
      scene.look({ 0, -3, 0 }, { 0, 0, 0 }, 0.9, 64, 64);
      TestPoint point;
      point.normal = normal;
      scene.add({ point });
      const SoftwareTarget target = scene.draw();
      expectSound(target);
      EXPECT_GE(pixelsCovered(target), 10u) << "it faces the eye";
    }
  }
}

TEST(RasterExtremes, TenThousandSplatsOnOnePixel)
{
  PlanOfPoints scene;
  scene.style->technique = Technique::Splats;
  scene.style->blended = true;
  scene.style->size = { SplatSize::Mode::World, 0.01, 0 };
  scene.look({ 0, -3, 0 }, { 0, 0, 0 }, 0.9, 33, 33);
  std::vector<TestPoint> points(10000);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i].rgb = { static_cast<std::uint8_t>(i % 2 ? 255 : 0), 255, 10 };
  }
  scene.add(points);
  const SoftwareTarget target = scene.draw();
  const std::uint32_t middle = target.rgba[16 * 33 + 16];
  EXPECT_NEAR(middle & 255u, 128.0, 1.0);
  EXPECT_EQ(middle >> 8 & 255u, 255u);
  EXPECT_EQ(middle >> 16 & 255u, 10u);
}
