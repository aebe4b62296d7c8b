#include "PictureMemory.h"

#include <gtest/gtest.h>

namespace pointfront
{

namespace
{
constexpr std::uint64_t MiB = std::uint64_t(1) << 20;
}

TEST(PictureMemory, APictureOfHalfTheMemoryIsWhole)
{
  const auto memory = PictureMemory::share({ 1024, 1024 }, 64 * MiB, 32, 2);
  ASSERT_TRUE(memory);
  EXPECT_EQ(memory->bandRows(), 1024);
  EXPECT_EQ(memory->pointBytesOfFrames(), 32 * MiB);
  EXPECT_EQ(memory->budgetBytes(), 64 * MiB);
}

TEST(PictureMemory, ALargerOneIsDrawnInBandsOfAQuarter)
{
  const auto memory = PictureMemory::share({ 1024, 1025 }, 64 * MiB, 32, 2);
  ASSERT_TRUE(memory);
  EXPECT_EQ(memory->bandRows(), 512 - 4); // with two rows of each neighbour
  EXPECT_EQ(memory->pointBytesOfBands(), 48 * MiB);
  EXPECT_EQ(memory->pointBytesOfFrames(), 32 * MiB); // frames are whole whatever they take
}

TEST(PictureMemory, NothingOverflows)
{
  const auto memory = PictureMemory::share({ 65535, 65535 }, 1024 * MiB, 64, 8);
  ASSERT_TRUE(memory);
  EXPECT_EQ(memory->bytesOfRows(65535), std::uint64_t(64) * 65535 * 65535);
  EXPECT_EQ(memory->bandRows(), 64 - 16);
}

TEST(PictureMemory, ABandHasARowAtLeast)
{
  const auto memory = PictureMemory::share({ 1000, 100 }, 1000 * 32 * 3, 32, 0);
  ASSERT_TRUE(memory);
  EXPECT_EQ(memory->bandRows(), 1);
  const auto none = PictureMemory::share({ 1000, 100 }, 1000 * 32, 32, 0);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().kind, Error::Kind::NoMemory);
  EXPECT_NE(none.error().what.find("--memory"), std::string::npos);
}

} // namespace pointfront
