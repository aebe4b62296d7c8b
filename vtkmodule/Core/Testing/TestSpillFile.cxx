#include "TestBuildClouds.h"

#include "pointfront/Build/MemoryPlan.h"
#include "pointfront/Build/RecordPool.h"
#include "pointfront/Build/SpillFile.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace pointfront
{
namespace
{
namespace fs = std::filesystem;

TEST(SpillFile, KeepsBytesWithoutAName)
{
  const fs::path folder = test::freshFolder("spill");
  {
    auto file = SpillFile::create(folder.string(), 100);
    ASSERT_TRUE(file) << file.error().what;
    EXPECT_TRUE(fs::is_empty(folder));
    const std::byte out[3] = {std::byte(1), std::byte(2), std::byte(3)};
    std::byte in[3] = {};
    ASSERT_TRUE((*file)->write(std::uint64_t(5) << 32, out, 3));
    ASSERT_TRUE((*file)->read(std::uint64_t(5) << 32, in, 3));
    EXPECT_TRUE(std::equal(out, out + 3, in));
    const auto beyond = (*file)->read(std::uint64_t(6) << 32, in, 1);
    ASSERT_FALSE(beyond);
    EXPECT_EQ(beyond.error().kind, Error::Kind::Unreadable);
  }
  fs::remove_all(folder);
}

TEST(SpillFile, RefusesADiskThatIsTooSmallBeforeTheWork)
{
  const auto refused = SpillFile::create(testing::TempDir(), std::uint64_t(1) << 60);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, Error::Kind::Unwritable);
  EXPECT_NE(refused.error().what.find("1099511627776 MiB of spill space"), std::string::npos)
    << refused.error().what;
}

TEST(SpillFile, NamesAFolderThatCannotBeUsed)
{
  const auto refused = SpillFile::create("/dev/full", 1);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, Error::Kind::Unwritable);
  EXPECT_NE(refused.error().what.find("/dev/full"), std::string::npos);
}

MemoryDemand demandOf(std::uint64_t points, std::uint64_t memory)
{
  MemoryDemand demand;
  demand.points = points;
  demand.largestChunk = 50000;
  demand.recordBytes = 20;
  demand.sourceBytes = 8;
  demand.nodePoints = 16384;
  demand.threads = 4;
  demand.memoryBytes = memory;
  return demand;
}

TEST(BuildMemory, StaysInMemoryWhileItFits)
{
  const auto roomy = planMemory(demandOf(10000000, std::uint64_t(1) << 30));
  ASSERT_TRUE(roomy);
  EXPECT_FALSE(roomy->spill);
  EXPECT_EQ(roomy->threads, 4u);
  const auto tight = planMemory(demandOf(10000000, std::uint64_t(150) << 20));
  ASSERT_TRUE(tight);
  EXPECT_TRUE(tight->spill);
}

TEST(BuildMemory, GivesUpThreadsBeforeItGivesUp)
{
  const auto small = planMemory(demandOf(10000000, std::uint64_t(12) << 20));
  ASSERT_TRUE(small);
  EXPECT_EQ(small->threads, 1u);
  EXPECT_GE(small->partPoints, 4u * 16384);
  const auto none = planMemory(demandOf(10000000, std::uint64_t(1) << 20));
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().kind, Error::Kind::NoMemory);
}

TEST(BuildMemory, LargeInputsDoNotMeanLargeParts)
{
  const auto plan = planMemory(demandOf(std::uint64_t(1) << 40, std::uint64_t(64) << 30));
  ASSERT_TRUE(plan);
  EXPECT_TRUE(plan->spill);
  EXPECT_LE(plan->partPoints, 1u << 20);
  EXPECT_LE(plan->blockPoints, 1u << 22);
}

} // namespace
} // namespace pointfront
