#include "pointfront/Base/PercentCode.h"

#include <gtest/gtest.h>

#include <string>

namespace pointfront
{

TEST(PercentCode, EveryByteComesBack)
{
  std::string all;
  for (int byte = 0; byte < 256; ++byte)
  {
    all += static_cast<char>(byte);
  }
  const std::string code = percentEncoded(all, "/");
  EXPECT_EQ(code.substr(0, 9), "%00%01%02");
  EXPECT_EQ(code.size(), 3 * 256 - 2 * 63u); // digits, letters and '/' are themselves
  EXPECT_EQ(percentDecoded(code), all);
}

TEST(PercentCode, WhatIsNoneStays)
{
  EXPECT_EQ(percentDecoded("a%20b%c3%BC"), "a b\xc3\xbc");
  for (const char* text : { "%", "%2", "100%", "%g0", "%0g", "%%", "a% 20" })
  {
    EXPECT_EQ(percentDecoded(text), text);
  }
  EXPECT_EQ(percentDecoded("%%20"), "% ");
  EXPECT_TRUE(isPercentCode("a%2fb", 1));
  EXPECT_FALSE(isPercentCode("a%2fb", 0));
  EXPECT_FALSE(isPercentCode("a%2", 1));
}

} // namespace pointfront
