#include "PictureMemory.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace pointfront
{

namespace
{
constexpr std::uint64_t MiB = std::uint64_t(1) << 20;

PictureCost plainCost(std::uint64_t pixelBytes)
{
  PictureCost cost;
  cost.pixelBytes = pixelBytes;
  return cost;
}
} // namespace

TEST(PictureMemory, APictureOfHalfTheMemoryIsWhole)
{
  const auto memory = PictureMemory::share({ 1024, 1024 }, 64 * MiB, plainCost(32));
  ASSERT_TRUE(memory);
  EXPECT_FALSE(memory->needsBands());
  EXPECT_EQ(memory->frameBytes(), 32 * MiB);
  EXPECT_EQ(memory->pointBytesOfFrames(), 32 * MiB);
  EXPECT_EQ(memory->budgetBytes(), 64 * MiB);
}

TEST(PictureMemory, ALargerOneIsDrawnInBandsOfHalf)
{
  PictureCost cost = plainCost(32);
  cost.overlapRows = 2;
  const auto memory = PictureMemory::share({ 1024, 4096 }, 64 * MiB, cost);
  ASSERT_TRUE(memory);
  EXPECT_TRUE(memory->needsBands());
  EXPECT_EQ(memory->bandRows(), 1024 - 4); // with two rows of each neighbour
  EXPECT_EQ(memory->bandBytes(), 32 * MiB);
  EXPECT_EQ(memory->pointBytesOfBands(), 32 * MiB);
  EXPECT_FALSE(memory->checkFrame()); // frames are whole
}

TEST(PictureMemory, AFrameTakesThreeQuartersAtMostByAsManyThreadsAsFit)
{
  PictureCost cost = plainCost(8);
  cost.threadPixelBytes = 8;
  cost.threads = 16;
  const auto share = [&](std::uint64_t budget) {
    return PictureMemory::share({ 1024, 1024 }, budget * MiB, cost);
  };
  EXPECT_EQ(share(1024)->frameThreads(), 16u);
  EXPECT_EQ(share(64)->frameThreads(), 5u); // 8 + 5 * 8 MiB
  EXPECT_EQ(share(64)->pointBytesOfFrames(), 16 * MiB);
  EXPECT_TRUE(share(64)->checkFrame());
  EXPECT_EQ(share(22)->frameThreads(), 1u);
  EXPECT_TRUE(share(22)->checkFrame());
  const Result<void> refused = share(16)->checkFrame();
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("1024 x 1024"), std::string::npos);
}

TEST(PictureMemory, TheLeastThatAFrameTakesIsEnoughAndAByteLessIsNot)
{
  for (const std::uint64_t pixelBytes : { 4u, 5u, 6u })
  {
    const PictureCost cost = plainCost(pixelBytes);
    const auto checked = [&](std::uint64_t budget) {
      return PictureMemory::share({ 100, 101 }, budget, cost)->checkFrame();
    };
    const Result<void> refused = checked(20000);
    ASSERT_FALSE(refused);
    const std::string& what = refused.error().what;
    const std::string before = "--memory ";
    const std::uint64_t least = std::stoull(what.substr(what.find(before) + before.size()));
    EXPECT_TRUE(checked(least)) << least;
    EXPECT_FALSE(checked(least - 1)) << least;
  }
}

TEST(PictureMemory, ThreadsHaveBuffersWithMargins)
{
  PictureCost cost = plainCost(8);
  cost.threadPixelBytes = 8;
  cost.marginPixels = 64;
  cost.threads = 4;
  const auto memory = PictureMemory::share({ 1000, 500 }, 1024 * MiB, cost);
  ASSERT_TRUE(memory);
  EXPECT_EQ(memory->frameBytes(), 8u * 1000 * 500 + 4u * 8 * 1128 * 628);
}

TEST(PictureMemory, FewerThreadsRatherThanFewRows)
{
  PictureCost cost = plainCost(8);
  cost.threadPixelBytes = 8;
  cost.marginPixels = 64;
  cost.threads = 16;
  for (const std::uint64_t budget : { 24 * MiB, 64 * MiB, 256 * MiB, 1024 * MiB })
  {
    const auto memory = PictureMemory::share({ 6000, 20000 }, budget, cost);
    ASSERT_TRUE(memory);
    EXPECT_TRUE(memory->needsBands());
    EXPECT_TRUE(memory->bandRows() >= 128 || memory->bandThreads() == 1);
    EXPECT_LE(memory->bandBytes(), budget / 2);
    EXPECT_GE(memory->bandThreads(), 1u);
  }
  EXPECT_EQ(PictureMemory::share({ 6000, 20000 }, 24 * MiB, cost)->bandThreads(), 1u);
  EXPECT_EQ(PictureMemory::share({ 6000, 20000 }, 1024 * MiB, cost)->bandThreads(), 16u);
}

TEST(PictureMemory, NothingOverflows)
{
  const auto memory = PictureMemory::share({ 65535, 65535 }, 1024 * MiB, plainCost(64));
  ASSERT_TRUE(memory);
  EXPECT_EQ(memory->frameBytes(), std::uint64_t(64) * 65535 * 65535);
  EXPECT_EQ(memory->bandRows(), 128);
}

TEST(PictureMemory, ABandHasARowAtLeast)
{
  const auto memory = PictureMemory::share({ 1000, 100 }, 1000 * 32 * 2, plainCost(32));
  ASSERT_TRUE(memory);
  EXPECT_EQ(memory->bandRows(), 1);
  const auto none = PictureMemory::share({ 1000, 100 }, 1000 * 32, plainCost(32));
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().kind, Error::Kind::NoMemory);
  EXPECT_NE(none.error().what.find("--memory 64000 at least"), std::string::npos);
}

} // namespace pointfront
