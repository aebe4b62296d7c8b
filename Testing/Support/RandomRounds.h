#pragma once

namespace pointfront::test
{

/// How often a test with random input repeats itself: `count` times, under a sanitizer a tenth of
/// it. Optimised builds check each answer; sanitizers look at how the same code comes to it.
constexpr int randomRounds(int count)
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return count / 10;
#else
  return count;
#endif
}

} // namespace pointfront::test
