#include "ThreadReads.h"

#include "PeakMemory.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <sstream>
#include <thread>
#include <vector>

namespace pointfront
{

namespace
{
std::string fileOf(std::size_t bytes)
{
  const std::string path = testing::TempDir() + "read_me";
  std::ofstream(path) << std::string(bytes, 'x');
  return path;
}

std::size_t readWhole(const std::string& path)
{
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str().size();
}

TEST(ThreadReads, CountsWhatThisThreadReads)
{
  const std::string path = fileOf(100000);
  ThreadReads reads;
  ASSERT_TRUE(reads.known());
  EXPECT_EQ(reads.since(), 0u);
  EXPECT_EQ(readWhole(path), 100000u);
  EXPECT_EQ(reads.since(), 100000u);
  EXPECT_EQ(reads.since(), 0u) << "its own look does not count";
  std::thread([&] { readWhole(path); }).join();
  EXPECT_EQ(reads.since(), 0u) << "another thread's do not";
}

TEST(PeakMemory, TellsWhatTheProcessHolds)
{
  const std::uint64_t before = residentBytesNow();
  EXPECT_GT(before, 0u);
  const std::vector<char> block(std::size_t(64) << 20, 1);
  EXPECT_GE(residentBytesNow(), before + (block.size() * 9) / 10);
  EXPECT_GE(peakResidentBytes() + (std::uint64_t(1) << 20), residentBytesNow());
}
} // namespace

} // namespace pointfront
