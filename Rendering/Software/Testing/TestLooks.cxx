// Light and eye-dome lighting by class: pictures whose pixels are known beforehand.

#include "PlanOfPoints.h"
#include "SoftwareComposition.h"

#include <gtest/gtest.h>

#include <limits>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

constexpr int ballsPx = 100;

int redAt(const SoftwareTarget& target, int x, int y)
{
  return static_cast<int>(target.rgba[static_cast<std::size_t>(y * ballsPx + x)] & 255u);
}

/// Two balls beside each other, the right one of another look.
SoftwareTarget twoBalls(const FrameLook& left, const FrameLook& right)
{
  PlanOfPoints scene;
  scene.look({ 0, -4, 0 }, { 0, 0, 0 }, 0.6, ballsPx, ballsPx);
  scene.style->technique = Technique::Spheres;
  scene.style->size = { SplatSize::Mode::World, 1.0, 0 };
  scene.add({ { { -0.6, 0, 0 }, { 200, 200, 200 } } });
  auto other = std::make_shared<ResolvedStyle>(*scene.style);
  other->look = 1;
  scene.plan.batches.push_back({ 0, other, {} });
  scene.add({ { { 0.6, 0, 0 }, { 200, 200, 200 } } });
  scene.plan.batches[1].items.push_back(scene.plan.batches[0].items.back());
  scene.plan.batches[0].items.pop_back();
  static_cast<FrameLook&>(scene.plan.shading) = left;
  scene.plan.shading.furtherLooks = { right };
  SoftwareTarget target = scene.draw();
  shade(scene.plan.camera, scene.plan.shading, target);
  return target;
}

FrameLook litBy(float ambient, float diffuse)
{
  FrameLook look;
  look.lit = true;
  look.ambient = ambient;
  look.diffuse = diffuse;
  return look;
}

} // namespace

TEST(Looks, EachClassHasItsOwnLight)
{
  const SoftwareTarget target = twoBalls(FrameLook(), litBy(0.25f, 0.5f));
  constexpr int row = ballsPx / 2, leftBall = 25, rightBall = 75;
  EXPECT_EQ(redAt(target, leftBall, row), 200);
  EXPECT_EQ(redAt(target, leftBall - 16, row), 200) << "flat, to its rim";
  EXPECT_NEAR(redAt(target, rightBall, row), 150, 3) << "ambient and diffuse, in the middle";
  EXPECT_LT(redAt(target, rightBall + 18, row), 120) << "darker towards its rim";
  EXPECT_EQ(redAt(twoBalls(litBy(0.1f, 0.9f), FrameLook()), rightBall + 18, row), 200);
}

TEST(Looks, EachClassHasItsOwnEyeDomeLighting)
{
  PlanOfPoints scene;
  scene.look({ 0, -3, 1 }, { 0, 0, 0 }, 0.5, ballsPx, ballsPx);
  SoftwareTarget target;
  target.reset(ballsPx, ballsPx);
  target.looks.assign(target.depth.size(), 0);
  for (std::size_t pixel = 0; pixel < target.depth.size(); ++pixel)
  {
    const auto x = static_cast<int>(pixel) % ballsPx, y = static_cast<int>(pixel) / ballsPx;
    target.depth[pixel] = x < ballsPx / 2 ? 2.0f : 2.2f;
    target.rgba[pixel] = 0xffc8c8c8u;
    target.looks[pixel] = static_cast<std::uint16_t>(y / 25);
  }
  FrameShading shading;
  FrameLook weak, strong, wide;
  weak.eyeDomeStrength = 0.01f;
  strong.eyeDomeStrength = 0.4f;
  wide.eyeDomeStrength = 0.4f;
  wide.eyeDomeRadiusPx = 4.0f;
  shading.furtherLooks = { weak, strong, wide };
  EXPECT_EQ(shading.reachPx(), 5);
  shade(scene.plan.camera, shading, target);
  EXPECT_EQ(redAt(target, ballsPx / 2, 12), 200) << "without";
  EXPECT_LT(redAt(target, ballsPx / 2, 37), 200);
  EXPECT_GT(redAt(target, ballsPx / 2, 37), redAt(target, ballsPx / 2, 62)) << "weak, strong";
  EXPECT_EQ(redAt(target, ballsPx / 2 + 2, 62), 200) << "one pixel wide";
  EXPECT_LT(redAt(target, ballsPx / 2 + 2, 87), 150) << "four pixels wide";
  EXPECT_EQ(redAt(target, ballsPx / 2 - 1, 87), 200) << "in front of the step";
}

TEST(Looks, AFilledPixelHasTheLookOfThoseAround)
{
  PlanOfPoints scene;
  scene.look({ 0, -3, 1 }, { 0, 0, 0 }, 0.5, ballsPx, ballsPx);
  SoftwareTarget target;
  target.reset(ballsPx, ballsPx);
  target.depth.assign(target.depth.size(), 2.0f);
  target.rgba.assign(target.depth.size(), 0xffc8c8c8u);
  target.looks.assign(target.depth.size(), 1);
  const std::size_t hole = 40 * ballsPx + 40;
  target.depth[hole] = std::numeric_limits<float>::infinity();
  target.rgba[hole] = 0;
  target.looks[hole] = 0;
  FrameShading shading;
  shading.fillHoles = true;
  shading.furtherLooks.resize(1);
  shade(scene.plan.camera, shading, target);
  EXPECT_EQ(target.depth[hole], 2.0f);
  EXPECT_EQ(target.looks[hole], 1);
}
