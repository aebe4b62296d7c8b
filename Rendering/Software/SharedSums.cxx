#include "SharedSums.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace pointfront
{
namespace
{

/// Numbers of pixels, of processes that show what is nearest there.
template <typename Number, typename Shown>
void shareNumbers(PictureExchange& others, PictureValues<Number>& numbers, const Shown& shown)
{
  constexpr float none = std::numeric_limits<float>::infinity();
  if (numbers.empty())
  {
    return;
  }
  PictureValues<float> least(numbers.size(), none);
  for (std::size_t pixel = 0; pixel < numbers.size(); ++pixel)
  {
    least[pixel] = shown(pixel) ? static_cast<float>(numbers[pixel]) : none;
  }
  others.nearest(least.data(), least.size());
  for (std::size_t pixel = 0; pixel < numbers.size(); ++pixel)
  {
    numbers[pixel] = static_cast<Number>(least[pixel] == none ? 0.0f : least[pixel]);
  }
}

} // namespace

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
  PictureValues<float>& deciding = target.keepDecided ? target.decided : target.depth;
  PictureValues<float> mine = deciding;
  if (!others.nearest(deciding.data(), count))
  {
    return;
  }
  // The nearest have the depth, and among those that have it the least colour: where processes are
  // alike in both, so is the pixel.
  PictureValues<float> colours(count, infinity);
  for (std::size_t pixel = 0; pixel < count; ++pixel)
  {
    const bool shown = mine[pixel] == deciding[pixel] && mine[pixel] != infinity;
    mine[pixel] = shown ? target.depth[pixel] : infinity;
    colours[pixel] = shown ? static_cast<float>(target.rgba[pixel] & colourOf) : infinity;
  }
  if (target.keepDecided)
  {
    const PictureValues<float> depths = mine;
    others.nearest(mine.data(), count);
    for (std::size_t pixel = 0; pixel < count; ++pixel)
    {
      colours[pixel] = depths[pixel] == mine[pixel] ? colours[pixel] : infinity;
    }
    target.depth = std::move(mine);
  }
  const PictureValues<float> own = colours;
  others.nearest(colours.data(), count);
  const auto shown = [&](std::size_t pixel)
  { return own[pixel] == colours[pixel] && own[pixel] != infinity; };
  shareNumbers(others, target.looks, shown);
  shareNumbers(others, target.highlights, shown);
  for (std::size_t pixel = 0; pixel < count; ++pixel)
  {
    target.rgba[pixel] = colours[pixel] == infinity
      ? 0u
      : (static_cast<std::uint32_t>(colours[pixel]) & colourOf) | ~colourOf;
  }
}

} // namespace pointfront
