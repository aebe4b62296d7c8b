#include "pointfront/Base/PrintableText.h"

#include <gtest/gtest.h>

#include <string>

namespace pointfront
{
namespace
{

TEST(PrintableText, HasNothingThatATerminalObeys)
{
  EXPECT_EQ(printableText("a\tb\nc\rd"), "a b c d");
  EXPECT_EQ(printableText("a\x01z\x1b[31m\x7f"), "a_z_[31m_");
  EXPECT_EQ(printableText(std::string("a\0b", 3)), "a_b");
  EXPECT_EQ(printableText("a\xC2\x9B"
                          "31m"),
    "a_31m"); // ESC [ as one character of UTF-8
}

TEST(PrintableText, KeepsLettersOfUTF8)
{
  EXPECT_EQ(printableText("H\xC3\xB6he"), "H\xC3\xB6he");
  EXPECT_EQ(printableText("\xC2\xB0"), "\xC2\xB0"); // a degree sign
  EXPECT_EQ(printableText("H\xF6he"), "H_he"); // Latin-1 does not
  EXPECT_EQ(printableText("\xED\xA0\x80"), "___"); // a surrogate is not UTF-8
}

} // namespace
} // namespace pointfront
