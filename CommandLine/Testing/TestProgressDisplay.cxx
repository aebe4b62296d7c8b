#include "ProgressDisplay.h"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

namespace pointfront
{

namespace
{
Progress halfWay()
{
  Progress progress;
  progress.phase = "reading";
  progress.done = 5'000'000;
  progress.total = 10'000'000;
  progress.fraction = 0.25;
  progress.secondsElapsed = 30.0;
  return progress;
}
} // namespace

TEST(ProgressDisplay, LineHasShareRateAndRemainingTime)
{
  const std::string text = ProgressDisplay::text(halfWay(), 2.5e6);
  EXPECT_NE(text.find("25.0 %"), std::string::npos) << text;
  EXPECT_NE(text.find("5.00 M points of 10.00 M"), std::string::npos) << text;
  EXPECT_NE(text.find("2.50 M/s"), std::string::npos) << text;
  EXPECT_NE(text.find("1:30 min left"), std::string::npos) << text; // a quarter took 30 s
}

TEST(ProgressDisplay, NoEstimateFromTheFirstMoments)
{
  Progress progress = halfWay();
  progress.fraction = 0.001;
  EXPECT_EQ(ProgressDisplay::text(progress, 0.0).find("left"), std::string::npos);
  EXPECT_TRUE(
    nlohmann::json::parse(ProgressDisplay::json(progress, 0.0))["seconds_remaining"].is_null());
}

TEST(ProgressDisplay, JsonHasTheSameFacts)
{
  const auto object = nlohmann::json::parse(ProgressDisplay::json(halfWay(), 2.5e6));
  EXPECT_EQ(object["phase"], "reading");
  EXPECT_EQ(object["done"], 5'000'000);
  EXPECT_EQ(object["total"], 10'000'000);
  EXPECT_DOUBLE_EQ(object["fraction"], 0.25);
  EXPECT_EQ(object["points_per_second"], 2'500'000);
  EXPECT_DOUBLE_EQ(object["seconds_remaining"], 90.0);
}

TEST(ProgressDisplay, ANoticeIsTold)
{
  Progress progress = halfWay();
  EXPECT_FALSE(nlohmann::json::parse(ProgressDisplay::json(progress, 0.0)).contains("notice"));
  progress.notice = "Disk space may not suffice.";
  EXPECT_EQ(nlohmann::json::parse(ProgressDisplay::json(progress, 0.0))["notice"],
    "Disk space may not suffice.");
  testing::internal::CaptureStderr();
  ProgressDisplay plain(ProgressDisplay::Style::Plain);
  plain.function()(progress);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "Disk space may not suffice.\n");
}

TEST(ProgressDisplay, KnowsItsStyles)
{
  EXPECT_EQ(ProgressDisplay::styleOf("plain"), ProgressDisplay::Style::Plain);
  EXPECT_EQ(ProgressDisplay::styleOf("json"), ProgressDisplay::Style::Json);
  EXPECT_EQ(ProgressDisplay::styleOf("none"), ProgressDisplay::Style::None);
  EXPECT_TRUE(ProgressDisplay::styleOf("auto"));
  EXPECT_FALSE(ProgressDisplay::styleOf("loud"));
}

} // namespace pointfront
