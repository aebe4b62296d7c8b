#include "Values.h"

#include <gtest/gtest.h>

namespace pointfront
{

TEST(Values, ListsSplitAtCommas)
{
  EXPECT_EQ(splitList("a,b"), (std::vector<std::string>{ "a", "b" }));
  EXPECT_EQ(splitList(",a,,b c,"), (std::vector<std::string>{ "a", "b c" }));
  EXPECT_TRUE(splitList("").empty());
}

TEST(Values, BoxNeedsSixFiniteNumbers)
{
  const auto box = parseNumbers<6>("-1,2.5,3e2,4,5,6");
  ASSERT_TRUE(box);
  EXPECT_EQ(*box, (std::array<double, 6>{ -1.0, 2.5, 300.0, 4.0, 5.0, 6.0 }));
  for (const char* text :
    { "1,2,3,4,5", "1,2,3,4,5,6,7", "1,2,3,4,5,x", "1,2,3,4,5,nan", "1,2,3,4,5,6m", "" })
  {
    EXPECT_FALSE(parseNumbers<6>(text)) << text;
  }
}

TEST(Values, ClassesAreSortedCodesOfOneByte)
{
  EXPECT_EQ(parseClasses("6,2,2,255"), (std::vector<std::uint8_t>{ 2, 6, 255 }));
  for (const char* text : { "", "256", "-1", "2;6", "ground" })
  {
    EXPECT_FALSE(parseClasses(text)) << text;
  }
}

TEST(Values, ImageSizeIsTwoEdgesInPixels)
{
  EXPECT_EQ(parseImageSize("1280x720"), (std::array<int, 2>{ 1280, 720 }));
  EXPECT_EQ(parseImageSize("65535x1"), (std::array<int, 2>{ 65535, 1 }));
  for (const char* text : { "1280", "1280x", "x720", "0x10", "65536x10", "-5x5", "1280x720x3" })
  {
    EXPECT_FALSE(parseImageSize(text)) << text;
  }
}

TEST(Values, ANumberBetweenTwoIsANumber)
{
  const CLI::Validator check = numberBetween(0.5, 10.0);
  for (std::string text : { "0.5", "10", "1e0", "3.25" })
  {
    EXPECT_EQ(check(text), "") << text;
  }
  for (std::string text : { "nan", "-nan", "inf", "0.49", "10.1", "", "2x", "1e999" })
  {
    EXPECT_NE(check(text), "") << text;
  }
}

TEST(Values, CountsMayBeWrittenWithAnExponent)
{
  const auto counted = [](std::string text)
  {
    const std::string problem = wholeNumber()(text);
    return problem.empty() ? text : "refused";
  };
  EXPECT_EQ(counted("0"), "0");
  EXPECT_EQ(counted("1e6"), "1000000");
  EXPECT_EQ(counted("2.5E+3"), "2500");
  EXPECT_EQ(counted("999999999999999"), "999999999999999");
  for (const char* text : { "", "1e", "1e-3", "2.5", "-1", "1e15", "0x10", "nan", "inf", "1 " })
  {
    EXPECT_EQ(counted(text), "refused") << text;
  }
  std::string shortened = "2M"; // a size in bytes would be 2^21
  EXPECT_EQ(wholeNumber()(shortened), "'2M' is not a count: write 2e6");
}

} // namespace pointfront
