#pragma once

#include "LargePages.h"
#include "PixelRectangle.h"

#include "pointfront/Store/Hierarchy.h"

#include <cstdint>
#include <limits>

namespace pointfront
{

/// The point that a pixel shows: number `index` in node `node` of the store drawn as `store`.
struct PixelPoint
{
  static constexpr std::uint16_t nothing = 0xffff;
  std::uint16_t store = nothing;
  NodeIndex node = noNode;
  std::uint32_t index = 0;
};

/// The picture that software back ends draw into: the nearest of all that was drawn.
/// Shapes   width * height values, row 0 is the lowest.
/// Place    its lower left pixel is (left, bottom) of the viewport: a part of it may be all that is
///          wanted.
/// Units    rgba: bytes r, g, b, a of a pixel in memory order, opaque where something was drawn, 0
///          elsewhere; less than opaque where only what is translucent was.
///          depth: world units along the line of sight from the eye's plane; infinity
///          where nothing was drawn.
struct SoftwareTarget
{
  int left = 0;
  int bottom = 0;
  int width = 0;
  int height = 0;
  PictureValues<std::uint32_t> rgba;
  PictureValues<float> depth;
  /// The depth that decided who is seen, in the units of depth; empty unless `keepDecided`. Among
  /// several plans that are drawn into one target it decides, too: splats of two clouds meet as
  /// those of one. Pixels that were filled later have none: infinity.
  PictureValues<float> decided;
  /// View-space normal, 3 x float a pixel, 0 where there is none; empty unless a plan asks for
  /// light.
  PictureValues<float> normals;
  /// ResolvedStyle::highlight of who is in each pixel; empty unless a plan has highlights.
  PictureValues<std::uint8_t> highlights;
  /// ResolvedStyle::look of who is in each pixel; empty unless a plan has several looks.
  PictureValues<std::uint16_t> looks;
  /// Who is in each pixel; empty unless `keepPoints`.
  PictureValues<PixelPoint> points;
  bool keepPoints = false;
  bool keepDecided = false;

  PixelRectangle rectangle() const { return { left, bottom, left + width, bottom + height }; }
  /// Makes it that large and empty.
  void reset(int newWidth, int newHeight) { reset({ 0, 0, newWidth, newHeight }); }
  void reset(const PixelRectangle& place)
  {
    left = place.left;
    bottom = place.bottom;
    width = place.width();
    height = place.height();
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    rgba.assign(pixels, 0);
    depth.assign(pixels, std::numeric_limits<float>::infinity());
    decided.assign(keepDecided ? pixels : 0, std::numeric_limits<float>::infinity());
    normals.clear();
    highlights.clear();
    looks.clear();
    points.assign(keepPoints ? pixels : 0, PixelPoint());
  }
};

} // namespace pointfront
