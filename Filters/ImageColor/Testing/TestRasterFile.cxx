#include "GeoTiffTags.h"
#include "GeoTransform.h"
#include "RasterFile.h"
#include "WorldFile.h"

#include "OrthoImages.h"
#include "ProjCoordinateSystems.h"
#include "WrittenTiff.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

using namespace pointfront;
using pointfront::test::ortho;
using pointfront::test::WrittenTiff;

namespace
{
std::vector<double> ramp(int count)
{
  std::vector<double> values(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = static_cast<double>(i);
  }
  return values;
}

GeoTransform transformOf(const std::string& path)
{
  const Result<GeoTiffTags> tags = GeoTiffTags::read(path);
  EXPECT_TRUE(tags.ok()) << (tags ? "" : tags.error().what);
  EXPECT_TRUE(tags && tags.value().transform);
  return tags && tags.value().transform ? *tags.value().transform : GeoTransform();
}
} // namespace

TEST(GeoTransform, CornerAndCentreAreHalfAPixelApart)
{
  const auto corner = GeoTransform::fromCorner({ 10, 20 }, { 2, 0 }, { 0, -2 });
  const auto centre = GeoTransform::fromCentre({ 11, 19 }, { 2, 0 }, { 0, -2 });
  ASSERT_TRUE(corner && centre);
  EXPECT_EQ(corner->toPixel({ 11, 19 }), glm::dvec2(0.5, 0.5));
  EXPECT_EQ(centre->toPixel({ 11, 19 }), glm::dvec2(0.5, 0.5));
  EXPECT_EQ(centre->toGround({ 0, 0 }), glm::dvec2(10, 20));
  const auto turned = GeoTransform::fromCorner({ 0, 0 }, { 3, 4 }, { 4, -3 });
  ASSERT_TRUE(turned);
  const glm::dvec2 back = turned->toPixel(turned->toGround({ 7.25, 2.5 }));
  EXPECT_NEAR(back.x, 7.25, 1e-12);
  EXPECT_NEAR(back.y, 2.5, 1e-12);
  EXPECT_FALSE(GeoTransform::fromCorner({ 0, 0 }, { 1, 1 }, { 2, 2 }));
  EXPECT_FALSE(GeoTransform::fromCorner({ NAN, 0 }, { 1, 0 }, { 0, 1 }));
}

TEST(WorldFile, IsFoundByItsNamesAndNamesTheCentreOfAPixel)
{
  EXPECT_EQ(worldFileOf(ortho + "autzen/autzen.jpg"), ortho + "autzen/autzen.wld");
  EXPECT_EQ(worldFileOf(ortho + "world_files/toronto.tif"), ortho + "world_files/toronto.tfw");
  EXPECT_EQ(worldFileOf(ortho + "mosaic_2x2/rgb1.tif"), "");
  const auto autzen = readWorldFile(ortho + "autzen/autzen.wld");
  ASSERT_TRUE(autzen.ok()) << autzen.error().what;
  EXPECT_EQ(autzen->toGround({ 0, 0 }), glm::dvec2(635615.4278659122, 853362.6430851521));
  const auto turned = readWorldFile(ortho + "world_files/grey_rot.wld"); // 10 2 2 -10 5 295
  ASSERT_TRUE(turned.ok());
  EXPECT_EQ(turned->toGround({ 0.5, 0.5 }), glm::dvec2(5, 295));
  EXPECT_EQ(turned->toGround({ 1.5, 0.5 }), glm::dvec2(15, 297));
  EXPECT_EQ(turned->toGround({ 0.5, 1.5 }), glm::dvec2(7, 285));
  const std::string path = testing::TempDir() + "short.tfw";
  std::ofstream(path) << "1\n0\n0\n-1\n";
  EXPECT_EQ(readWorldFile(path).error().kind, Error::Kind::BadFormat);
}

TEST(GeoTiffTags, PixelIsAreaAndPixelIsPoint)
{
  WrittenTiff image;
  image.values = ramp(12);
  image.at(100.0, 200.0, 10.0);
  EXPECT_EQ(transformOf(image.write("area.tif")).toGround({ 0, 0 }), glm::dvec2(100, 200));
  image.keys = { 1, 1, 0, 1, 1025, 0, 1, 2 };
  EXPECT_EQ(transformOf(image.write("point.tif")).toGround({ 0, 0 }), glm::dvec2(95, 205));
  image.keys.clear();
  image.tie = { 2.0, 1.0, 0.0, 120.0, 190.0, 0.0 }; // another pixel's corner
  EXPECT_EQ(transformOf(image.write("tie.tif")).toGround({ 0, 0 }), glm::dvec2(100, 200));
}

TEST(GeoTiffTags, ATransformationMatrixMayTurnTheImage)
{
  const GeoTransform real = transformOf(ortho + "geotiff_kinds/rotated.tif");
  EXPECT_NE(real.toGround({ 1, 0 }).y, real.toGround({ 0, 0 }).y);
  WrittenTiff image;
  image.values = ramp(12);
  image.matrix = { 3, 4, 0, 100, 4, -3, 0, 200, 0, 0, 0, 0, 0, 0, 0, 1 };
  const GeoTransform turned = transformOf(image.write("turned.tif"));
  EXPECT_EQ(turned.toGround({ 1, 0 }), glm::dvec2(103, 204));
  EXPECT_EQ(turned.toGround({ 0, 1 }), glm::dvec2(104, 197));
}

TEST(GeoTiffTags, WhatCannotBeUsedIsSaid)
{
  WrittenTiff image;
  image.values = ramp(12);
  const auto bare = GeoTiffTags::read(image.write("bare.tif"));
  ASSERT_TRUE(bare.ok());
  EXPECT_FALSE(bare->transform);
  image.tie = { 0, 0, 0, 1, 1, 0, 1, 1, 0, 2, 5, 0, 3, 2, 0, 4, 4, 0 };
  EXPECT_EQ(GeoTiffTags::read(image.write("gcp.tif")).error().kind, Error::Kind::Unsupported);
  image.at(0, 0, 0.0);
  EXPECT_EQ(GeoTiffTags::read(image.write("flat.tif")).error().kind, Error::Kind::BadFormat);
  const std::string path = testing::TempDir() + "cut.tif";
  std::ofstream(path, std::ios::binary) << std::string("II*\0\xff\xff\xff\x7f", 8);
  EXPECT_TRUE(GeoTiffTags::isTiff(path));
  EXPECT_EQ(GeoTiffTags::read(path).error().kind, Error::Kind::BadFormat);
}

TEST(RasterFile, SaysWhereAndWhatItIs)
{
  const ProjCoordinateSystems systems;
  const auto rgba =
    RasterFile::open(ortho + "geotiff_kinds/cog_rgba.tif", RasterUse::Colour, systems);
  ASSERT_TRUE(rgba.ok()) << rgba.error().what;
  EXPECT_EQ(rgba->dataChannels(), 3);
  EXPECT_EQ(rgba->alphaChannel, 3);
  ASSERT_TRUE(rgba->system);
  EXPECT_NE(rgba->system->name.find("EPSG:26913"), std::string::npos) << rgba->system->name;
  const auto grey =
    RasterFile::open(ortho + "world_files/grey_rot.tif", RasterUse::Values, systems);
  ASSERT_TRUE(grey.ok()) << grey.error().what;
  EXPECT_EQ(grey->dataChannels(), 1);
  EXPECT_FALSE(grey->system);

  WrittenTiff image;
  image.values = ramp(12);
  const std::string bare = image.write("unplaced.tif");
  EXPECT_EQ(
    RasterFile::open(bare, RasterUse::Colour, systems).error().kind, Error::Kind::Unsupported);
  EXPECT_EQ(
    RasterFile::open(bare + "x", RasterUse::Colour, systems).error().kind, Error::Kind::NotFound);
  image.bits = 32;
  image.sampleFormat = 3;
  image.at(0, 0);
  const std::string heights = image.write("heights.tif");
  EXPECT_EQ(
    RasterFile::open(heights, RasterUse::Colour, systems).error().kind, Error::Kind::Unsupported);
  std::ofstream(testing::TempDir() + "heights.prj") << systems.parse("EPSG:25832")->wkt;
  const auto placed = RasterFile::open(heights, RasterUse::Values, systems);
  ASSERT_TRUE(placed.ok()) << placed.error().what;
  ASSERT_TRUE(placed->system) << placed->systemDoubt;
  EXPECT_NE(placed->system->name.find("25832"), std::string::npos);
}
