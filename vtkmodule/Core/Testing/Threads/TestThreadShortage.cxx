// Work goes on where the system gives no thread, or no memory.

#include "pointfront/Residency/LoadScheduler.h"
#include "pointfront/Residency/Residency.h"
#include "pointfront/Table/ParallelChunks.h"
#include "pointfront/Threads/ThreadCrew.h"
#include "pointfront/Threads/WorkCrew.h"

#include "MadeUpReader.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <string>
#include <thread>

#include <sys/resource.h>

using namespace pointfront;

namespace
{
/// Limits this process from now on: no address space for the stack of a further thread (8 MiB),
/// some for all else.
bool takeThreadsAway()
{
  std::FILE* const file = std::fopen("/proc/self/statm", "r");
  unsigned long pages = 0;
  const bool known = file != nullptr && std::fscanf(file, "%lu", &pages) == 1;
  if (file != nullptr)
  {
    std::fclose(file);
  }
  const rlim_t bytes = (rlim_t(pages) << 12) + (rlim_t(6) << 20);
  const rlimit limit{ bytes, bytes };
  return known && setrlimit(RLIMIT_AS, &limit) == 0;
}

void endWith(bool done)
{
  std::_Exit(done ? 0 : 1);
}
} // namespace

TEST(ThreadShortageDeathTest, ABuildsCrewWorksWithTheThreadsThatThereAre)
{
  EXPECT_EXIT(
    {
      bool done = takeThreadsAway();
      WorkCrew crew(4, {});
      std::atomic<int> left{ 10 };
      const Result<void> outcome = crew.run(
        [&]() -> Result<void>
        {
          while (left > 0)
          {
            --left;
          }
          return {};
        });
      endWith(done && outcome.ok() && left == 0);
    },
    ::testing::ExitedWithCode(0), "");
}

TEST(ThreadShortageDeathTest, ChunksAreLookedThroughByTheCaller)
{
  EXPECT_EXIT(
    {
      bool done = takeThreadsAway();
      SurveyOptions options;
      options.threads = 4;
      int seen = 0;
      const Result<void> outcome = forEachChunk(100, options,
        [&](std::uint64_t) -> Result<void>
        {
          ++seen;
          return {};
        });
      endWith(done && outcome.ok() && seen == 100);
    },
    ::testing::ExitedWithCode(0), "");
}

TEST(ThreadShortageDeathTest, NodesAreLoadedByWhoAsksForThem)
{
  EXPECT_EXIT(
    {
      bool done = takeThreadsAway();
      const auto scheduler = std::make_shared<LoadScheduler>(LoadSchedulerOptions());
      Residency residency(std::make_shared<test::MadeUpReader>(), 100, scheduler, 100);
      residency.request({ { 3, 1.0, false }, { 4, 0.5, false } });
      residency.waitUntilIdle();
      endWith(done && residency.find(3) && residency.find(4));
    },
    ::testing::ExitedWithCode(0), "");
}

namespace
{
/// Has no memory for the loader's first calls.
class Starved final : public NodeReader
{
public:
  Result<FetchedNode> fetch(NodeIndex node, const ColumnSelection& columns) const override
  {
    return reader_.fetch(node, columns);
  }
  Result<NodeColumns> decode(const FetchedNode& fetched) const override
  {
    return reader_.decode(fetched);
  }
  std::size_t decodedBytes(
    NodeIndex node, std::uint32_t points, const ColumnSelection& columns) const override
  {
    if (std::this_thread::get_id() != caller_ && failures_++ < 3)
    {
      throw std::bad_alloc();
    }
    return reader_.decodedBytes(node, points, columns);
  }
  std::size_t storedBytes(NodeIndex node, const ColumnSelection& columns) const override
  {
    return reader_.storedBytes(node, columns);
  }

private:
  test::MadeUpReader reader_;
  const std::thread::id caller_ = std::this_thread::get_id();
  mutable std::atomic<int> failures_{ 0 };
};
} // namespace

TEST(ThreadShortage, ALoaderThatRunsOutOfMemoryGoesOnWhenThereIsSome)
{
  LoadSchedulerOptions options;
  options.threads = 2;
  const auto scheduler = std::make_shared<LoadScheduler>(options);
  Residency residency(std::make_shared<Starved>(), 100, scheduler, 100);
  residency.request({ { 3, 1.0, false } });
  residency.waitForArrival(0, std::chrono::seconds(30));
  EXPECT_TRUE(residency.find(3));
}

TEST(ThreadShortage, WorkThatRunsOutOfMemoryIsAnError)
{
  WorkCrew crew(3, {});
  const Result<void> outcome = crew.run([]() -> Result<void> { throw std::bad_alloc(); });
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().kind, Error::Kind::NoMemory);
}

TEST(ThreadShortage, APieceMayGiveWorkToTheCrewThatItIsOf)
{
  ThreadCrew crew(3);
  std::atomic<int> done{ 0 };
  std::atomic<bool> outside{ false };
  crew.run(8,
    [&](std::size_t, unsigned thread)
    {
      crew.run(5,
        [&](std::size_t, unsigned inner)
        {
          ++done;
          outside = outside || inner != thread;
        });
    });
  EXPECT_EQ(done, 40);
  EXPECT_FALSE(outside) << "what belongs to a thread is that of the piece around it";
}
