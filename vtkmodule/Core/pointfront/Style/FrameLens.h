#pragma once

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace pointfront
{

/// The shape of a lens as a mask: not 0 for pixels that the lens covers.
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

/// The part of a picture that a lens covers (LAYERS-10).
enum class LensShape : std::uint8_t
{
  Circle,
  Rectangle,
  Mask, ///< any set of pixels
  AroundClass ///< covered by points of a class, each with a disc of some world units
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

  /// Whether it covers no pixel of any viewport. (A lens around a class covers the pixels of the
  /// class's points.)
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
