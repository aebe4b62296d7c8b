#pragma once

#include "Sanitizers.h"

namespace pointfront::test
{

/// How often a test with random input repeats itself: `count` times, under a sanitizer a tenth of
/// it. Optimised builds check each answer; sanitizers look at how the same code comes to it.
inline int randomRounds(int count)
{
  return underSanitizer() ? count / 10 : count;
}

} // namespace pointfront::test
