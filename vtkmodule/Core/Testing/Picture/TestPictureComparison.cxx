#include "pointfront/Picture/PictureComparison.h"
#include "pointfront/Picture/StructuralSimilarity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace pointfront::test
{
namespace
{
using Colour = std::array<std::uint8_t, 3>;
constexpr Colour sky = { 10, 20, 30 };
constexpr Colour wall = { 200, 150, 100 };

Picture filled(std::uint32_t width, std::uint32_t height, const Colour& colour)
{
  Picture picture{ width, height, {} };
  for (std::size_t i = 0; i < picture.pixels(); ++i)
  {
    picture.rgba.insert(picture.rgba.end(), { colour[0], colour[1], colour[2], 255 });
  }
  return picture;
}

void paint(Picture& picture, std::size_t index, const Colour& colour)
{
  std::copy(colour.begin(), colour.end(), picture.rgba.begin() + long(4 * index));
}

/// 24 x 18 pixels by a formula of integers: any program can make the same.
Picture byFormula(int k)
{
  Picture picture{ 24, 18, {} };
  for (int y = 0; y < 18; ++y)
  {
    for (int x = 0; x < 24; ++x)
    {
      for (int value : { x * 11 + y * 7 * (1 + k), x * x + 3 * y + 40 * k, x * y + 17 * k, 255 })
      {
        picture.rgba.push_back(std::uint8_t(value));
      }
    }
  }
  return picture;
}

TEST(PictureComparison, AgreesWithTheFormulasWrittenOutInPython)
{
  const Picture one = byFormula(0);
  const Picture other = byFormula(1);
  const auto compared = comparePictures(one, other);
  ASSERT_TRUE(compared) << compared.error().what;
  // Two-dimensional windows of 11 x 11, summed up for each pixel, in double.
  EXPECT_NEAR(compared->ssim, 0.3595609912231872, 1e-12);
  EXPECT_NEAR(compared->psnrDecibels, 10.418391217598373, 1e-12);
  EXPECT_EQ(compared->pixels, 24u * 18u);
  EXPECT_FALSE(compared->identical);
  EXPECT_FALSE(compared->holes || compared->bloat || compared->background);

  double corner = 0.0;
  double centre = 0.0;
  structuralSimilarity(one, other,
    [&](std::uint32_t row, const double* values)
    {
      corner = row == 0 ? values[0] : corner;
      centre = row == 9 ? values[12] : centre;
    });
  EXPECT_NEAR(corner, 0.2956501362709018, 1e-12);
  EXPECT_NEAR(centre, -0.3434823313520968, 1e-12);
}

TEST(PictureComparison, ADifferenceOfOneLevelHasAKnownRatio)
{
  const Picture one = filled(9, 7, { 100, 100, 100 });
  const Picture other = filled(9, 7, { 101, 101, 101 });
  const auto compared = comparePictures(one, other);
  ASSERT_TRUE(compared);
  EXPECT_NEAR(compared->psnrDecibels, 20.0 * std::log10(255.0), 1e-12);
  const double c = 2.55 * 2.55; // no variance: SSIM is that of the means
  EXPECT_NEAR(
    compared->ssim, (2.0 * 100.0 * 101.0 + c) / (100.0 * 100.0 + 101.0 * 101.0 + c), 1e-12);
  EXPECT_EQ(compared->shareOver8, 0.0);
}

TEST(PictureComparison, IdenticalPicturesDifferByNothing)
{
  const Picture picture = byFormula(3);
  const auto compared = comparePictures(picture, picture);
  ASSERT_TRUE(compared);
  EXPECT_TRUE(compared->identical);
  EXPECT_TRUE(std::isinf(compared->psnrDecibels));
  EXPECT_EQ(compared->ssim, 1.0);
}

TEST(PictureComparison, EightLevelsAreWithinNineAreNot)
{
  const Picture reference = filled(10, 2, { 50, 50, 50 });
  Picture drawn = reference;
  paint(drawn, 0, { 58, 42, 50 });
  paint(drawn, 1, { 50, 59, 50 });
  paint(drawn, 2, { 50, 50, 41 });
  paint(drawn, 3, { 0, 255, 0 });
  const auto compared = comparePictures(drawn, reference);
  ASSERT_TRUE(compared);
  EXPECT_DOUBLE_EQ(compared->shareOver8, 3.0 / 20.0);
  const double greys = 8.0 * (0.587 - 0.299) + 9.0 * 0.587 + 9.0 * 0.114 +
    (205.0 * 0.587 - 50.0 * 0.299 - 50.0 * 0.114); // the difference of each, without its sign
  EXPECT_NEAR(compared->meanDifference, greys / 20.0, 1e-12);
}

/// A wall of 4 x 4 pixels in a picture of 8 x 8, its mask, and a fault or two.
class MaskedComparison : public testing::Test
{
protected:
  MaskedComparison()
    : reference_(filled(8, 8, sky))
    , mask_(filled(8, 8, { 0, 0, 0 }))
  {
    for (std::size_t row = 2; row < 6; ++row)
    {
      for (std::size_t column = 2; column < 6; ++column)
      {
        paint(reference_, 8 * row + column, wall);
        paint(mask_, 8 * row + column, { 255, 255, 255 });
      }
    }
    drawn_ = reference_;
    options_.mask = &mask_;
  }

  PictureComparison compared() const
  {
    const auto result = comparePictures(drawn_, reference_, options_);
    EXPECT_TRUE(result) << result.error().what;
    return result ? *result : PictureComparison{};
  }

  Picture reference_;
  Picture mask_;
  Picture drawn_;
  ComparisonOptions options_;
};

TEST_F(MaskedComparison, CountsHolesAndBloatAgainstTheMask)
{
  paint(drawn_, 8 * 2 + 2, sky);
  paint(drawn_, 8 * 3 + 3, sky);
  paint(drawn_, 8 * 4 + 4, { 1, 1, 1 }); // wrong, but not a hole
  paint(drawn_, 0, wall);
  paint(drawn_, 1, { 11, 20, 30 }); // nearly the background is not the background
  paint(drawn_, 2, wall);
  const PictureComparison result = compared();
  EXPECT_EQ(result.pixels, 16u);
  EXPECT_EQ(result.holes, 100.0 * 2.0 / 16.0);
  EXPECT_EQ(result.bloat, 100.0 * 3.0 / 16.0);
  EXPECT_EQ(result.background, sky);
  EXPECT_DOUBLE_EQ(result.shareOver8, 3.0 / 16.0);
}

TEST_F(MaskedComparison, ComparesColoursInsideTheMaskOnly)
{
  paint(drawn_, 0, wall);
  const PictureComparison result = compared();
  EXPECT_FALSE(result.identical);
  EXPECT_TRUE(std::isinf(result.psnrDecibels));
  EXPECT_LT(result.ssim, 1.0); // its windows reach over the mask
  EXPECT_EQ(result.bloat, 100.0 / 16.0);
}

TEST_F(MaskedComparison, APartlyCoveredPixelIsNeitherHoleNorBloat)
{
  paint(mask_, 8 * 2 + 2, { 254, 254, 254 });
  paint(mask_, 0, { 1, 1, 1 });
  paint(mask_, 1, { 127, 127, 127 });
  paint(drawn_, 8 * 2 + 2, sky);
  paint(drawn_, 0, wall);
  paint(drawn_, 1, wall);
  const PictureComparison result = compared();
  EXPECT_EQ(result.pixels, 16u);
  EXPECT_EQ(result.holes, 0.0);
  EXPECT_EQ(result.bloat, 0.0);
}

TEST_F(MaskedComparison, TransparentPixelsAreBackground)
{
  for (std::size_t i = 0; i < drawn_.pixels(); ++i)
  {
    if (std::equal(sky.begin(), sky.end(), drawn_.rgba.begin() + long(4 * i)))
    {
      paint(drawn_, i, { 0, 0, 0 });
      drawn_.rgba[4 * i + 3] = 0;
    }
  }
  drawn_.rgba[4 * (8 * 2 + 2) + 3] = 0;
  const PictureComparison result = compared();
  EXPECT_EQ(result.bloat, 0.0);
  EXPECT_EQ(result.holes, 100.0 / 16.0);
}

TEST_F(MaskedComparison, BloatDoesNotChangeWhatTheBackgroundIs)
{
  drawn_ = filled(8, 8, wall); // all over: its own most frequent colour is the wall's
  const PictureComparison result = compared();
  EXPECT_EQ(result.background, sky);
  EXPECT_EQ(result.bloat, 100.0 * 48.0 / 16.0);
}

TEST_F(MaskedComparison, WithoutAMaskTheReferenceAndItsBackgroundAreOne)
{
  options_.mask = nullptr;
  options_.background = sky;
  paint(drawn_, 8 * 2 + 2, sky);
  paint(drawn_, 0, wall);
  const PictureComparison result = compared();
  EXPECT_EQ(result.pixels, 16u);
  EXPECT_EQ(result.holes, 100.0 / 16.0);
  EXPECT_EQ(result.bloat, 100.0 / 16.0);
  reference_ = filled(8, 8, sky);
  EXPECT_FALSE(comparePictures(drawn_, reference_, options_));
}

TEST_F(MaskedComparison, AsksForABackgroundThatItCannotTell)
{
  const Picture white = filled(8, 8, { 255, 255, 255 });
  options_.mask = &white;
  const auto everything = comparePictures(drawn_, reference_, options_);
  ASSERT_FALSE(everything);
  EXPECT_EQ(everything.error().kind, Error::Kind::BadArgument);
  EXPECT_NE(everything.error().what.find("say its colour"), std::string::npos);
  options_.background = sky;
  EXPECT_EQ(compared().holes, 100.0 * 48.0 / 64.0);

  options_.mask = &mask_;
  options_.background.reset();
  for (std::size_t i = 0; i < 24; ++i) // half of the 48 outside
  {
    paint(reference_, i < 18 ? i : i + 6 + 32, { std::uint8_t(i), 0, 0 });
  }
  EXPECT_FALSE(comparePictures(drawn_, reference_, options_));
}

TEST_F(MaskedComparison, RefusesSizesThatDifferAndAnEmptyMask)
{
  const Picture narrow = filled(7, 8, sky);
  const auto sizes = comparePictures(narrow, reference_, {});
  ASSERT_FALSE(sizes);
  EXPECT_EQ(sizes.error().kind, Error::Kind::BadArgument);
  EXPECT_NE(sizes.error().what.find("7x8"), std::string::npos);
  EXPECT_NE(sizes.error().what.find("8x8"), std::string::npos);
  options_.mask = &narrow;
  EXPECT_FALSE(comparePictures(drawn_, reference_, options_));
  const Picture black = filled(8, 8, { 127, 0, 0 });
  options_.mask = &black;
  EXPECT_FALSE(comparePictures(drawn_, reference_, options_));
}

TEST(StructuralSimilarity, APictureSmallerThanTheWindowIsMeasured)
{
  const Picture one = filled(1, 1, { 0, 0, 0 });
  const Picture other = filled(1, 1, { 255, 255, 255 });
  const auto compared = comparePictures(one, other);
  ASSERT_TRUE(compared);
  const double c = 2.55 * 2.55;
  EXPECT_NEAR(compared->ssim, c / (255.0 * 255.0 + c), 1e-12);
  EXPECT_EQ(compared->shareOver8, 1.0);
}
} // namespace
} // namespace pointfront::test
