#include "TestBuildClouds.h"

#include "pointfront/Records/WriteBehind.h"

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>

namespace pointfront
{
namespace
{
namespace fs = std::filesystem;

constexpr std::size_t recordBytes = 21;

/// Records that tell where they belong.
void fill(WriteBehind::Buffer& buffer, std::uint64_t first, std::uint64_t count)
{
  for (std::uint64_t i = 0; i < count; ++i)
  {
    const std::uint64_t number = first + i;
    std::memset(buffer.data() + i * recordBytes, int(number % 251), recordBytes);
    std::memcpy(buffer.data() + i * recordBytes, &number, sizeof(number));
  }
}

/// Blocks of a pool, taken in turn by some threads.
struct Blocks
{
  static constexpr std::uint64_t blocks = 60;
  static constexpr std::uint64_t most = 9000; // 189 KB

  static std::uint64_t countOf(std::uint64_t block) { return most - 137 * block; }
  static std::uint64_t total()
  {
    std::uint64_t sum = 0;
    for (std::uint64_t block = 0; block < blocks; ++block)
    {
      sum += countOf(block);
    }
    return sum;
  }

  /// How many could not be written.
  int writeBy(unsigned threads, WriteBehind& behind)
  {
    std::atomic<int> failed{ 0 };
    std::mutex mutex;
    std::uint64_t next = 0;
    std::uint64_t first = 0;
    const auto work = [&]
    {
      for (;;)
      {
        std::unique_lock<std::mutex> lock(mutex);
        if (next == blocks)
        {
          return;
        }
        const std::uint64_t count = countOf(next++);
        const std::uint64_t begin = std::exchange(first, first + count);
        lock.unlock();
        auto buffer = behind.buffer(count * recordBytes);
        if (!buffer)
        {
          ++failed;
          continue;
        }
        fill(*buffer, begin, count);
        behind.write(begin, count, std::move(*buffer));
      }
    };
    std::vector<std::thread> crew;
    for (unsigned i = 0; i < threads; ++i)
    {
      crew.emplace_back(work);
    }
    for (std::thread& thread : crew)
    {
      thread.join();
    }
    return failed;
  }
};

TEST(WriteBehind, WritesAllBlocksWhateverTheirThreadsAndBuffers)
{
  const fs::path folder = test::freshFolder("write-behind");
  for (const auto& [threads, buffers] : { std::pair(1u, 1u), { 2u, 2u }, { 4u, 1u }, { 3u, 8u } })
  {
    auto pool = RecordPool::spilled(folder.string(), Blocks::total(), recordBytes);
    ASSERT_TRUE(pool);
    {
      WriteBehind behind(**pool, buffers);
      EXPECT_EQ(Blocks().writeBy(threads, behind), 0);
      EXPECT_TRUE(behind.finish());
      EXPECT_GE(behind.seconds(), 0.0);
    }
    WriteBehind::Buffer wanted(Blocks::total() * recordBytes);
    WriteBehind::Buffer written(wanted.size());
    fill(wanted, 0, Blocks::total());
    ASSERT_TRUE((*pool)->read(0, Blocks::total(), written.data()));
    EXPECT_EQ(written, wanted) << threads << " " << buffers;
  }
  fs::remove_all(folder);
}

/// The buffers that a cancelled build handed over are written, and nobody waits for them for ever.
TEST(WriteBehind, EndsWithoutFinish)
{
  const fs::path folder = test::freshFolder("write-behind-end");
  auto pool = RecordPool::spilled(folder.string(), Blocks::total(), recordBytes);
  ASSERT_TRUE(pool);
  {
    WriteBehind behind(**pool, 2);
    auto buffer = behind.buffer(100 * recordBytes);
    ASSERT_TRUE(buffer);
    EXPECT_GE(buffer->size(), 100 * recordBytes);
    fill(*buffer, 0, 100);
    behind.write(0, 100, std::move(*buffer));
  }
  WriteBehind::Buffer last(recordBytes);
  WriteBehind::Buffer wanted(recordBytes);
  fill(wanted, 99, 1);
  ASSERT_TRUE((*pool)->read(99, 1, last.data()));
  EXPECT_EQ(last, wanted);
  fs::remove_all(folder);
}

TEST(WriteBehind, AFullDiskIsTheErrorOfAllThatFollows)
{
  const fs::path folder = test::freshFolder("write-behind-full");
  const pid_t child = fork();
  if (child == 0)
  {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{ 1000000, 1000000 };
    setrlimit(RLIMIT_FSIZE, &limit);
    auto pool = RecordPool::spilled(folder.string(), Blocks::total(), recordBytes);
    if (!pool)
    {
      _exit(1);
    }
    WriteBehind behind(**pool, 2);
    const int failed = Blocks().writeBy(2, behind);
    const Result<void> done = behind.finish();
    if (failed < 20 || done || behind.buffer(1))
    {
      _exit(2);
    }
    _exit(done.error().what.find("; it needs ") == std::string::npos ? 3 : 0);
  }
  int status = -1;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  fs::remove_all(folder);
}

} // namespace
} // namespace pointfront
