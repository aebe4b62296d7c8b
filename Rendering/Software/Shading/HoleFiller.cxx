#include "HoleFiller.h"

#include "pointfront/Threads/ThreadCrew.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

namespace pointfront
{
namespace
{

constexpr float nothing = std::numeric_limits<float>::infinity();
/// Holes of up to 2^levels pixels.
constexpr int levels = 3;
static_assert(holeFillerReach == 1 << levels, "a coarsest pixel");
/// Parts of 16 of bilinear weight that have to agree.
constexpr std::uint32_t leastParts = 10;

/// Cells count from the viewport's corner, wherever the picture begins: what fills a hole does not
/// depend on how much of the viewport is drawn.
struct Level
{
  int left = 0; ///< column of the first cell
  int bottom = 0;
  int width = 0;
  int height = 0;
  PictureValues<float> depth;
  PictureValues<std::uint32_t> rgba;
  PictureValues<std::uint8_t> highlights; ///< empty: nothing stands out
  PictureValues<std::uint16_t> looks; ///< empty: all have one

  std::size_t at(int x, int y) const
  {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
      static_cast<std::size_t>(x);
  }
};

using Channels = std::array<std::uint32_t, 3>;

void add(Channels& sum, std::uint32_t rgba, std::uint32_t weight)
{
  std::uint8_t bytes[4];
  std::memcpy(bytes, &rgba, 4);
  for (std::size_t c = 0; c < 3; ++c)
  {
    sum[c] += weight * bytes[c];
  }
}

std::uint32_t mean(const Channels& sum, std::uint32_t weight)
{
  std::uint8_t bytes[4] = { 0, 0, 0, 255 };
  for (std::size_t c = 0; c < 3; ++c)
  {
    bytes[c] = static_cast<std::uint8_t>((sum[c] + weight / 2) / weight);
  }
  std::uint32_t rgba;
  std::memcpy(&rgba, bytes, 4);
  return rgba;
}

/// How far two depths may differ at a level. What reaches behind the eye has a depth below 0.
struct Agreement
{
  float perDepth = 0.0f;
  float always = 0.0f;
  float at(float depth, int factor) const
  {
    return depth + (perDepth * std::abs(depth) + always) * static_cast<float>(factor);
  }
};

void eachRow(int rows, const std::function<void(int)>& work)
{
  ThreadCrew::ofProcess().run(
    static_cast<std::size_t>(rows), [&](std::size_t y, unsigned) { work(static_cast<int>(y)); });
}

/// Highlight and look.
void handOn(const Level& from, std::size_t source, Level& to, std::size_t place)
{
  if (!from.highlights.empty())
  {
    to.highlights[place] = from.highlights[source];
  }
  if (!from.looks.empty())
  {
    to.looks[place] = from.looks[source];
  }
}

void pull(const Level& fine, Level& coarse, const Agreement& agreement, int factor)
{
  eachRow(coarse.height,
    [&](int y)
    {
      for (int x = 0; x < coarse.width; ++x)
      {
        std::size_t places[4];
        int count = 0;
        float least = nothing;
        for (int k = 0; k < 4; ++k)
        {
          const int fx = 2 * (coarse.left + x) + (k & 1) - fine.left;
          const int fy = 2 * (coarse.bottom + y) + (k >> 1) - fine.bottom;
          if (fx >= 0 && fy >= 0 && fx < fine.width && fy < fine.height)
          {
            places[count] = fine.at(fx, fy);
            least = std::min(least, fine.depth[places[count]]);
            ++count;
          }
        }
        const std::size_t place = coarse.at(x, y);
        coarse.depth[place] = least;
        if (least == nothing)
        {
          continue;
        }
        const float most = agreement.at(least, factor);
        Channels sum{};
        std::uint32_t parts = 0;
        for (int k = 0; k < count; ++k)
        {
          if (fine.depth[places[k]] <= most)
          {
            if (parts == 0) // the first that agrees
            {
              handOn(fine, places[k], coarse, place);
            }
            add(sum, fine.rgba[places[k]], 1);
            ++parts;
          }
        }
        coarse.rgba[place] = mean(sum, parts);
      }
    });
}

void push(Level& fine, const Level& coarse, const Agreement& agreement, int factor)
{
  eachRow(fine.height,
    [&](int y)
    {
      const int cy = (fine.bottom + y) / 2 - coarse.bottom;
      const int ny = std::clamp(cy + ((fine.bottom + y) % 2 ? 1 : -1), 0, coarse.height - 1);
      for (int x = 0; x < fine.width; ++x)
      {
        const int cx = (fine.left + x) / 2 - coarse.left;
        const int nx = std::clamp(cx + ((fine.left + x) % 2 ? 1 : -1), 0, coarse.width - 1);
        const std::size_t corners[4] = { coarse.at(cx, cy), coarse.at(nx, cy), coarse.at(cx, ny),
          coarse.at(nx, ny) };
        constexpr std::uint32_t weights[4] = { 9, 3, 3, 1 };
        float least = nothing;
        for (const std::size_t corner : corners)
        {
          least = std::min(least, coarse.depth[corner]);
        }
        const std::size_t place = fine.at(x, y);
        const float most = agreement.at(least, 4 * factor);
        if (least == nothing || fine.depth[place] <= most)
        {
          continue;
        }
        Channels sum{};
        std::uint32_t parts = 0;
        for (int k = 0; k < 4; ++k)
        {
          if (coarse.depth[corners[k]] <= most)
          {
            add(sum, coarse.rgba[corners[k]], weights[k]);
            parts += weights[k];
          }
        }
        if (parts >= leastParts)
        {
          fine.depth[place] = least;
          fine.rgba[place] = mean(sum, parts);
          // With so many parts the nearest corner is one that agrees.
          handOn(coarse, corners[0], fine, place);
        }
      }
    });
}

} // namespace

PixelRectangle filledFrom(const PixelRectangle& place, const FrameCamera& camera)
{
  if (place.empty())
  {
    return place;
  }
  const auto down = [](int x) { return (x - holeFillerReach) & -holeFillerReach; };
  const auto up = [](int x) { return (x + 2 * holeFillerReach - 1) & -holeFillerReach; };
  return common({ 0, 0, camera.width, camera.height },
    { down(place.left), down(place.bottom), up(place.right), up(place.top) });
}

void fillHoles(const FrameCamera& camera, SoftwareTarget& target)
{
  const double scale = 0.5 * camera.height * camera.viewToClip[1][1];
  const auto size = static_cast<float>(holeFillerAgreePx / scale);
  Agreement agreement;
  (camera.parallel ? agreement.always : agreement.perDepth) = size;
  std::array<Level, levels + 1> pyramid;
  pyramid[0].left = target.left;
  pyramid[0].bottom = target.bottom;
  pyramid[0].width = target.width;
  pyramid[0].height = target.height;
  pyramid[0].depth.swap(target.depth);
  pyramid[0].rgba.swap(target.rgba);
  pyramid[0].highlights.swap(target.highlights);
  pyramid[0].looks.swap(target.looks);
  for (int level = 1; level <= levels; ++level)
  {
    const Level& fine = pyramid[static_cast<std::size_t>(level - 1)];
    Level& coarse = pyramid[static_cast<std::size_t>(level)];
    coarse.left = fine.left / 2;
    coarse.bottom = fine.bottom / 2;
    coarse.width = (fine.left + fine.width + 1) / 2 - coarse.left;
    coarse.height = (fine.bottom + fine.height + 1) / 2 - coarse.bottom;
    const std::size_t pixels = coarse.at(0, coarse.height);
    coarse.depth.resize(pixels);
    coarse.rgba.resize(pixels);
    coarse.highlights.resize(fine.highlights.empty() ? 0 : pixels);
    coarse.looks.resize(fine.looks.empty() ? 0 : pixels);
    pull(fine, coarse, agreement, 1 << level);
  }
  for (auto level = static_cast<std::size_t>(levels); level-- > 0;)
  {
    push(pyramid[level], pyramid[level + 1], agreement, 1 << level);
  }
  pyramid[0].depth.swap(target.depth);
  pyramid[0].rgba.swap(target.rgba);
  pyramid[0].highlights.swap(target.highlights);
  pyramid[0].looks.swap(target.looks);
}

} // namespace pointfront
