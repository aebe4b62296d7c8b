#pragma once

#include <algorithm>

namespace pointfront
{

/// Pixels [left, right) x [bottom, top) of a viewport; row 0 is the lowest.
struct PixelRectangle
{
  int left = 0;
  int bottom = 0;
  int right = 0;
  int top = 0;

  int width() const { return right - left; }
  int height() const { return top - bottom; }
  bool empty() const { return right <= left || top <= bottom; }
  bool contains(const PixelRectangle& other) const
  {
    return other.left >= left && other.right <= right && other.bottom >= bottom && other.top <= top;
  }
};

/// The intersection; empty, at 0, if there is none.
inline PixelRectangle common(const PixelRectangle& a, const PixelRectangle& b)
{
  const PixelRectangle both{ std::max(a.left, b.left), std::max(a.bottom, b.bottom),
    std::min(a.right, b.right), std::min(a.top, b.top) };
  return both.empty() ? PixelRectangle() : both;
}

/// The smallest rectangle that contains both.
inline PixelRectangle around(const PixelRectangle& a, const PixelRectangle& b)
{
  if (a.empty() || b.empty())
  {
    return a.empty() ? b : a;
  }
  return { std::min(a.left, b.left), std::min(a.bottom, b.bottom), std::max(a.right, b.right),
    std::max(a.top, b.top) };
}

} // namespace pointfront
