#include "pointfront/Table/DecimalNumber.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <utility>

namespace pointfront
{
namespace
{
/// Reads the whole text; NaN in `decimals` terms if something is left over.
DecimalNumber readWhole(const std::string& text, char point = '.')
{
  DecimalNumber number;
  const char* const end = text.data() + text.size();
  EXPECT_EQ(readDecimal(text.data(), end, point, number), end) << text;
  return number;
}

TEST(DecimalNumber, IsTheNearestDouble)
{
  for (const char* text : { "0", "-0", "1", "-1.5", "0.1", "123456.789", "4649776.123", ".5", "5.",
         "1e22", "1e23", "9007199254740993", "123456789012345678901234567890", "1e-300", "2.5E+3",
         "4.9406564584124654e-324", "1.7976931348623157e308", "0.000000000000000000000000001",
         "179769313486231570000000000000000000000", "+7", "00012.500" })
  {
    EXPECT_EQ(readWhole(text).value, std::strtod(text, nullptr)) << text;
  }
  EXPECT_TRUE(std::signbit(readWhole("-0.0").value));
}

TEST(DecimalNumber, IsTheNearestDoubleForAnyDigits)
{
  std::mt19937_64 random(7);
  std::uniform_int_distribution<int> digits(1, 21);
  std::uniform_int_distribution<int> exponent(-30, 30);
  for (int i = 0; i < 20000; ++i)
  {
    std::string text = std::to_string(random());
    text = text.substr(0, static_cast<std::size_t>(digits(random)));
    text.insert(static_cast<std::size_t>(random() % (text.size() + 1)), ".");
    text += i % 2 == 0 ? "" : "e" + std::to_string(exponent(random));
    ASSERT_EQ(readWhole(text).value, std::strtod(text.c_str(), nullptr)) << text << " seed 7";
  }
}

TEST(DecimalNumber, IsAnExactIntegerOfUpTo64Bits)
{
  const std::pair<const char*, std::uint64_t> integers[] = { { "0", 0 }, { "-7", 7 },
    { "0009007199254740993", 9007199254740993u }, { "-9223372036854775808", 1ull << 63 },
    { "9999999999999999999", 9999999999999999999u },
    { "18446744073709551615", 18446744073709551615u } };
  for (const auto& [text, magnitude] : integers)
  {
    EXPECT_TRUE(readWhole(text).integer) << text;
    EXPECT_EQ(readWhole(text).magnitude, magnitude) << text;
  }
  for (const char* text : { "1.", "1.0", "1e3", "18446744073709551616", "99999999999999999999",
         "100000000000000000000", "nan", "-inf" })
  {
    EXPECT_FALSE(readWhole(text).integer) << text;
  }
}

TEST(DecimalNumber, SaysHowPreciselyItIsWritten)
{
  EXPECT_EQ(readWhole("12.340").decimals, 2);
  EXPECT_EQ(readWhole("12.340").digits, 4);
  EXPECT_EQ(readWhole("1200").decimals, 0);
  EXPECT_EQ(readWhole("1200").digits, 2);
  EXPECT_EQ(readWhole("1.25e-3").decimals, 5);
  EXPECT_EQ(readWhole("1.25e1").decimals, 1);
  EXPECT_EQ(readWhole("1.25e7").decimals, 0);
  EXPECT_EQ(readWhole("0.000").decimals, 0);
  EXPECT_TRUE(readWhole("1.0").pointSeen);
  EXPECT_TRUE(readWhole("1e3").pointSeen);
  EXPECT_FALSE(readWhole("17").pointSeen);
}

TEST(DecimalNumber, KnowsOtherSpellings)
{
  EXPECT_EQ(readWhole("1,5", ',').value, 1.5);
  EXPECT_EQ(readWhole("1.5D+02").value, 150.0);
  EXPECT_EQ(readWhole("1,5d1", ',').value, 15.0);
  for (const char* text : { "nan", "NaN", "-nan", "nan(ind)", "-NAN(SNAN)", "1.#QNAN", "-1.#IND" })
  {
    EXPECT_TRUE(std::isnan(readWhole(text).value)) << text;
  }
  for (const char* text : { "inf", "Infinity", "1.#INF", "1e999" })
  {
    EXPECT_EQ(readWhole(text).value, HUGE_VAL) << text;
  }
  EXPECT_EQ(readWhole("-inf").value, -HUGE_VAL);
  EXPECT_EQ(readWhole("1e-999").value, 0.0);
}

TEST(DecimalNumber, EndsWhereTheNumberEnds)
{
  const std::pair<const char*, int> texts[] = { { "", 0 }, { "-", 0 }, { ".", 0 }, { "e5", 0 },
    { "x", 0 }, { "--1", 0 }, { "1x", 1 }, { "1e", 1 }, { "1e+", 1 }, { "1.2.3", 3 }, { "1-2", 1 },
    { "1e5e5", 3 }, { "na", 0 }, { "1.#", 0 } };
  for (const auto& [text, length] : texts)
  {
    DecimalNumber number;
    const std::string bytes = text;
    const char* const end = bytes.data() + bytes.size();
    EXPECT_EQ(readDecimal(bytes.data(), end, '.', number) - bytes.data(), length) << text;
  }
}
} // namespace
} // namespace pointfront
