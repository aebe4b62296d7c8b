#include "pointfront/Disk/FarCache.h"
#include "pointfront/Disk/FarSegment.h"

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace pointfront
{
namespace
{
constexpr std::uint64_t farBytes = 20000000;

class FarCaching : public testing::Test
{
protected:
  FarCaching()
  {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    std::mt19937_64 random(304);
    for (std::size_t at = 0; at < far.size(); at += 8)
    {
      const std::uint64_t value = random();
      std::memcpy(far.data() + at, &value, 8);
    }
  }
  ~FarCaching() override { std::filesystem::remove_all(folder); }

  void keep(const FarCache& cache, std::uint64_t offset, std::size_t size) const
  {
    cache.keep(identity, offset, far.data() + offset, size);
  }
  /// Whether it is there; what is there is right.
  bool has(const FarCache& cache, std::uint64_t offset, std::size_t size) const
  {
    std::vector<std::byte> got(size);
    const bool there = cache.read(identity, offset, size, got.data());
    EXPECT_TRUE(!there || std::memcmp(got.data(), far.data() + offset, size) == 0) << offset;
    return there;
  }
  std::vector<std::string> segments() const
  {
    std::vector<std::string> paths;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder + "/segments"))
    {
      if (entry.is_regular_file())
      {
        paths.push_back(entry.path().string());
      }
    }
    return paths;
  }

  const std::string folder = testing::TempDir() + "/farcache" + std::to_string(::getpid());
  FarIdentity identity{ "https://host/a.pfront", farBytes, "\"tag\"", "a date" };
  std::vector<std::byte> far = std::vector<std::byte>(farBytes);
};
} // namespace

TEST_F(FarCaching, WholeBlocksAreKeptAndNoOthers)
{
  const FarCache cache(folder, std::uint64_t(1) << 30);
  EXPECT_FALSE(has(cache, 5000, 10));
  keep(cache, 5000, 10000); // from 8192 to 12288 are whole
  EXPECT_FALSE(has(cache, 5000, 10));
  EXPECT_TRUE(has(cache, 8192, 4096));
  EXPECT_TRUE(has(cache, 9000, 1));
  EXPECT_FALSE(has(cache, 8192, 4097));
  keep(cache, farBytes - 5000, 5000); // the last block is shorter, and whole
  EXPECT_TRUE(has(cache, farBytes - 100, 100));
  EXPECT_TRUE(has(FarCache(folder, 1 << 30), farBytes - 100, 100)); // another program
}

TEST_F(FarCaching, PartsThatSpanSegmentsAreOneRead)
{
  const FarCache cache(folder, std::uint64_t(1) << 30);
  keep(cache, FarSegment::bytes - 8192, 3 * 8192);
  EXPECT_TRUE(has(cache, FarSegment::bytes - 8000, 16000));
  EXPECT_EQ(segments().size(), 2u);
}

TEST_F(FarCaching, AnotherStateOfTheFileHasNothingOfIt)
{
  const FarCache cache(folder, std::uint64_t(1) << 30);
  keep(cache, 0, 8192);
  std::byte out[16];
  for (FarIdentity other : { FarIdentity{ identity.place, farBytes, "\"new\"", "a date" },
         FarIdentity{ identity.place, farBytes + 1, "\"tag\"", "a date" },
         FarIdentity{ identity.place, farBytes, "\"tag\"", "later" },
         FarIdentity{ "https://other/a.pfront", farBytes, "\"tag\"", "a date" } })
  {
    EXPECT_FALSE(cache.read(other, 0, 16, out));
  }
  FarIdentity nameless{ identity.place, farBytes, "W/\"weak\"", "" };
  cache.keep(nameless, 0, far.data(), 8192);
  EXPECT_FALSE(cache.read(nameless, 0, 16, out)); // nobody could tell whether it is the same
}

TEST_F(FarCaching, EveryFlippedBitIsSeen)
{
  const FarCache cache(folder, std::uint64_t(1) << 30);
  keep(cache, 0, 3 * 4096);
  const std::string path = segments().front();
  std::mt19937 random(1);
  const auto size = static_cast<std::size_t>(std::filesystem::file_size(path));
  for (int round = 0; round < 300; ++round)
  {
    const std::size_t at = round % 2 == 0 ? random() % size : size - 1 - random() % (3 * 4096);
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(static_cast<std::streamoff>(at));
    const char before = static_cast<char>(file.get());
    file.seekp(static_cast<std::streamoff>(at));
    file.put(static_cast<char>(before ^ (1 << random() % 8)));
    file.close();
    has(cache, 0, 3 * 4096); // right, or not there
    file.open(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(at));
    file.put(before);
  }
  EXPECT_TRUE(has(cache, 0, 3 * 4096));
  std::filesystem::resize_file(path, size - 1);
  EXPECT_FALSE(has(cache, 0, 3 * 4096));
  EXPECT_TRUE(has(cache, 0, 2 * 4096));
  const FarCache::Report report = cache.verify();
  EXPECT_EQ(report.damaged, 1u);
  EXPECT_EQ(report.segments, 0u);
  keep(cache, 0, 3 * 4096);
  EXPECT_TRUE(has(cache, 0, 3 * 4096));
  EXPECT_EQ(cache.verify().damaged, 0u);
}

TEST_F(FarCaching, TheLimitHoldsAndTheLastUsedStay)
{
  const std::uint64_t limit = std::uint64_t(4) << 20;
  const FarCache cache(folder, limit);
  for (std::uint64_t file = 0; file < 40; ++file)
  {
    identity.place = "https://host/" + std::to_string(file);
    keep(cache, 0, 256 << 10);
    EXPECT_LE(cache.report().bytes, limit + (1 << 20)) << file;
  }
  EXPECT_TRUE(has(cache, 0, 4096));
  identity.place = "https://host/0";
  EXPECT_FALSE(has(cache, 0, 4096));
  ASSERT_TRUE(cache.clear());
  EXPECT_EQ(cache.report().bytes, 0u);
}

TEST_F(FarCaching, FilesOfOthersStay)
{
  // As who names a folder for the cache may have them there.
  std::vector<std::string> others;
  for (const char* const name : { "segments/trees.las", "segments/ab/abc-1", "places/roads.shp",
         "places/0123456789abcdef0123456789abcdef.txt", "segments/ab/notes/7" })
  {
    others.push_back(folder + '/' + name);
    std::filesystem::create_directories(std::filesystem::path(others.back()).parent_path());
    std::ofstream(others.back()) << "mine";
  }
  const FarCache cache(folder, 1 << 20);
  keep(cache, 0, 8 << 20);
  cache.note(identity);
  EXPECT_EQ(cache.verify().damaged, 0);
  cache.tidy();
  ASSERT_TRUE(cache.clear());
  EXPECT_FALSE(has(cache, 0, 1 << 16));
  EXPECT_FALSE(cache.last(identity.place));
  for (const std::string& file : others)
  {
    EXPECT_TRUE(std::filesystem::exists(file)) << file;
  }
  EXPECT_EQ(cache.report().segments, 0);
}

TEST_F(FarCaching, ADiskThatRefusesIsNoError)
{
  std::ofstream(folder + "/segments") << "a file where the folder should be";
  const FarCache cache(folder, std::uint64_t(1) << 30);
  keep(cache, 0, 8192);
  EXPECT_FALSE(has(cache, 0, 8192));
}

TEST_F(FarCaching, TheLastStateIsKnownOffline)
{
  const FarCache cache(folder, std::uint64_t(1) << 30);
  EXPECT_FALSE(cache.last(identity.place));
  cache.note(identity);
  ASSERT_TRUE(cache.last(identity.place));
  EXPECT_EQ(cache.last(identity.place)->text(), identity.text());
  EXPECT_EQ(cache.last(identity.place)->lastsUntil, 0);
}

TEST_F(FarCaching, APromiseIsKeptUntilItIsTakenBack)
{
  const FarCache cache(folder, std::uint64_t(1) << 30);
  identity.lastsUntil = 4102444800;
  cache.note(identity);
  ASSERT_TRUE(cache.last(identity.place));
  EXPECT_EQ(cache.last(identity.place)->text(), identity.text());
  EXPECT_EQ(cache.last(identity.place)->lastsUntil, identity.lastsUntil);
  keep(cache, 0, 8192);
  identity.lastsUntil = 0; // the same bytes, whoever promised them
  EXPECT_TRUE(has(cache, 0, 8192));
  cache.note(identity.withoutPromise());
  EXPECT_EQ(cache.last(identity.place)->lastsUntil, 0);
}

TEST_F(FarCaching, ThreadsThatBeginASegmentTogetherLoseNoBlock)
{
  constexpr int threads = 4;
  constexpr std::uint64_t block = FarSegment::blockBytes;
  const FarCache cache(folder, std::uint64_t(1) << 30);
  int lost = 0;
  for (int round = 0; round < 300; ++round)
  {
    identity.tag = '"' + std::to_string(round) + '"';
    std::atomic<int> ready{ 0 };
    std::vector<std::thread> writers;
    for (int i = 0; i < threads; ++i)
    {
      writers.emplace_back(
        [&, i]
        {
          ++ready;
          while (ready < threads) // the kernel starts threads one by one
          {
            std::this_thread::yield();
          }
          keep(cache, i * block, block);
        });
    }
    for (std::thread& writer : writers)
    {
      writer.join();
    }
    for (int i = 0; i < threads; ++i)
    {
      lost += has(cache, i * block, block) ? 0 : 1;
    }
  }
  EXPECT_EQ(lost, 0);
}

TEST_F(FarCaching, ProcessesThatAreKilledLeaveNoWrongByte)
{
  std::mt19937 random(7);
  for (int round = 0; round < 12; ++round)
  {
    std::vector<::pid_t> writers;
    for (unsigned child = 0; child < 2; ++child)
    {
      const ::pid_t process = ::fork();
      if (process == 0)
      {
        const FarCache cache(folder, std::uint64_t(64) << 20);
        std::mt19937 own(static_cast<unsigned>(round) * 2 + child);
        for (;;)
        {
          const std::uint64_t offset = own() % (farBytes - 200000);
          keep(cache, offset, own() % 200000);
        }
      }
      writers.push_back(process);
    }
    const FarCache cache(folder, std::uint64_t(64) << 20);
    for (int i = 0; i < 300; ++i)
    {
      has(cache, random() % (farBytes - 50000), 1 + random() % 50000);
    }
    ::usleep(static_cast<::useconds_t>(random() % 5000));
    for (const ::pid_t process : writers)
    {
      ::kill(process, SIGKILL);
      ::waitpid(process, nullptr, 0);
    }
  }
  const FarCache cache(folder, std::uint64_t(64) << 20);
  std::size_t there = 0;
  for (std::uint64_t block = 0; block < farBytes / 4096; ++block)
  {
    there += has(cache, block * 4096, 4096) ? 1 : 0;
  }
  EXPECT_GT(there, 0u);
}

} // namespace pointfront
