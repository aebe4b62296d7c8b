#include "SoftwareScene.h"

#include <algorithm>
#include <limits>

namespace pointfront
{

Result<std::optional<SoftwareScene::SeenPoint>> SoftwareScene::pick(
  const std::array<int, 2>& pixel, int reach)
{
  target_.keepPoints = true;
  const Result<FrameRecord> drawn = renderFrame();
  target_.keepPoints = false;
  const std::vector<PixelPoint> points = std::move(target_.points);
  target_.points = {};
  if (!drawn)
  {
    return drawn.error();
  }
  std::optional<SeenPoint> nearest;
  int least = std::numeric_limits<int>::max();
  for (int y = std::max(0, pixel[1] - reach); y <= std::min(target_.height - 1, pixel[1] + reach);
       ++y)
  {
    for (int x = std::max(0, pixel[0] - reach); x <= std::min(target_.width - 1, pixel[0] + reach);
         ++x)
    {
      const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(target_.width) +
        static_cast<std::size_t>(x);
      const int dx = x - pixel[0];
      const int dy = y - pixel[1];
      const int distance = dx * dx + dy * dy;
      const PixelPoint& seen = points[at];
      if (seen.store != PixelPoint::nothing && distance <= reach * reach && distance < least)
      {
        const Hierarchy& hierarchy = *stores_[seen.store]->cloud()->hierarchy();
        least = distance;
        nearest = SeenPoint{ seen.store, hierarchy.node(seen.node).firstPoint + seen.index };
      }
    }
  }
  return nearest;
}

} // namespace pointfront
