#include "ByteSize.h"

#include <gtest/gtest.h>

namespace pointfront
{

TEST(ByteSize, UnitsArePowersOf1024)
{
  EXPECT_EQ(parseByteSize("1"), 1u);
  EXPECT_EQ(parseByteSize("1048576"), 1048576u);
  EXPECT_EQ(parseByteSize("3B"), 3u);
  EXPECT_EQ(parseByteSize("2k"), 2048u);
  EXPECT_EQ(parseByteSize("512M"), 536870912u);
  EXPECT_EQ(parseByteSize("4G"), 4294967296u);
  EXPECT_EQ(parseByteSize("1T"), 1099511627776u);
}

TEST(ByteSize, TakesFractionsAndLongUnits)
{
  EXPECT_EQ(parseByteSize("1.5GiB"), 1610612736u);
  EXPECT_EQ(parseByteSize("0.5m"), 524288u);
  EXPECT_EQ(parseByteSize("16MB"), 16777216u);
}

TEST(ByteSize, RefusesWhatIsNoSize)
{
  for (const char* text : { "", "M", "-1", "0", "0.2", "1.2.3", ".5G", "5.", "1e9", "12X", "12Mi",
         "12 M", "8192P", "99999999999G", "+4G", "nan" })
  {
    EXPECT_EQ(parseByteSize(text), std::nullopt) << text;
  }
}

TEST(ByteSize, IsShownInTheLargestUnitThatFits)
{
  EXPECT_EQ(byteSizeText(0), "0 B");
  EXPECT_EQ(byteSizeText(1023), "1023 B");
  EXPECT_EQ(byteSizeText(1536), "1.5 KiB");
  EXPECT_EQ(byteSizeText(std::uint64_t(5) << 30), "5.0 GiB");
}

} // namespace pointfront
