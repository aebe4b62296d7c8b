#include "DecimalText.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

namespace pointfront
{
TEST(DecimalText, TakesTheDecimalsOfStepAndOffset)
{
  EXPECT_EQ(decimalsOf(0.01, 0.0), 2);
  EXPECT_EQ(decimalsOf(0.001, 500000.0), 3);
  EXPECT_EQ(decimalsOf(0.00025, 0.0), 5);
  EXPECT_EQ(decimalsOf(0.01, 0.125), 3);
  EXPECT_EQ(decimalsOf(1e-7, -123.0), 7);
  EXPECT_EQ(decimalsOf(1.0, 0.0), 0);
  EXPECT_EQ(decimalsOf(10.0, 0.0), 0);
}

TEST(DecimalText, TellsApartTheStepsOfAnyGrid)
{
  for (const double scale : { 1.0 / 3.0, 4.6566e-10, 0.0009765625, 0.3048006096012192, 7.1 })
  {
    const double offset = 635577.79;
    const int decimals = decimalsOf(scale, offset);
    for (std::int64_t step : { -2147483648LL, -1LL, 0LL, 1LL, 77777777LL, 2147483647LL })
    {
      std::string text;
      appendFixed(text, offset + scale * static_cast<double>(step), decimals);
      const double back = std::strtod(text.c_str(), nullptr);
      EXPECT_EQ(std::llround((back - offset) / scale), step) << text << " scale " << scale;
    }
  }
}

TEST(DecimalText, WritesEveryTypeSoThatItReadsBack)
{
  const auto textOf = [](ScalarType type, auto value)
  {
    std::string text;
    appendScalar(text, type, reinterpret_cast<const std::byte*>(&value));
    return text;
  };
  EXPECT_EQ(textOf(ScalarType::UInt8, std::uint8_t{ 200 }), "200");
  EXPECT_EQ(textOf(ScalarType::Int8, std::int8_t{ -3 }), "-3");
  EXPECT_EQ(textOf(ScalarType::UInt16, std::uint16_t{ 65535 }), "65535");
  EXPECT_EQ(textOf(ScalarType::Int16, std::int16_t{ -32768 }), "-32768");
  EXPECT_EQ(textOf(ScalarType::UInt32, std::uint32_t{ 4294967295u }), "4294967295");
  EXPECT_EQ(textOf(ScalarType::Int32, std::int32_t{ -1 }), "-1");
  EXPECT_EQ(
    textOf(ScalarType::UInt64, std::numeric_limits<std::uint64_t>::max()), "18446744073709551615");
  EXPECT_EQ(
    textOf(ScalarType::Int64, std::numeric_limits<std::int64_t>::min()), "-9223372036854775808");
  EXPECT_EQ(textOf(ScalarType::Float32, 0.1f), "0.1");
  EXPECT_EQ(textOf(ScalarType::Float64, 245379.39846), "245379.39846");
  EXPECT_EQ(textOf(ScalarType::Float64, std::numeric_limits<double>::quiet_NaN()), "nan");
}
} // namespace pointfront
