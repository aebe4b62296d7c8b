#include "SharedSums.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

namespace pointfront
{

bool shareDepths(PictureExchange& others, float* depths, std::int64_t count)
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  std::replace(depths, depths + count, -infinity, infinity);
  const bool agreed = others.nearest(depths, static_cast<std::size_t>(count));
  std::replace(depths, depths + count, infinity, -infinity);
  return agreed;
}

void shareSums(PictureExchange& others, std::vector<ThreadBuffers>& threads, std::int64_t count)
{
  std::uint32_t* const all = threads[0].sums.ofSize(count);
  if (!std::exchange(threads[0].sumsDrawn, true))
  {
    std::fill(all, all + count, 0u);
  }
  for (std::size_t thread = 1; thread < threads.size(); ++thread)
  {
    if (std::exchange(threads[thread].sumsDrawn, false))
    {
      const std::uint32_t* const sums = threads[thread].sums.data();
      std::transform(all, all + count, sums, all, std::plus<std::uint32_t>());
    }
  }
  others.sum(all, static_cast<std::size_t>(count));
}

} // namespace pointfront
