#include "Suggestion.h"

#include <gtest/gtest.h>

namespace pointfront
{

TEST(Suggestion, IsTheNearestWord)
{
  const std::vector<std::string> known = { "--structure", "--refinement", "--force", "--threads" };
  EXPECT_EQ(suggestionFor("--structur", known), "--structure");
  EXPECT_EQ(suggestionFor("--sturcture", known), "--structure"); // two exchanged
  EXPECT_EQ(suggestionFor("--treads", known), "--threads");
  EXPECT_EQ(suggestionFor("--ref", known), "--refinement"); // the only one that begins so
  EXPECT_EQ(suggestionFor("--bogus", known), "");
  EXPECT_EQ(suggestionFor("", known), "");
  EXPECT_EQ(suggestionFor("--", known), "");
  EXPECT_EQ(suggestionFor("biuld", { "build", "bench" }), "build");
}

TEST(Suggestion, CountsWhatIsTypedWrong)
{
  EXPECT_EQ(editDistance("", ""), 0u);
  EXPECT_EQ(editDistance("abc", ""), 3u);
  EXPECT_EQ(editDistance("abc", "acb"), 1u);
  EXPECT_EQ(editDistance("kitten", "sitting"), 3u);
}

} // namespace pointfront
