// In the steady state an update allocates nothing: counted at operator new of the whole program.

#include "pointfront/Front/RenderFront.h"

#include "FrontScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <new>

namespace
{

std::atomic<std::size_t> allocations{ 0 };

void* counted(std::size_t bytes)
{
  ++allocations;
  if (void* memory = std::malloc(bytes > 0 ? bytes : 1))
  {
    return memory;
  }
  throw std::bad_alloc();
}

} // namespace

// Never inlined: a compiler that sees free() behind a delete takes it for a mistake. The one that
// does not throw is replaced too: AddressSanitizer has its own, and would pair it with our delete.
[[gnu::noinline]] void* operator new(std::size_t bytes) { return counted(bytes); }
[[gnu::noinline]] void* operator new[](std::size_t bytes) { return counted(bytes); }
[[gnu::noinline]] void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept
{
  ++allocations;
  return std::malloc(bytes > 0 ? bytes : 1);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete[](void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace pointfront
{

TEST(RenderFront, AllocatesNothingInTheSteadyState)
{
  for (const Refinement refinement : { Refinement::Add, Refinement::Replace })
  {
    testing::TreeShape shape;
    shape.refinement = refinement;
    RenderFront front(testing::randomTree(shape));
    testing::ScriptedResidency residency;
    residency.otherwise = ResidencyView::State::Resident;
    FrontLimits limits;
    limits.targetErrorPx = 2.0;
    limits.pointBudget = 100000;
    const auto fly = [&](int updates)
    {
      std::uint32_t longest = 0;
      for (int u = 0; u < updates; ++u)
      {
        // To and fro: the front moves all the time, over the same ground.
        const double x = 1000.0 + 4.0 * std::abs(u % 100 - 50);
        const View view = View::perspective(
          { x, 300, 200 }, { 0, 0, 0 }, { 0, 0, 1 }, 0.9, 0.1, 1e5, 800, 600);
        longest = std::max(longest, front.update(view, residency, limits).frontLength);
      }
      return longest;
    };
    fly(300);
    const std::size_t before = allocations;
    const std::uint32_t longest = fly(300);
    EXPECT_EQ(allocations, before);
    EXPECT_GT(longest, 100u);
    EXPECT_GT(before, 0u) << "the counter is in place";
  }
}

} // namespace pointfront
