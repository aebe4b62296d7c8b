#include "TestBuildClouds.h"

#include "pointfront/Disk/SpillFile.h"
#include "pointfront/Ingest/MemoryPlan.h"
#include "pointfront/Records/RecordPool.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <thread>

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
    const std::byte out[3] = { std::byte(1), std::byte(2), std::byte(3) };
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

std::vector<std::byte> pattern(std::size_t bytes, unsigned seed)
{
  std::vector<std::byte> data(bytes);
  for (std::byte& byte : data)
  {
    seed = seed * 1664525u + 1013904223u;
    byte = std::byte(seed >> 24);
  }
  return data;
}

/// A spill file in either way; large ranges take both of them.
class SpillWays : public testing::TestWithParam<SpillFile::Way>
{
protected:
  SpillWays()
    : folder_(test::freshFolder("spill-ways"))
  {
    auto file = SpillFile::create(folder_.string(), 1 << 20, GetParam());
    file_ = file ? std::move(*file) : nullptr;
  }
  ~SpillWays() override { fs::remove_all(folder_); }
  void SetUp() override { ASSERT_TRUE(file_); }
  bool holds(std::uint64_t offset, const std::vector<std::byte>& wanted) const
  {
    std::vector<std::byte> data(wanted.size());
    return file_->read(offset, data.data(), data.size()) && data == wanted;
  }

  fs::path folder_;
  std::unique_ptr<SpillFile> file_;
};

/// Ranges as blocks of a pool are: one behind the other, of no block of the disk, several buffers
/// long or only a few bytes.
TEST_P(SpillWays, KeepRangesOfAnyLengthAtAnyPlace)
{
  const std::size_t lengths[] = { SpillFile::leastDirectBytes, 17,
    5 * DirectAccess::bufferBytes / 2, DirectAccess::alignment, SpillFile::leastDirectBytes + 1,
    DirectAccess::bufferBytes, 3 };
  std::vector<std::byte> all;
  for (const std::size_t length : lengths)
  {
    const std::vector<std::byte> data = pattern(length, static_cast<unsigned>(length));
    ASSERT_TRUE(file_->write(all.size(), data.data(), data.size()));
    all.insert(all.end(), data.begin(), data.end());
    EXPECT_TRUE(holds(all.size() - length, data)) << length; // the file ends behind it
  }
  EXPECT_TRUE(holds(0, all));
  for (const std::size_t first : { 1u, 4095u, 4096u, 130000u })
  {
    for (const std::size_t length : { std::size_t(100), 2 * DirectAccess::bufferBytes })
    {
      const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
      EXPECT_TRUE(holds(first, { begin, begin + static_cast<std::ptrdiff_t>(length) }))
        << first << " " << length;
    }
  }
  // Sorted by parts in its place, and large ranges after small ones that the cache has.
  const std::vector<std::byte> again = pattern(DirectAccess::bufferBytes, 7);
  ASSERT_TRUE(file_->write(1001, again.data(), again.size()));
  std::copy(again.begin(), again.end(), all.begin() + 1001);
  ASSERT_TRUE(file_->write(5000, again.data(), 40));
  std::copy(again.begin(), again.begin() + 40, all.begin() + 5000);
  EXPECT_TRUE(holds(4990, { all.begin() + 4990, all.begin() + 5100 }));
  EXPECT_TRUE(holds(0, all));
}

TEST_P(SpillWays, ThreadsShareTheBlocksBetweenTheirRanges)
{
  constexpr std::size_t length = 200003;
  constexpr unsigned threads = 4;
  constexpr unsigned rounds = 8;
  std::vector<std::thread> writers;
  for (unsigned t = 0; t < threads; ++t)
  {
    writers.emplace_back(
      [&, t]
      {
        for (unsigned r = 0; r < rounds; ++r)
        {
          const std::vector<std::byte> data = pattern(length, r * threads + t);
          const std::uint64_t offset = std::uint64_t(r * threads + t) * length;
          EXPECT_TRUE(file_->write(offset, data.data(), data.size()));
          EXPECT_TRUE(holds(offset, data));
        }
      });
  }
  for (std::thread& writer : writers)
  {
    writer.join();
  }
  for (unsigned i = 0; i < threads * rounds; ++i)
  {
    EXPECT_TRUE(holds(std::uint64_t(i) * length, pattern(length, i))) << i;
  }
}

TEST_P(SpillWays, AFileThatEndsIsAnErrorThatSaysWhere)
{
  const std::vector<std::byte> data = pattern(300000, 1);
  ASSERT_TRUE(file_->write(0, data.data(), data.size()));
  std::vector<std::byte> more(300001);
  const auto short_ = file_->read(0, more.data(), more.size());
  ASSERT_FALSE(short_);
  EXPECT_EQ(short_.error().kind, Error::Kind::Unreadable);
  EXPECT_NE(short_.error().what.find("at byte 300000"), std::string::npos) << short_.error().what;
  EXPECT_FALSE(file_->read(200000, more.data(), 150000));
  EXPECT_FALSE(file_->read(std::uint64_t(1) << 40, more.data(), more.size()));
}

INSTANTIATE_TEST_SUITE_P(
  SpillFile, SpillWays, testing::Values(SpillFile::Way::PastCache, SpillFile::Way::ThroughCache));

TEST(SpillFile, GoesPastTheCacheWhereFilesCan)
{
  const fs::path folder = test::freshFolder("spill-direct");
  const fs::path probe = folder / "probe";
  std::ofstream(probe.string()) << "x";
  const bool possible = DirectAccess::open(probe.string()) != nullptr;
  const auto past = SpillFile::create(folder.string(), 1);
  const auto through = SpillFile::create(folder.string(), 1, SpillFile::Way::ThroughCache);
  ASSERT_TRUE(past && through);
  EXPECT_EQ((*past)->direct(), possible);
  EXPECT_FALSE((*through)->direct());
  EXPECT_EQ(DirectAccess::open((folder / "absent").string()), nullptr);
  fs::remove_all(folder);
}

BuildSize buildSizeOf(std::uint64_t points, std::uint64_t memory)
{
  BuildSize size;
  size.points = points;
  size.largestChunk = 50000;
  size.recordBytes = 20;
  size.sourceBytes = 8;
  size.nodePoints = 16384;
  size.threads = 4;
  size.memoryBytes = memory;
  return size;
}

TEST(BuildMemory, StaysInMemoryWhileItFits)
{
  const auto roomy = planMemory(buildSizeOf(10000000, std::uint64_t(1) << 30));
  ASSERT_TRUE(roomy);
  EXPECT_FALSE(roomy->spill);
  EXPECT_EQ(roomy->threads, 4u);
  const auto tight = planMemory(buildSizeOf(10000000, std::uint64_t(150) << 20));
  ASSERT_TRUE(tight);
  EXPECT_TRUE(tight->spill);
}

TEST(BuildMemory, GivesUpThreadsBeforeItGivesUp)
{
  const auto small = planMemory(buildSizeOf(10000000, std::uint64_t(12) << 20));
  ASSERT_TRUE(small);
  EXPECT_EQ(small->threads, 1u);
  EXPECT_GE(small->partPoints, 4u * 16384);
  const auto none = planMemory(buildSizeOf(10000000, std::uint64_t(1) << 20));
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().kind, Error::Kind::NoMemory);
}

TEST(BuildMemory, ReadsAheadOnlyFromDiskAndOnlyOfWhatIsLeft)
{
  const auto inMemory = planMemory(buildSizeOf(10000000, std::uint64_t(1) << 30));
  ASSERT_TRUE(inMemory);
  EXPECT_EQ(inMemory->partsAhead, 0u);
  const auto roomy = planMemory(buildSizeOf(100000000, std::uint64_t(1) << 30));
  ASSERT_TRUE(roomy);
  ASSERT_TRUE(roomy->spill);
  EXPECT_GE(roomy->partsAhead, roomy->threads);
  const auto least = planMemory(buildSizeOf(10000000, std::uint64_t(12) << 20));
  ASSERT_TRUE(least);
  const std::uint64_t parts = least->partsAhead * least->partPoints * 20;
  EXPECT_LE(parts, std::uint64_t(12) << 20);
}

TEST(BuildMemory, LargeInputsDoNotMeanLargeParts)
{
  const auto plan = planMemory(buildSizeOf(std::uint64_t(1) << 40, std::uint64_t(64) << 30));
  ASSERT_TRUE(plan);
  EXPECT_TRUE(plan->spill);
  EXPECT_LE(plan->partPoints, 1u << 20);
  EXPECT_LE(plan->blockPoints, 1u << 22);
}

} // namespace
} // namespace pointfront
