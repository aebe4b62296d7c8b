#include "SoftwareComposition.h"

#include "pointfront/Threads/ThreadCrew.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace pointfront
{
namespace
{

constexpr float nothingThere = std::numeric_limits<float>::infinity();

std::uint32_t mixed(std::uint32_t rgba, const glm::vec3& colour, float share)
{
  std::uint8_t bytes[4];
  std::memcpy(bytes, &rgba, 4);
  // Over an empty pixel the colour counts alone.
  const float own = bytes[3] == 0 ? 0.0f : 1.0f - share;
  const float other = bytes[3] == 0 ? 1.0f : share;
  for (int c = 0; c < 3; ++c)
  {
    const float sum = own * static_cast<float>(bytes[c]) + other * 255.0f * colour[c];
    bytes[c] = static_cast<std::uint8_t>(std::clamp(sum + 0.5f, 0.0f, 255.0f));
  }
  const float opacity = static_cast<float>(bytes[3]);
  bytes[3] = static_cast<std::uint8_t>(opacity + (255.0f - opacity) * share + 0.5f);
  std::uint32_t result;
  std::memcpy(&result, bytes, 4);
  return result;
}

/// Distances for one highlight: pixels in the row from each pixel to the nearest that it marks.
class RowDistances
{
public:
  static constexpr int none = 1 << 14;

  RowDistances(const SoftwareTarget& target, std::uint8_t mark, int reach)
    : width_(target.width)
    , across_(target.depth.size(), none)
  {
    ThreadCrew::ofProcess().run(static_cast<std::size_t>(target.height),
      [&](std::size_t y, unsigned)
      {
        const std::size_t begin = y * static_cast<std::size_t>(width_);
        int last = -none;
        for (int x = 0; x < width_; ++x)
        {
          const std::size_t pixel = begin + static_cast<std::size_t>(x);
          last = target.highlights[pixel] == mark ? x : last;
          across_[pixel] = static_cast<std::int16_t>(x - last <= reach ? last - x : none);
        }
        last = 2 * none;
        for (int x = width_ - 1; x >= 0; --x)
        {
          const std::size_t pixel = begin + static_cast<std::size_t>(x);
          last = target.highlights[pixel] == mark ? x : last;
          const bool nearer = last - x < std::abs(across_[pixel]);
          across_[pixel] =
            nearer && last - x <= reach ? static_cast<std::int16_t>(last - x) : across_[pixel];
        }
      });
  }
  int at(int x, int y) const
  {
    return across_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
      static_cast<std::size_t>(x)];
  }

private:
  int width_;
  std::vector<std::int16_t> across_; ///< signed; `none` beyond reach
};

void drawHalo(const FrameHighlight& look, std::uint8_t mark, SoftwareTarget& target)
{
  const int reach = static_cast<int>(std::ceil(look.haloPx));
  const RowDistances rows(target, mark, reach);
  ThreadCrew::ofProcess().run(static_cast<std::size_t>(target.height),
    [&](std::size_t row, unsigned)
    {
      const int y = static_cast<int>(row);
      for (int x = 0; x < target.width; ++x)
      {
        const std::size_t pixel =
          row * static_cast<std::size_t>(target.width) + static_cast<std::size_t>(x);
        if (target.highlights[pixel] == mark)
        {
          continue;
        }
        int least = std::numeric_limits<int>::max();
        std::size_t from = 0;
        for (int other = std::max(0, y - reach); other <= std::min(target.height - 1, y + reach);
             ++other)
        {
          const int across = rows.at(x, other);
          const int squared = across * across + (other - y) * (other - y);
          if (across != RowDistances::none && squared < least)
          {
            least = squared;
            from = static_cast<std::size_t>(other) * static_cast<std::size_t>(target.width) +
              static_cast<std::size_t>(x + across);
          }
        }
        const bool near = least < std::numeric_limits<int>::max();
        const float share = near
          ? std::clamp(look.haloPx + 1.0f - std::sqrt(static_cast<float>(least)), 0.0f, 1.0f)
          : 0.0f;
        if (share > 0.0f && target.depth[from] < target.depth[pixel])
        {
          target.rgba[pixel] = mixed(target.rgba[pixel], look.colour, share);
          target.depth[pixel] =
            target.depth[pixel] == nothingThere ? target.depth[from] : target.depth[pixel];
        }
      }
    });
}

} // namespace

void highlight(const FrameShading& shading, SoftwareTarget& target)
{
  if (target.highlights.empty())
  {
    return;
  }
  for (std::size_t pixel = 0; pixel < target.highlights.size(); ++pixel)
  {
    const std::size_t mark = target.highlights[pixel];
    if (mark > 0 && mark <= shading.highlights.size())
    {
      const FrameHighlight& look = shading.highlights[mark - 1];
      target.rgba[pixel] = mixed(target.rgba[pixel], look.colour, look.tint);
    }
  }
  for (std::size_t number = 0; number < shading.highlights.size(); ++number)
  {
    if (!target.keepPoints && shading.highlights[number].haloPx > 0.0f) // a halo is no point
    {
      drawHalo(shading.highlights[number], static_cast<std::uint8_t>(number + 1), target);
    }
  }
}

} // namespace pointfront
