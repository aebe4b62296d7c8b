#include "pointfront/Base/LetterCase.h"

#include <gtest/gtest.h>

using namespace pointfront;

TEST(LetterCase, LettersBecomeSmallAndNothingElseChanges)
{
  EXPECT_EQ(lowered("Intensity_ID [0]"), "intensity_id [0]");
  EXPECT_EQ(lowered(""), "");
  EXPECT_EQ(lowered("@[`{"), "@[`{") << "beside A, Z, a and z";
  EXPECT_EQ(lowered("\xC3\x9C.LAZ"), "\xC3\x9C.laz") << "bytes of other letters stay";
}

TEST(LetterCase, LettersBecomeCapitalsAndNothingElseChanges)
{
  EXPECT_EQ(capitals("linestring zm{`"), "LINESTRING ZM{`");
  EXPECT_EQ(capitals("\xC3\xBC.wld"), "\xC3\xBC.WLD");
}

TEST(LetterCase, ClassesAreThoseOfASCII)
{
  for (int byte = 0; byte < 256; ++byte)
  {
    const char c = static_cast<char>(byte);
    const bool letter = (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z');
    EXPECT_EQ(isAsciiLetter(c), letter) << byte;
    EXPECT_EQ(isAsciiLetterOrDigit(c), letter || (byte >= '0' && byte <= '9')) << byte;
    EXPECT_EQ(isAsciiSpace(c), std::string_view(" \t\n\v\f\r").find(c) != std::string_view::npos)
      << byte;
  }
}

TEST(LetterCase, NamesAreComparedWithoutIt)
{
  EXPECT_TRUE(sameWithoutCase("INTENSITY", "intensity"));
  EXPECT_FALSE(sameWithoutCase("intensity", "intensit"));
  EXPECT_FALSE(sameWithoutCase("a@b", "a`b"));
  EXPECT_TRUE(endsWithoutCase("a/Tile.COPC.Laz", ".copc.laz"));
  EXPECT_TRUE(endsWithoutCase(".laz", ".laz"));
  EXPECT_FALSE(endsWithoutCase("laz", ".laz"));
}

TEST(LetterCase, AnExtensionIsThatOfTheFileItself)
{
  EXPECT_EQ(loweredExtension("a.b/C.LAZ"), ".laz");
  EXPECT_EQ(loweredExtension("a.b/c"), "");
  EXPECT_EQ(loweredExtension(""), "");
}
