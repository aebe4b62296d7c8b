// Attributes from pixels of each type: exact numbers, palettes, alpha, wide colours.

#include "ColouredCloud.h"
#include "WrittenTiff.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

using namespace pointfront;
using namespace pointfront::test;

TEST(ImageValuesPass, ATransparentPixelSaysNothing)
{
  WrittenTiff image;
  image.width = 2;
  image.height = 1;
  image.channels = 4;
  image.alpha = true;
  image.values = { 200, 100, 50, 128, 1, 2, 3, 0 };
  image.at(0, 1);
  const ColouredCloud outcome = coloured(
    cloud({ { 0.5, 0.5, 0 }, { 1.5, 0.5, 0 } }), { { "rgb", { image.write("alpha.tif") } } });
  EXPECT_EQ(outcome.values("rgb"), (std::vector<double>{ 200, 100, 50, 0, 0, 0 }))
    << "not multiplied by alpha";
}

TEST(ImageValuesPass, EveryTypeOfPixelIsExact)
{
  struct Case
  {
    int bits;
    int format;
    std::vector<double> values;
  };
  const Case cases[] = { { 8, 1, { 0, 255 } }, { 16, 1, { 1, 65535 } },
    { 32, 1, { 16777217, 4294967295.0 } }, { 8, 2, { -128, 127 } }, { 16, 2, { -32768, 32767 } },
    { 32, 2, { -2147483648.0, 123456789 } }, { 32, 3, { -1.5, 3e10f } },
    { 64, 3, { 1.23456789012, 1e300 } } };
  for (const Case& c : cases)
  {
    for (const int tile : { 0, 16 })
    {
      WrittenTiff image;
      image.width = 2;
      image.height = 1;
      image.bits = c.bits;
      image.sampleFormat = c.format;
      image.values = c.values;
      image.tile = tile;
      const std::string name = "type" + std::to_string(c.format * 100 + c.bits + tile) + ".tif";
      image.at(0, 1);
      const ColouredCloud outcome =
        coloured(cloud({ { 0.5, 0.5, 0 }, { 1.5, 0.5, 0 } }), { { "v", { image.write(name) } } });
      ASSERT_EQ(outcome.error, "");
      EXPECT_EQ(outcome.values("v"), c.values) << c.bits << " bits, format " << c.format;
    }
  }
}

TEST(ImageValuesPass, APaletteIsColourOrIndex)
{
  for (const int tile : { 0, 16 })
  {
    WrittenTiff image;
    image.width = 2;
    image.height = 1;
    image.values = { 3, 200 };
    image.palette = true;
    image.tile = tile;
    image.at(0, 1);
    const std::string path = image.write("palette" + std::to_string(tile) + ".tif");
    const ColouredCloud outcome = coloured(cloud({ { 0.5, 0.5, 0 }, { 1.5, 0.5, 0 } }),
      { { "class_map", { path } }, { "rgb", { path } } });
    ASSERT_EQ(outcome.error, "");
    EXPECT_EQ(outcome.values("class_map"), (std::vector<double>{ 3, 200 }));
    EXPECT_EQ(outcome.values("rgb"), (std::vector<double>{ 252, 3, 7, 55, 200, 7 }));
  }
}

TEST(ImageValuesPass, GreyAndSixteenBitsBecomeColours)
{
  WrittenTiff grey;
  grey.width = 1;
  grey.height = 1;
  grey.values = { 90 };
  grey.at(0, 1);
  WrittenTiff deep = grey;
  deep.channels = 3;
  deep.bits = 16;
  deep.values = { 65535, 514, 0 };
  deep.at(1, 1);
  const ColouredCloud one =
    coloured(cloud({ { 0.5, 0.5, 0 } }), { { "rgb", { grey.write("grey.tif") } } });
  EXPECT_EQ(one.values("rgb"), (std::vector<double>{ 90, 90, 90 }));
  EXPECT_EQ(one.schema[0].type, ScalarType::UInt8);
  const ColouredCloud both = coloured(cloud({ { 0.5, 0.5, 0 }, { 1.5, 0.5, 0 } }),
    { { "rgb", { grey.write("grey.tif"), deep.write("deep.tif") } } });
  EXPECT_EQ(both.values("rgb"), (std::vector<double>{ 23130, 23130, 23130, 65535, 514, 0 }));
}

TEST(ImageValuesPass, WhereWhiteIsZeroColoursAreInvertedAndValuesAreNot)
{
  struct Case
  {
    int bits;
    double stored;
    double shown;
  };
  for (const Case& c : { Case{ 8, 200, 55 }, Case{ 16, 65000, 535 } })
  {
    for (const int tile : { 0, 16 })
    {
      WrittenTiff image;
      image.width = 2;
      image.height = 1;
      image.bits = c.bits;
      image.values = { c.stored, 9 };
      image.noData = "9";
      image.whiteIsZero = true;
      image.tile = tile;
      image.at(0, 1);
      const std::string path = image.write("white" + std::to_string(c.bits + tile) + ".tif");
      const ColouredCloud outcome = coloured(
        cloud({ { 0.5, 0.5, 0 }, { 1.5, 0.5, 0 } }), { { "v", { path } }, { "rgb", { path } } });
      ASSERT_EQ(outcome.error, "");
      EXPECT_EQ(outcome.values("v"), (std::vector<double>{ c.stored, 0 })) << c.bits;
      EXPECT_EQ(outcome.values("rgb"), (std::vector<double>{ c.shown, c.shown, c.shown, 0, 0, 0 }))
        << c.bits;
    }
  }
}

/// A ramp of an image of few bits, as grey of 8; 0 is white if `whiteIsZero`.
void expectRamp(WrittenTiff image)
{
  const int most = (1 << image.bits) - 1;
  image.width = 9;
  image.height = 5;
  image.at(0, 5);
  std::vector<glm::dvec3> positions;
  std::vector<double> greys;
  for (int i = 0; i < image.width * image.height; ++i)
  {
    image.values.push_back((i / image.width + i % image.width) % (most + 1));
    const double value = image.values.back();
    positions.emplace_back(i % image.width + 0.5, image.height - i / image.width - 0.5, 0.0);
    greys.insert(greys.end(), 3, 255.0 / most * (image.whiteIsZero ? most - value : value));
  }
  const std::string path = image.write("few.tif");
  const ColouredCloud outcome =
    coloured(cloud(positions), { { "v", { path } }, { "rgb", { path } } });
  ASSERT_EQ(outcome.error, "");
  EXPECT_EQ(outcome.values("rgb"), greys);
  EXPECT_EQ(outcome.values("v"), image.values);
}

TEST(ImageValuesPass, FewBitsHaveTheirOwnValueWithoutData)
{
  for (const bool white : { false, true })
  {
    WrittenTiff image;
    image.width = 2;
    image.height = 1;
    image.bits = 4;
    image.values = { 3, 9 };
    image.noData = "3";
    image.whiteIsZero = white;
    image.at(0, 1);
    const std::string path = image.write("fewholes.tif");
    const ColouredCloud outcome = coloured(
      cloud({ { 0.5, 0.5, 0 }, { 1.5, 0.5, 0 } }), { { "v", { path } }, { "rgb", { path } } });
    ASSERT_EQ(outcome.error, "");
    EXPECT_EQ(outcome.values("v"), (std::vector<double>{ 0, 9 }));
    const double grey = white ? 102 : 153;
    EXPECT_EQ(outcome.values("rgb"), (std::vector<double>{ 0, 0, 0, grey, grey, grey }));
  }
}

TEST(ImageValuesPass, FewBitsAreColoursFromBlackToWhiteAndValuesAsTheyStand)
{
  for (const int bits : { 1, 2, 4 })
  {
    for (const bool white : { false, true })
    {
      for (const auto& [tile, rows] : { std::pair(0, 1), std::pair(0, 5), std::pair(16, 1) })
      {
        SCOPED_TRACE(std::to_string(bits) + (white ? " bits, white is 0, tile " : " bits, tile ") +
          std::to_string(tile) + ", strips of " + std::to_string(rows));
        WrittenTiff image;
        image.bits = bits;
        image.whiteIsZero = white;
        image.tile = tile;
        image.stripRows = rows;
        expectRamp(image);
      }
    }
  }
}

TEST(ImageValuesPass, AnIndexWithoutDataIsNoColour)
{
  for (const int tile : { 0, 16 })
  {
    WrittenTiff image;
    image.width = 3;
    image.height = 1;
    image.values = { 3, 7, 200 };
    image.palette = true;
    image.noData = "7";
    image.tile = tile;
    image.at(0, 1);
    const std::string path = image.write("holes" + std::to_string(tile) + ".tif");
    const ColouredCloud outcome = coloured(
      cloud({ { 0.5, 0.5, 0 }, { 1.5, 0.5, 0 }, { 2.5, 0.5, 0 } }), { { "rgb", { path } } });
    ASSERT_EQ(outcome.error, "");
    EXPECT_EQ(outcome.schema[0].type, ScalarType::UInt8);
    EXPECT_EQ(outcome.values("rgb"), (std::vector<double>{ 252, 3, 7, 0, 0, 0, 55, 200, 7 }));
  }
}
