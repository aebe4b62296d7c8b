#include "pointfront/Base/Infinity.h"
#include "pointfront/Style/ColourMap.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace pointfront;

namespace
{

/// An entry for each step of the range, whose red says which.
ColourMap steps(double low, double high)
{
  ColourMap map;
  map.entries.clear();
  for (int entry = 0; entry < 256; ++entry)
  {
    map.entries.push_back({ static_cast<std::uint8_t>(entry), 0, 0, 255 });
  }
  map.range = { low, high };
  return map;
}

TEST(ColourMap, ABoundIsTheUpperEntrysHoweverItIsRounded)
{
  const ColourMap map = steps(-12.8, 12.8); // a tenth each
  for (int bound = 1; bound < 256; ++bound)
  {
    const double value = -12.8 + 0.1 * bound;
    for (const double rounding : { -5e-5, 0.0, 5e-5 })
    {
      EXPECT_EQ(map.at(value + rounding)[0], bound) << rounding;
    }
    EXPECT_EQ(map.at(value - 3e-4)[0], bound - 1);
  }
}

TEST(ColourMap, WholeNumbersOfABytesRangeHaveAnEntryEach)
{
  const ColourMap map = steps(0.0, 255.0);
  for (int value = 0; value < 256; ++value)
  {
    EXPECT_EQ(map.at(value)[0], value);
  }
}

TEST(ColourMap, BeyondTheRangeAreItsEndsUnlessThereAreOtherColours)
{
  ColourMap map = steps(1.0, 3.0);
  EXPECT_EQ(map.at(0.0)[0], 0);
  EXPECT_EQ(map.at(1.0)[0], 0);
  EXPECT_EQ(map.at(3.0)[0], 255);
  EXPECT_EQ(map.at(4.0)[0], 255);
  map.below = { 0, 1, 0, 255 };
  map.above = { 0, 2, 0, 255 };
  map.usesBelow = map.usesAbove = true;
  EXPECT_EQ(map.at(0.999), map.below);
  EXPECT_EQ(map.at(3.001), map.above);
}

TEST(ColourMap, AnIndexedMapHasNoColourForOtherCodes)
{
  ColourMap map = steps(2.0, 5.0);
  map.entries.resize(4);
  map.indexed = true;
  map.usesBelow = map.usesAbove = true;
  for (int code = 2; code < 6; ++code)
  {
    EXPECT_EQ(map.at(code)[0], code - 2);
    for (const double rounding : { -1e-3, 1e-3 }) // 57 steps of 0.1 are no whole number
    {
      EXPECT_EQ(map.at(code + rounding)[0], code - 2);
    }
  }
  for (const double other : { 1.0, 6.0, 2.5, 4.003, 1.997, -infinity, infinity, std::nan("") })
  {
    EXPECT_EQ(map.at(other), map.missing) << other;
  }
}

} // namespace
