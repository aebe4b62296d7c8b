#pragma once

#include "pointfront/Store/Hierarchy.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace pointfront
{

/// What a pixel shows: point `index` of node `node` of the store that was drawn as number `store`.
struct PixelPoint
{
  static constexpr std::uint16_t nothing = 0xffff;
  std::uint16_t store = nothing;
  NodeIndex node = noNode;
  std::uint32_t index = 0;
};

/// The picture that software back ends draw into: the nearest of all that was drawn.
/// Shapes   width * height values, row 0 is the lowest.
/// Units    rgba: bytes r, g, b, a of a pixel in memory order, opaque where something was drawn, 0
///          elsewhere. depth: world units along the line of sight from the eye's plane; infinity
///          where nothing was drawn.
struct SoftwareTarget
{
  int width = 0;
  int height = 0;
  std::vector<std::uint32_t> rgba;
  std::vector<float> depth;
  /// View-space normal, 3 x float a pixel, 0 where there is none; empty unless a plan asks for
  /// light.
  std::vector<float> normals;
  /// Who is in each pixel; empty unless `keepPoints`.
  std::vector<PixelPoint> points;
  bool keepPoints = false;

  /// Makes it that large and empty.
  void reset(int newWidth, int newHeight)
  {
    width = newWidth;
    height = newHeight;
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    rgba.assign(pixels, 0);
    depth.assign(pixels, std::numeric_limits<float>::infinity());
    normals.clear();
    points.assign(keepPoints ? pixels : 0, PixelPoint());
  }
};

} // namespace pointfront
