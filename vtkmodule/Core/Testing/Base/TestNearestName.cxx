#include "pointfront/Base/NearestName.h"

#include <gtest/gtest.h>

namespace pointfront
{

TEST(NearestName, IsTheNearestWord)
{
  const std::vector<std::string> known = { "--structure", "--refinement", "--force", "--threads" };
  EXPECT_EQ(nearestName("--structur", known), "--structure");
  EXPECT_EQ(nearestName("--sturcture", known), "--structure"); // two exchanged
  EXPECT_EQ(nearestName("--treads", known), "--threads");
  EXPECT_EQ(nearestName("--ref", known), "--refinement"); // the only one that begins so
  EXPECT_EQ(nearestName("--bogus", known), "");
  EXPECT_EQ(nearestName("", known), "");
  EXPECT_EQ(nearestName("--", known), "");
  EXPECT_EQ(nearestName("biuld", { "build", "bench" }), "build");
  EXPECT_EQ(nearestName("Local_Height", { "rgb", "local-height" }), "local-height");
  EXPECT_EQ(nearestName(std::string(100, 'a'), { std::string(101, 'a') }), ""); // a text, no name
}

TEST(NearestName, CountsWhatIsTypedWrong)
{
  EXPECT_EQ(editDistance("", ""), 0u);
  EXPECT_EQ(editDistance("abc", ""), 3u);
  EXPECT_EQ(editDistance("abc", "acb"), 1u);
  EXPECT_EQ(editDistance("kitten", "sitting"), 3u);
}

TEST(NearestName, EndsAMessage)
{
  EXPECT_EQ(didYouMean("intensty", { "rgb", "intensity" }), "; did you mean 'intensity'?");
  EXPECT_EQ(didYouMean("colour", { "rgb", "intensity" }), "");
}

} // namespace pointfront
