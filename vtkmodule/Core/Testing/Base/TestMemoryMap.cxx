#include "pointfront/Base/MemoryMap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <numeric>
#include <string>
#include <unistd.h>

namespace pointfront
{
namespace
{
constexpr std::size_t fileBytes = 64u << 20;

std::string sampleFile()
{
  const std::string path =
    testing::TempDir() + "pointfront_map_" + std::to_string(::getpid()) + ".bin";
  std::ofstream file(path, std::ios::binary);
  std::string block(1u << 20, '\0');
  for (std::size_t i = 0; i < fileBytes / block.size(); ++i)
  {
    std::fill(block.begin(), block.end(), static_cast<char>(i + 1));
    file.write(block.data(), static_cast<std::streamsize>(block.size()));
  }
  return path;
}

/// Pages of files that this process has mapped and touched (statm's third number), in bytes.
std::size_t sharedBytes()
{
  std::ifstream statm("/proc/self/statm");
  std::size_t size = 0;
  std::size_t resident = 0;
  std::size_t shared = 0;
  statm >> size >> resident >> shared;
  return shared * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

unsigned long sumOf(const MemoryMap& map)
{
  return std::accumulate(map.data(), map.data() + map.size(), 0ul,
    [](unsigned long sum, std::byte b) { return sum + static_cast<unsigned long>(b); });
}
} // namespace

TEST(MemoryMap, ReleasedPagesNoLongerCountAndStayReadable)
{
  const std::string path = sampleFile();
  const auto map = MemoryMap::open(path);
  ASSERT_TRUE(map.ok());
  const std::size_t before = sharedBytes();
  const unsigned long sum = sumOf(*map);
  const std::size_t touched = sharedBytes();
  ASSERT_GT(touched, before + fileBytes / 2) << "the kernel did not count the touched pages";
  map->release(1000, fileBytes - 2000);
  EXPECT_LT(sharedBytes(), touched - fileBytes / 2);
  EXPECT_EQ(sumOf(*map), sum);
  map->release(0, 0);
  ::unlink(path.c_str());
}

TEST(MemoryMap, PiecesThatAreReadAndReleasedOneByOneLeaveNothing)
{
  const std::string path = sampleFile();
  const auto map = MemoryMap::open(path);
  ASSERT_TRUE(map.ok());
  const std::size_t before = sharedBytes();
  const std::size_t piece = 300001;
  unsigned long sum = 0;
  for (std::size_t begin = 0; begin < fileBytes; begin += piece)
  {
    const std::size_t bytes = std::min(piece, fileBytes - begin);
    sum = std::accumulate(map->data() + begin, map->data() + begin + bytes, sum,
      [](unsigned long s, std::byte b) { return s + static_cast<unsigned long>(b); });
    map->release(begin, bytes);
  }
  EXPECT_GT(sum, 0u);
  EXPECT_LT(sharedBytes(), before + (1u << 20)); // 224 borders of 64 KiB would be 14 MiB
  ::unlink(path.c_str());
}

TEST(MemoryMap, SaysWhatIsWrong)
{
  EXPECT_EQ(MemoryMap::open("no/such/file").error().kind, Error::Kind::NotFound);
  EXPECT_EQ(MemoryMap::open(testing::TempDir()).error().kind, Error::Kind::Unreadable);
}

TEST(MemoryMap, AFileThatOthersShortenIsToldAndReadsAsZero)
{
  const std::string path = sampleFile();
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  for (const std::size_t left : { fileBytes / 2, page, std::size_t(0), fileBytes - 100 })
  {
    ASSERT_EQ(::truncate(path.c_str(), static_cast<off_t>(fileBytes)), 0);
    const auto map = MemoryMap::open(path);
    ASSERT_TRUE(map.ok());
    EXPECT_TRUE(map->checkWhole());
    ASSERT_EQ(::truncate(path.c_str(), static_cast<off_t>(left)), 0);
    EXPECT_EQ(map->data()[fileBytes - 1], std::byte(0));
    const Result<void> done = map->checkWhole();
    ASSERT_FALSE(done) << left;
    EXPECT_EQ(done.error().kind, Error::Kind::Truncated);
    EXPECT_NE(done.error().what.find(path), std::string::npos);
    EXPECT_EQ(
      map->checkWhole(makeError(Error::Kind::BadFormat, "x")).error().kind, Error::Kind::Truncated);
  }
  std::remove(path.c_str());
}

TEST(MemoryMap, OtherBusErrorsEndTheProcess)
{
  const std::string path = sampleFile();
  const auto watched = MemoryMap::open(path);
  ASSERT_TRUE(watched.ok());
  EXPECT_EXIT(
    {
      std::signal(SIGABRT, SIG_DFL);
      ::raise(SIGBUS);
      ::raise(SIGBUS); // the first gives the signal back its usual meaning
    },
    testing::KilledBySignal(SIGBUS), "");
  std::remove(path.c_str());
}

TEST(MemoryMap, OfBytesIsThoseBytes)
{
  const std::byte bytes[3] = { std::byte(1), std::byte(2), std::byte(3) };
  MemoryMap map = MemoryMap::ofBytes("x", bytes, 3);
  MemoryMap moved = std::move(map);
  EXPECT_EQ(moved.data(), bytes);
  EXPECT_EQ(moved.size(), 3u);
  moved.release(0, 3);
  EXPECT_TRUE(moved.checkWhole());
}

} // namespace pointfront
