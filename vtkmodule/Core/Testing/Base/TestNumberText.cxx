// Numbers in text, with a decimal point whatever the locale.

#include "pointfront/Base/NumberText.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace pointfront;

TEST(NumberText, TakesTheNumberThatBeginsAText)
{
  std::string_view text = "2.5MB";
  EXPECT_EQ(takeNumber(text), 2.5);
  EXPECT_EQ(text, "MB");
  text = "-1e3";
  EXPECT_EQ(takeNumber(text), -1000.0);
  EXPECT_EQ(text, "");
  text = "2,5";
  EXPECT_EQ(takeNumber(text), 2.0);
  EXPECT_EQ(text, ",5");
}

TEST(NumberText, TakesNothingWhereNoNumberIs)
{
  for (const char* const none : { "", "x", ".", "-" })
  {
    std::string_view text = none;
    EXPECT_TRUE(std::isnan(takeNumber(text))) << none;
    EXPECT_EQ(text, none);
  }
}

TEST(NumberText, WritesDigitsThatReadBack)
{
  EXPECT_EQ(numberText(0.25, 9), "0.25");
  EXPECT_EQ(numberText(400000.5, 17), "400000.5");
  for (const double value : { 0.1, 1e7 / 3.0, -1e-300, 5.0e15 + 0.5 })
  {
    const std::string text = numberText(value, 17);
    std::string_view rest = text;
    EXPECT_EQ(takeNumber(rest), value);
    EXPECT_EQ(rest, "");
  }
}
