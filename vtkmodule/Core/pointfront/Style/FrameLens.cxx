#include "pointfront/Style/FrameLens.h"

#include <algorithm>
#include <cmath>

namespace pointfront
{

bool FrameLens::coversNothing() const
{
  switch (shape)
  {
    case LensShape::Circle:
    case LensShape::Rectangle:
      return !(halfSizePx.x > 0.0f && halfSizePx.y > 0.0f);
    case LensShape::Mask:
      return !mask ||
        std::all_of(
          mask->values.begin(), mask->values.end(), [](std::uint8_t value) { return value == 0; });
    case LensShape::AroundClass:
      break;
  }
  return false;
}

bool FrameLens::covers(int x, int y, int viewportWidth, int viewportHeight) const
{
  const glm::vec2 from = glm::vec2(float(x) + 0.5f, float(y) + 0.5f) - centrePx;
  switch (shape)
  {
    case LensShape::Circle:
    {
      const glm::vec2 a = from * from, b = halfSizePx * halfSizePx;
      return a.x * b.y + a.y * b.x <= b.x * b.y;
    }
    case LensShape::Rectangle:
      return std::abs(from.x) <= halfSizePx.x && std::abs(from.y) <= halfSizePx.y;
    case LensShape::Mask:
    {
      if (!mask || mask->width <= 0 || mask->height <= 0)
      {
        return false;
      }
      const auto column = std::int64_t(x) * mask->width / std::max(1, viewportWidth);
      const auto row = std::int64_t(y) * mask->height / std::max(1, viewportHeight);
      const bool inside = column >= 0 && row >= 0 && column < mask->width && row < mask->height;
      return inside && mask->values[static_cast<std::size_t>(row * mask->width + column)] != 0;
    }
    case LensShape::AroundClass:
      break;
  }
  return false;
}

std::array<int, 4> FrameLens::extent(int viewportWidth, int viewportHeight) const
{
  if (shape == LensShape::Mask || shape == LensShape::AroundClass)
  {
    return { 0, 0, viewportWidth, viewportHeight };
  }
  const auto within = [](float at, int most)
  { return static_cast<int>(std::clamp(at, 0.0f, static_cast<float>(most))); };
  return { within(std::floor(centrePx.x - halfSizePx.x), viewportWidth),
    within(std::floor(centrePx.y - halfSizePx.y), viewportHeight),
    within(std::ceil(centrePx.x + halfSizePx.x), viewportWidth),
    within(std::ceil(centrePx.y + halfSizePx.y), viewportHeight) };
}

bool operator==(const FrameLens& a, const FrameLens& b)
{
  return a.shape == b.shape && a.centrePx == b.centrePx && a.halfSizePx == b.halfSizePx &&
    (a.mask == b.mask || (a.mask && b.mask && *a.mask == *b.mask));
}

} // namespace pointfront
