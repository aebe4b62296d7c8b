#include "CompareCommand.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>

namespace pointfront
{

TEST(CompareCommand, ReportsWhatWasMeasured)
{
  PictureComparison comparison;
  comparison.pixels = 200;
  comparison.psnrDecibels = 31.25;
  comparison.ssim = 0.875;
  comparison.shareOver8 = 0.125;
  comparison.meanDifference = 2.75;
  comparison.holes = 1.5;
  comparison.bloat = 0.5;
  comparison.background = { 1, 2, 3 };
  const auto object = nlohmann::json::parse(comparisonJson(comparison));
  EXPECT_EQ(object.size(), 9u);
  EXPECT_EQ(object["identical"], false);
  EXPECT_EQ(object["mean_difference"], 2.75);
  EXPECT_EQ(object["pixels"], 200);
  EXPECT_EQ(object["psnr"], 31.25);
  EXPECT_EQ(object["ssim"], 0.875);
  EXPECT_EQ(object["share_over_8"], 0.125);
  EXPECT_EQ(object["holes"], 1.5);
  EXPECT_EQ(object["bloat"], 0.5);
  EXPECT_EQ(object["background"], (nlohmann::json{ 1, 2, 3 }));
  const std::string text = comparisonText(comparison);
  for (const char* part : { "200 pixels", "31.25 dB", "0.8750", "12.500 %", "1.500 %", "0.500 %" })
  {
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
  }
}

TEST(CompareCommand, WhatIsInfiniteOrUnknownIsNull)
{
  PictureComparison comparison;
  comparison.identical = true;
  comparison.psnrDecibels = std::numeric_limits<double>::infinity();
  const auto object = nlohmann::json::parse(comparisonJson(comparison));
  EXPECT_EQ(object["identical"], true);
  EXPECT_TRUE(object["psnr"].is_null());
  EXPECT_TRUE(object["holes"].is_null());
  EXPECT_TRUE(object["bloat"].is_null());
  EXPECT_TRUE(object["background"].is_null());
  EXPECT_NE(comparisonText(comparison).find("identical"), std::string::npos);
}

} // namespace pointfront
