#include "TruthPicture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pointfront::truth
{
namespace
{
/// A wall of 2 x 2 m at y = 0 that the camera sees head on, 10 pixels a metre at its depth.
class WallPicture : public testing::Test
{
protected:
  static TriangleMesh makeWall(double depth)
  {
    MeshBuilder builder;
    builder.quad(
      { -1, depth, -1 }, { 1, depth, -1 }, { 1, depth, 1 }, { -1, depth, 1 }, Material::Metal);
    return builder.take();
  }
  static TruthCamera makeCamera()
  {
    TruthCamera camera;
    camera.position = { 0, -8, 0 };
    camera.viewAngleDegrees = 2.0 * std::atan(0.25) * 180.0 / 3.14159265358979323846;
    return camera; // 4 m high at the wall
  }

  const TriangleMesh mesh_ = makeWall(0.0);
  const RayCaster rays_{ mesh_ };
};

TEST_F(WallPicture, EachPixelIsWhereTheToolHasIt)
{
  const PixelRays pixels(makeCamera(), 60, 40);
  EXPECT_DOUBLE_EQ(pixels.focalPx(), 80.0);
  const TruthPicture picture = drawTruth(rays_, pixels, 2);
  for (std::uint32_t row = 0; row < 40; ++row)
  {
    for (std::uint32_t column = 0; column < 60; ++column)
    {
      const bool inside = column >= 20 && column < 40 && row >= 10 && row < 30;
      const std::size_t at = row * 60 + column;
      ASSERT_EQ(picture.coverage[at], inside ? 255 : 0) << column << ' ' << row;
      ASSERT_EQ(std::isfinite(picture.depth[at]), inside);
      if (inside)
      {
        ASSERT_FLOAT_EQ(picture.depth[at], 8.0f); // not the distance: the depth
        ASSERT_FLOAT_EQ(picture.nearest[at], 8.0f);
        ASSERT_EQ(picture.normal[at], glm::vec3(0, -1, 0));
      }
      else
      {
        ASSERT_EQ(picture.colours.pixel(column, row)[0], background[0]);
      }
    }
  }
  const Picture mask = picture.mask();
  EXPECT_EQ(mask.pixel(20, 10)[1], 255);
  EXPECT_EQ(mask.pixel(19, 10)[1], 0);
}

TEST_F(WallPicture, ProjectingIsTheWayBack)
{
  const PixelRays pixels(makeTown().view("mid")->camera, 320, 240);
  const glm::dvec3 place = pixels.eye() + 17.0 * pixels.through(33.25, 200.5);
  const glm::dvec3 seen = pixels.project(place);
  EXPECT_NEAR(seen.x, 33.25, 1e-9);
  EXPECT_NEAR(seen.y, 200.5, 1e-9);
  EXPECT_NEAR(seen.z, 17.0, 1e-12);
  EXPECT_TRUE(pixels.mayShow(place, 0.0, 0.0));
  EXPECT_FALSE(pixels.mayShow(pixels.eye() + 17.0 * pixels.through(-3.0, 20.0), 0.0, 0.0));
  EXPECT_TRUE(pixels.mayShow(pixels.eye() + 17.0 * pixels.through(-3.0, 20.0), 0.0, 3.1));
  EXPECT_FALSE(pixels.mayShow(pixels.eye() - 5.0 * pixels.forward(), 4.9, 3.0));
}

TEST_F(WallPicture, APartlyCoveredPixelIsAMixture)
{
  const PixelRays pixels(makeCamera(), 58, 40); // the wall begins within a pixel: 19 to 39
  const PixelRays shifted(makeCamera(), 61, 40); // and here at 20.5
  EXPECT_EQ(drawTruth(rays_, pixels, 4).coverage[20 * 58 + 19], 255);
  const TruthPicture picture = drawTruth(rays_, shifted, 4);
  const std::size_t at = 20 * 61 + 20;
  EXPECT_EQ(picture.coverage[at], 8 * 255 / 16);
  const double wall = picture.colours.pixel(25, 20)[0];
  EXPECT_NEAR(picture.colours.pixel(20, 20)[0], 0.5 * (wall + background[0]), 0.51);
}

TEST(TruthPicture, TheMaskIsWhereRaysMeetTheSurface)
{
  const TruthScene town = makeTown();
  const RayCaster rays(town.mesh);
  const PixelRays pixels(town.view("far")->camera, 80, 60);
  const TruthPicture picture = drawTruth(rays, pixels, 3);
  std::size_t partly = 0;
  for (std::uint32_t row = 0; row < 60; ++row)
  {
    for (std::uint32_t column = 0; column < 80; ++column)
    {
      int hits = 0;
      for (int sample = 0; sample < 9; ++sample)
      {
        const double x = column + (sample % 3 + 0.5) / 3.0;
        const double y = row + (sample / 3 + 0.5) / 3.0;
        hits += rays.cast(pixels.eye(), pixels.through(x, y)) ? 1 : 0;
      }
      const int code = picture.coverage[row * 80 + column];
      ASSERT_EQ(code == 0, hits == 0);
      ASSERT_EQ(code == 255, hits == 9);
      ASSERT_NEAR(code, hits * 255 / 9, 1);
      partly += code != 0 && code != 255 ? 1 : 0;
    }
  }
  EXPECT_GT(partly, 20u);
}

TEST(TruthPicture, DoesNotDependOnThreads)
{
  const TruthScene knot = makeKnot();
  const RayCaster rays(knot.mesh);
  const PixelRays pixels(knot.view("close")->camera, 64, 48);
  const TruthPicture one = drawTruth(rays, pixels, 2, 1);
  const TruthPicture three = drawTruth(rays, pixels, 2, 3);
  EXPECT_EQ(one.colours.rgba, three.colours.rgba);
  EXPECT_EQ(one.coverage, three.coverage);
  EXPECT_EQ(one.depth, three.depth);
}

TEST(TruthPicture, TheMedianDepthIsThatOfTheSceneAndNotOfThePicture)
{
  const TruthScene town = makeTown();
  const RayCaster rays(town.mesh);
  const TruthCamera& camera = town.view("far")->camera;
  const double depth = medianDepth(rays, camera, 4.0 / 3.0);
  EXPECT_GT(depth, 200.0);
  EXPECT_LT(depth, 350.0);
  EXPECT_EQ(depth, medianDepth(rays, camera, 800.0 / 600.0));
}
} // namespace
} // namespace pointfront::truth
