#include "SharedSums.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

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

void sharePicture(PictureExchange& others, SoftwareTarget& target)
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  constexpr std::uint32_t colourOf = 0x00ffffffu; // 24 bits, which a float holds
  const std::size_t count = target.depth.size();
  std::vector<float>& deciding = target.keepDecided ? target.decided : target.depth;
  std::vector<float> mine = deciding;
  if (!others.nearest(deciding.data(), count))
  {
    return;
  }
  // Of those that are nearest the depth, and of those that have it the colour: where processes are
  // alike in both, so is the pixel.
  std::vector<float> colours(count, infinity);
  for (std::size_t pixel = 0; pixel < count; ++pixel)
  {
    const bool shown = mine[pixel] == deciding[pixel] && mine[pixel] != infinity;
    mine[pixel] = shown ? target.depth[pixel] : infinity;
    colours[pixel] = shown ? static_cast<float>(target.rgba[pixel] & colourOf) : infinity;
  }
  if (target.keepDecided)
  {
    const std::vector<float> depths = mine;
    others.nearest(mine.data(), count);
    for (std::size_t pixel = 0; pixel < count; ++pixel)
    {
      colours[pixel] = depths[pixel] == mine[pixel] ? colours[pixel] : infinity;
    }
    target.depth = std::move(mine);
  }
  const std::vector<float> own = colours;
  others.nearest(colours.data(), count);
  std::vector<float> looks(target.looks.empty() ? 0 : count, infinity);
  for (std::size_t pixel = 0; pixel < looks.size(); ++pixel)
  {
    const bool shown = own[pixel] == colours[pixel] && own[pixel] != infinity;
    looks[pixel] = shown ? static_cast<float>(target.looks[pixel]) : infinity;
  }
  if (!looks.empty())
  {
    others.nearest(looks.data(), count);
  }
  for (std::size_t pixel = 0; pixel < looks.size(); ++pixel)
  {
    const bool none = looks[pixel] == infinity;
    target.looks[pixel] = static_cast<std::uint16_t>(none ? 0.0f : looks[pixel]);
  }
  for (std::size_t pixel = 0; pixel < count; ++pixel)
  {
    target.rgba[pixel] = colours[pixel] == infinity
      ? 0u
      : (static_cast<std::uint32_t>(colours[pixel]) & colourOf) | ~colourOf;
  }
}

} // namespace pointfront
