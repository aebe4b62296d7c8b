#include "pointfront/Points/SplatRadius.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pointfront
{
namespace
{
constexpr double codeRatio = 1.0442737824274138; // 2^(1/16)
}

TEST(SplatRadius, EveryCodeIsBaseTimesAPowerOfTwo)
{
  for (const double base : { 1.0, 0.3, 1e-7, 4e6 })
  {
    EXPECT_EQ(decodeSplatRadius(0, base), 0.0f);
    EXPECT_EQ(decodeSplatRadius(128, base), static_cast<float>(base));
    for (int code = 1; code <= 255; ++code)
    {
      const float radius = decodeSplatRadius(static_cast<std::uint8_t>(code), base);
      const double ideal = base * std::exp2((code - 128) / 16.0);
      EXPECT_NEAR(radius, ideal, 1e-7 * ideal) << code;
      EXPECT_EQ(encodeSplatRadius(radius, base), code) << base;
    }
  }
}

TEST(SplatRadius, EncodingRoundsUpByLessThanOneCode)
{
  const double base = 0.37;
  for (double radius = base / 240.0; radius < base * 240.0; radius *= 1.00137)
  {
    const std::uint8_t code = encodeSplatRadius(radius, base);
    const double stored = decodeSplatRadius(code, base);
    ASSERT_GE(stored, radius);
    ASSERT_LT(stored, radius * codeRatio * (1.0 + 1e-6)) << radius;
  }
}

TEST(SplatRadius, WhatIsBeyondTheCodesIsClamped)
{
  EXPECT_EQ(encodeSplatRadius(1e300, 1.0), 255);
  EXPECT_EQ(encodeSplatRadius(std::numeric_limits<double>::infinity(), 1.0), 255);
  EXPECT_EQ(encodeSplatRadius(1e-300, 1.0), 1);
  EXPECT_EQ(encodeSplatRadius(std::numeric_limits<double>::denorm_min(), 1e300), 1);
  EXPECT_EQ(encodeSplatRadius(1.0, std::numeric_limits<double>::denorm_min()), 255);
}

TEST(SplatRadius, WhatIsNoRadiusIsUnknown)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double radius : { 0.0, -1.0, nan })
  {
    EXPECT_EQ(encodeSplatRadius(radius, 1.0), 0);
  }
  for (const double base : { 0.0, -1.0, nan, std::numeric_limits<double>::infinity() })
  {
    EXPECT_EQ(encodeSplatRadius(1.0, base), 0);
  }
  EXPECT_EQ(decodeSplatRadius(77, 0.0), 0.0f);
}

} // namespace pointfront
