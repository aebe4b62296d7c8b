#pragma once

#include "PixelRectangle.h"

#include <cstdint>

namespace pointfront
{

/// Depth and index in one number: the smallest is the nearest, and of equals the first.
using RasterKey = std::int64_t;
constexpr RasterKey emptyKey = INT64_MAX;

/// Points that go through the rasteriser together: one array for each quantity, so that loops over
/// points become vector instructions. Scratch of one thread.
/// Spaces  Camera space: x to the right, y up, z along the line of sight (positive in front), world
///         units. Pixels: the viewport's, y up.
struct RasterBatch
{
  /// With 512 points, arrays and pixels do not fit into a first-level cache together.
  static constexpr int size = 128;
  /// How large a splat is on screen, by half its larger edge: which kernel draws it.
  enum Extent : std::int32_t
  {
    Culled = 0,
    Within2 = 1, ///< 2 x 2 pixels
    Within4 = 2, ///< 4 x 4 pixels
    Wide = 3, ///< within the buffers' margin: rows of any length
    Clipped = 4 ///< anything larger: its rows are clipped
  };

  alignas(64) float screenX[size]; ///< pixels
  alignas(64) float screenY[size];
  alignas(64) float depth[size]; ///< camera z; negative: culled
  alignas(64) float inverseReach[size]; ///< 1 / depth; parallel: 1
  alignas(64) float radius[size]; ///< world units; after the set-up: at least what a pixel needs
  alignas(64) float grown[size]; ///< share of its radius, once that is at least a pixel's
  alignas(64) float weight[size]; ///< weight of a blended splat's centre, 0 to 63
  alignas(64) float normalX[size]; ///< camera space, any length
  alignas(64) float normalY[size];
  alignas(64) float normalZ[size];
  alignas(64) float height[size]; ///< walls: world units; 0: none

  // Made by the set-up of a shape:
  /// of pixels for discs, of world units where rays are cast
  alignas(64) float inverseRadius2[size];
  /// ellipses: q = XX dx^2 + XY dx dy + YY dy^2; walls: the unit vector to their right
  alignas(64) float quadraticXX[size];
  alignas(64) float quadraticXY[size];
  alignas(64) float quadraticYY[size];
  alignas(64) float slopeX[size]; ///< ellipses: depth per pixel
  alignas(64) float slopeY[size];
  alignas(64) float halfX[size]; ///< pixels, half of the bounding rectangle
  alignas(64) float halfY[size];
  alignas(64) float middleX[size]; ///< pixels, of the bounding rectangle
  alignas(64) float middleY[size];
  alignas(64) float firstX[size]; ///< first pixel centre of the rectangle less the centre
  alignas(64) float firstY[size];
  alignas(64) std::int32_t offset[size]; ///< offset of the rectangle's first pixel in the buffers
  alignas(64) std::int32_t rows[size];
  alignas(64) std::int32_t columns[size];
  alignas(64) std::int32_t extent[size];
  alignas(64) std::uint32_t colour[size]; ///< bytes r, g, b, a in memory order
  alignas(64) std::uint8_t keep[size]; ///< 0: filtered out
  alignas(64) std::int32_t list[size + 16]; ///< and what a vector writes behind it

  alignas(64) RasterKey key[size]; ///< keys of squares of one pixel
  // Splats within 2 x 2 pixels cover these pixels:
  alignas(64) std::int32_t fragmentOffset[4 * size + 16];
  alignas(64) float fragmentDepth[4 * size + 16];
  alignas(64) std::uint32_t fragmentIndex[4 * size + 16];
  alignas(64) RasterKey fragmentKey[4 * size];
  // and all of them, two of a row beside one another:
  alignas(64) float lowerDepth[2 * size];
  alignas(64) float upperDepth[2 * size];
  alignas(64) std::int32_t lowerWeight[2 * size];
  alignas(64) std::int32_t upperWeight[2 * size];
};

/// Buffers have this many pixels around the picture, so that a splat that reaches over its edge
/// needs no clipping.
constexpr int rasterMargin = 64;
/// Largest half edge of a splat that fits in the margin.
constexpr float largestUnclipped = 62.0f;

/// Where points land, in single precision: all that is large was taken off in double before.
struct RasterCamera
{
  /// Camera space from steps: z is along the line of sight.
  float matrix[3][4] = {};
  /// Unit vector of the store's z axis.
  float up[3] = { 0.0f, 1.0f, 0.0f };
  float scaleX = 1.0f; ///< pixels per unit at depth 1; parallel: at any depth
  float scaleY = 1.0f;
  float centreX = 0.0f; ///< pixels
  float centreY = 0.0f;
  float nearDepth = 0.0f;
  float farDepth = 0.0f;
  bool parallel = false;
};

/// The part of the viewport that is drawn, and how buffers of it are laid out.
struct RasterWindow
{
  int left = 0; ///< first column of the viewport
  int width = 0;
  int bottom = 0; ///< first row of the viewport
  int height = 0;
  std::int32_t stride = 0; ///< pixels from a row to the next in a buffer with margins

  PixelRectangle rectangle() const { return { left, bottom, left + width, bottom + height }; }
  std::int32_t at(int x, int y) const ///< these count from `left` and `bottom`
  {
    return (y + rasterMargin) * stride + x + rasterMargin;
  }
  std::int64_t pixels() const ///< pixels of a buffer
  {
    return std::int64_t(stride) * (height + 2 * rasterMargin) + 16;
  }
};

/// Points of one node as they lie in memory.
struct RasterPositions
{
  const std::uint32_t* xyz = nullptr; ///< from the batch's first point on: three a point
  std::uint32_t shift = 0; ///< SlotOrigin
  std::int32_t steps[3] = {};
  float clipping[6][4] = {}; ///< camera space planes: n . p + d >= 0 is drawn
  int clippingPlanes = 0;
  bool filtered = false; ///< RasterBatch::keep says which points are drawn
};

} // namespace pointfront
