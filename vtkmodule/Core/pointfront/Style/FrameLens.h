#pragma once

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace pointfront
{

/// Which pixels a lens covers where it has a shape of its own: not 0 where it does.
/// Shape  width * height values, row 0 is the lowest; stretched over the viewport.
struct LensMask
{
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> values;

  friend bool operator==(const LensMask& a, const LensMask& b)
  {
    return a.width == b.width && a.height == b.height && a.values == b.values;
  }
};

/// What part of a picture a lens shows (LAYERS-10).
enum class LensShape : std::uint8_t
{
  Circle,
  Rectangle,
  Mask, ///< any set of pixels
  AroundClass ///< what points of a class cover, each with a disc of some world units
};

/// A lens of one frame: inside it each layer is drawn in another style (ResolvedStyle::lens).
/// Pixels   (0, 0) is the lower left corner of the viewport, pixel centres at + 0.5.
/// Threads  a value.
struct FrameLens
{
  LensShape shape = LensShape::Circle;
  glm::vec2 centrePx{ 0.0f };
  glm::vec2 halfSizePx{ 0.0f }; ///< Circle: its radius, twice; else an ellipse
  std::shared_ptr<const LensMask> mask; ///< Mask

  /// No pixel of any viewport; a lens around a class covers what the class's points do.
  bool coversNothing() const;
  /// Whether it covers pixel (x, y) of a viewport; AroundClass: never.
  bool covers(int x, int y, int viewportWidth, int viewportHeight) const;
  /// Left, bottom, right, top of all pixels of the viewport that it can cover; right and top are
  /// the first beyond it.
  std::array<int, 4> extent(int viewportWidth, int viewportHeight) const;

  friend bool operator==(const FrameLens& a, const FrameLens& b);
  friend bool operator!=(const FrameLens& a, const FrameLens& b) { return !(a == b); }
};

} // namespace pointfront
