#include "pointfront/Threads/ThreadCrew.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

using namespace pointfront;

TEST(ThreadCrew, EachPieceIsDoneOnce)
{
  for (const unsigned threads : { 0u, 1u, 2u, 7u })
  {
    ThreadCrew crew(threads);
    for (const std::size_t pieces : { std::size_t(0), std::size_t(1), std::size_t(1000) })
    {
      std::vector<std::atomic<int>> done(pieces);
      std::atomic<bool> outside{ false };
      crew.run(pieces,
        [&](std::size_t piece, unsigned thread)
        {
          ++done[piece];
          outside = outside || thread >= crew.threads();
        });
      EXPECT_FALSE(outside);
      for (const std::atomic<int>& times : done)
      {
        EXPECT_EQ(times, 1);
      }
    }
  }
}

TEST(ThreadCrew, FewerThreadsTakePartIfAskedFor)
{
  ThreadCrew crew(5);
  std::atomic<unsigned> highest{ 0 };
  crew.run(
    1000,
    [&](std::size_t, unsigned thread)
    {
      unsigned known = highest;
      while (thread > known && !highest.compare_exchange_weak(known, thread))
      {
      }
    },
    2);
  EXPECT_LT(highest, 2u);
}

TEST(ThreadCrew, AnExceptionComesOutAndTheCrewGoesOn)
{
  ThreadCrew crew(3);
  for (int round = 0; round < 20; ++round)
  {
    EXPECT_THROW(crew.run(100,
                   [](std::size_t piece, unsigned)
                   {
                     if (piece == 37)
                     {
                       throw std::runtime_error("piece 37");
                     }
                   }),
      std::runtime_error);
    std::atomic<int> done{ 0 };
    crew.run(50, [&](std::size_t, unsigned) { ++done; });
    EXPECT_EQ(done, 50);
  }
}

#if !defined(__SANITIZE_THREAD__) // which ends a child of fork() that starts threads
TEST(ThreadCrew, AChildOfForkHasACrewOfItsOwn)
{
  const auto sum = []
  {
    std::atomic<std::size_t> total{ 0 };
    ThreadCrew::ofProcess().run(100, [&](std::size_t piece, unsigned) { total += piece; });
    return total.load();
  };
  EXPECT_EQ(sum(), 4950u);
  const ::pid_t child = ::fork();
  if (child == 0)
  {
    ::alarm(20); // ends a child that waits for threads which are not there
    ::_exit(sum() == 4950u ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(sum(), 4950u);
}
#endif
