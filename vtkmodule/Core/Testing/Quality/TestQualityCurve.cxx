// The expected difference of a picture, and the choice of --quality.

#include "pointfront/Quality/QualityChoice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

using namespace pointfront;

namespace
{

ResolvedStyle splats(Technique technique, bool blended, bool normals)
{
  ResolvedStyle style;
  style.technique = technique;
  style.blended = blended;
  style.size = { SplatSize::Mode::Spacing, 1.0, 0 };
  if (normals)
  {
    style.normalColumn = 3;
  }
  return style;
}

std::string nameOf(const ResolvedStyle& style)
{
  MeasuredTechnique technique;
  technique.add(style);
  return technique.name();
}

const CurvePlace& placeOf(const std::string& technique, double errorPx)
{
  for (const CurvePlace& place : qualityCurve())
  {
    if (technique == place.technique && place.errorPx == errorPx)
    {
      return place;
    }
  }
  throw std::out_of_range(technique);
}

} // namespace

TEST(QualityCurve, EachRangeIsOrderedAndEachTechniqueBeginsWithItsFinestError)
{
  const CurvePlace* before = nullptr;
  for (const CurvePlace& place : qualityCurve())
  {
    for (const CurveRange& range : { place.psnr, place.ssim, place.off, place.frameMs,
           place.completeMs, place.megabytes, place.peakMiB })
    {
      EXPECT_LE(range.least, range.middle);
      EXPECT_LE(range.middle, range.most);
    }
    EXPECT_LE(place.ssim.most, 1.0);
    EXPECT_LE(place.off.most, 1.0);
    if (before && std::string(before->technique) == place.technique)
    {
      EXPECT_LT(before->errorPx, place.errorPx);
    }
    before = &place;
  }
  EXPECT_EQ(curveSource(), "docs/tradeoffs.md, " + std::to_string(curveScenes()) + " scenes");
}

TEST(QualityCurve, StylesHaveTheNamesOfItsTechniques)
{
  EXPECT_EQ(nameOf(splats(Technique::Splats, false, true)), "ellipses");
  EXPECT_EQ(nameOf(splats(Technique::Splats, false, false)), "discs");
  EXPECT_EQ(nameOf(splats(Technique::Splats, true, true)), "blended");
  EXPECT_EQ(nameOf(splats(Technique::Ewa, true, true)), "ewa");
  ResolvedStyle style = splats(Technique::Ewa, true, true);
  style.accuracy = SplatAccuracy::Full;
  EXPECT_EQ(nameOf(style), "ewa full");
  style = ResolvedStyle();
  style.size.value = 2.0;
  EXPECT_EQ(nameOf(style), "points");
  EXPECT_EQ(nameOf(splats(Technique::Points, false, false)), "flat discs") << "without a style";
}

TEST(QualityCurve, WhatWasNotMeasuredHasNoName)
{
  EXPECT_EQ(MeasuredTechnique().name(), "");
  EXPECT_EQ(nameOf(splats(Technique::Spheres, false, true)), "");
  EXPECT_EQ(nameOf(splats(Technique::Ewa, true, false)), "") << "blended without normals";
  ResolvedStyle style = splats(Technique::Splats, false, true);
  style.size.value = 2.0;
  EXPECT_EQ(nameOf(style), "") << "larger than closes the surface";
  style = splats(Technique::Splats, false, true);
  style.opacity = 0.5;
  EXPECT_EQ(nameOf(style), "");
  MeasuredTechnique mixed;
  mixed.add(splats(Technique::Splats, false, true));
  mixed.add(splats(Technique::Splats, true, true));
  mixed.add(splats(Technique::Splats, true, true));
  EXPECT_EQ(mixed.name(), "") << "two techniques are none";
}

TEST(QualityCurve, ADifferenceLiesBetweenThoseOfTheErrorsBesideIt)
{
  const CurvePlace& fine = placeOf("blended", 1.0);
  const CurvePlace& coarse = placeOf("blended", 2.0);
  EXPECT_EQ(expectedDifference("blended", 1.0)->psnr.middle, fine.psnr.middle);
  const CurvePlace between = expectedDifference("blended", std::sqrt(2.0)).value();
  EXPECT_NEAR(between.psnr.middle, 0.5 * (fine.psnr.middle + coarse.psnr.middle), 1e-9);
  EXPECT_NEAR(between.off.most, 0.5 * (fine.off.most + coarse.off.most), 1e-9);
  EXPECT_EQ(between.errorPx, std::sqrt(2.0));
  EXPECT_EQ(expectedDifference("blended", 0.0)->errorPx, 0.25) << "all points in sight";
  EXPECT_FALSE(expectedDifference("blended", 17.0)) << "coarser than was measured";
  EXPECT_FALSE(expectedDifference("spheres", 1.0));
  EXPECT_FALSE(expectedDifference("", 1.0));
  EXPECT_FALSE(expectedDifference("blended", std::nan("")));
}

TEST(QualityChoice, APresetIsItself)
{
  for (const QualityPreset& preset : qualityPresets)
  {
    const QualityChoice choice = chooseQuality(preset.name).value();
    EXPECT_STREQ(choice.preset.name, preset.name);
    EXPECT_FALSE(choice.place);
    EXPECT_EQ(choice.sentence, "");
  }
}

/// Nothing that the curve offers is faster and has it.
TEST(QualityChoice, AnSSIMIsReachedByTheFastestThatHasIt)
{
  for (const char* asked : { "0.5", "0.8", "0.9", "0.95" })
  {
    const QualityChoice choice = chooseQuality(asked).value();
    ASSERT_TRUE(choice.place);
    EXPECT_TRUE(choice.reached) << asked;
    EXPECT_GE(choice.place->ssim.middle, std::stod(asked));
    for (const char* technique : { "ellipses", "blended", "ewa full" })
    {
      for (const double errorPx : { 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0 })
      {
        const CurvePlace& other = placeOf(technique, errorPx);
        EXPECT_TRUE(other.ssim.middle < std::stod(asked) ||
          other.frameMs.middle >= choice.place->frameMs.middle)
          << asked << ": " << technique << " at " << errorPx;
      }
    }
    EXPECT_NE(choice.sentence.find(choice.place->technique), std::string::npos);
  }
}

TEST(QualityChoice, ATimeIsUsedForTheTruestThatKeepsIt)
{
  const QualityChoice slow = chooseQuality("1000ms").value();
  const QualityChoice fast = chooseQuality("33ms").value();
  EXPECT_TRUE(slow.reached && fast.reached);
  EXPECT_LE(fast.place->frameMs.most, 33.0);
  EXPECT_GE(slow.place->ssim.middle, fast.place->ssim.middle);
  EXPECT_EQ(fast.preset.errorPx, fast.place->errorPx);
}

TEST(QualityChoice, WhatNoPlaceHasIsSaid)
{
  for (const char* asked : { "1", "0.1ms" })
  {
    const QualityChoice choice = chooseQuality(asked).value();
    EXPECT_FALSE(choice.reached) << asked;
    EXPECT_NE(choice.sentence.find("nearest that was measured"), std::string::npos);
  }
  for (const char* wrong : { "", "best", "0", "-0.5", "1.5", "0ms", "-3ms", "33 ms", "33mss", "ms",
         "nan", "nanms", "inf" })
  {
    EXPECT_FALSE(chooseQuality(wrong)) << wrong;
  }
  EXPECT_NE(chooseQuality("balnced").error().what.find("'balanced'"), std::string::npos);
}
