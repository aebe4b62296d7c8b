#include "StackGuard.h"

#include <gtest/gtest.h>

#include <thread>

namespace pointfront
{
namespace
{
/// Calls itself `depth` times; no compiler makes a loop of it.
std::size_t deep(std::size_t depth, volatile std::size_t* calls)
{
  *calls = *calls + 1;
  return depth == 0 ? 0 : deep(depth - 1, calls) + *calls;
}

void overflowTwice()
{
  for (int i = 0; i < 2; ++i)
  {
    volatile std::size_t calls = 0;
    EXPECT_FALSE(runWithinStack([&] { deep(std::size_t(1) << 40, &calls); }));
    EXPECT_GT(calls, 1000u);
    calls = 0;
    EXPECT_TRUE(runWithinStack([&] { deep(1000, &calls); }));
    EXPECT_EQ(calls, 1001u);
  }
}
} // namespace

TEST(StackGuard, RecursionWithoutEndIsLeftOnEveryThread)
{
  overflowTwice();
  std::thread(overflowTwice).join();
  std::thread one(overflowTwice), other(overflowTwice);
  one.join();
  other.join();
}

TEST(StackGuard, OtherFaultsEndTheProcess)
{
  EXPECT_DEATH(runWithinStack(
                 []
                 {
                   volatile int* nowhere = nullptr;
                   *nowhere = 1;
                 }),
    "");
}
} // namespace pointfront
