#pragma once

#include "RasterBatch.h"
#include "RasterKernels.h"

namespace pointfront
{
namespace
{

// Loops over a batch that compilers turn into vector instructions: no branches, one array a
// quantity. Included by each Kernels*.cxx with its own Lanes; nothing here is seen by a linker.

/// Integer positions less the reference's integers, then one affine map (docs/adr/0004).
template <bool Parallel>
void projectInto(
  const RasterCamera& camera, const RasterPositions& points, int count, RasterBatch& batch)
{
  const std::uint32_t* const xyz = points.xyz;
  const std::uint32_t shift = points.shift;
  const std::int32_t stepX = points.steps[0];
  const std::int32_t stepY = points.steps[1];
  const std::int32_t stepZ = points.steps[2];
  const auto& m = camera.matrix;
  const float m00 = m[0][0], m01 = m[0][1], m02 = m[0][2], m03 = m[0][3];
  const float m10 = m[1][0], m11 = m[1][1], m12 = m[1][2], m13 = m[1][3];
  const float m20 = m[2][0], m21 = m[2][1], m22 = m[2][2], m23 = m[2][3];
  const float nearDepth = camera.nearDepth, farDepth = camera.farDepth;
  const float scaleX = camera.scaleX, scaleY = camera.scaleY;
  const float centreX = camera.centreX, centreY = camera.centreY;
  for (int j = 0; j < count; ++j)
  {
    const auto x = static_cast<float>(static_cast<std::int32_t>(xyz[3 * j] >> shift) - stepX);
    const auto y = static_cast<float>(static_cast<std::int32_t>(xyz[3 * j + 1] >> shift) - stepY);
    const auto z = static_cast<float>(static_cast<std::int32_t>(xyz[3 * j + 2] >> shift) - stepZ);
    const float right = m00 * x + m01 * y + m02 * z + m03;
    const float up = m10 * x + m11 * y + m12 * z + m13;
    const float ahead = m20 * x + m21 * y + m22 * z + m23;
    const float inverse = Parallel ? 1.0f : 1.0f / ahead;
    batch.inverseReach[j] = inverse;
    batch.screenX[j] = centreX + right * inverse * scaleX;
    batch.screenY[j] = centreY + up * inverse * scaleY;
    const int drawn = (ahead >= nearDepth) & (ahead <= farDepth);
    batch.depth[j] = drawn ? ahead : -1.0f;
  }
}

/// Points beyond a clipping plane are culled.
inline void clip(
  const RasterCamera& camera, const RasterPositions& points, int count, RasterBatch& batch)
{
  const float widthX = 1.0f / camera.scaleX;
  const float widthY = 1.0f / camera.scaleY;
  for (int plane = 0; plane < points.clippingPlanes; ++plane)
  {
    const float* const p = points.clipping[plane];
    for (int j = 0; j < count; ++j)
    {
      const float depth = batch.depth[j];
      const float reach = camera.parallel ? 1.0f : depth;
      const float right = (batch.screenX[j] - camera.centreX) * widthX * reach;
      const float up = (batch.screenY[j] - camera.centreY) * widthY * reach;
      const float inside = p[0] * right + p[1] * up + p[2] * depth + p[3];
      batch.depth[j] = inside >= 0.0f ? depth : -1.0f;
    }
  }
}

inline void project(
  const RasterCamera& camera, const RasterPositions& points, int count, RasterBatch& batch)
{
  camera.parallel ? projectInto<true>(camera, points, count, batch)
                  : projectInto<false>(camera, points, count, batch);
  clip(camera, points, count, batch);
  if (points.filtered)
  {
    for (int j = 0; j < count; ++j)
    {
      batch.depth[j] = batch.keep[j] != 0 ? batch.depth[j] : -1.0f;
    }
  }
}

inline void loadRadii(const RadiusCodes& stored, int count, RasterBatch& batch)
{
  const std::uint8_t* const __restrict__ codes = stored.codes;
  const float* const __restrict__ radii = stored.radii;
  float* const __restrict__ radius = batch.radius;
  const float scale = stored.scale, unknown = stored.unknown;
  const float least = stored.least, most = stored.most;
  for (int j = 0; j < count; ++j)
  {
    radius[j] = radii[codes[j]];
  }
  for (int j = 0; j < count; ++j)
  {
    const float own = radius[j] * scale;
    const float bounded = own < most ? own : most;
    const float known = own > 0.0f ? bounded : unknown;
    radius[j] = known > least ? known : least;
  }
}

inline void loadNormals(const StoredNormals& stored, int count, RasterBatch& batch)
{
  const std::int16_t* const __restrict__ xyz = stored.xyz;
  const auto& m = stored.matrix;
  const float m00 = m[0][0], m01 = m[0][1], m02 = m[0][2];
  const float m10 = m[1][0], m11 = m[1][1], m12 = m[1][2];
  const float m20 = m[2][0], m21 = m[2][1], m22 = m[2][2];
  for (int j = 0; j < count; ++j)
  {
    const auto x = static_cast<float>(xyz[3 * j]);
    const auto y = static_cast<float>(xyz[3 * j + 1]);
    const auto z = static_cast<float>(xyz[3 * j + 2]);
    batch.normalX[j] = m00 * x + m01 * y + m02 * z;
    batch.normalY[j] = m10 * x + m11 * y + m12 * z;
    batch.normalZ[j] = m20 * x + m21 * y + m22 * z;
  }
}

/// Culled points are drawn too, into a pixel of the margin that nobody looks at: a branch costs
/// more.
inline void drawPixels(
  const RasterWindow& window, RasterBatch& batch, int count, std::uint32_t index, RasterKey* keys)
{
  const auto width = static_cast<float>(window.width);
  const auto height = static_cast<float>(window.height);
  const auto left = static_cast<float>(window.left);
  const auto bottom = static_cast<float>(window.bottom);
  const std::int32_t stride = window.stride;
  const std::int32_t corner = window.at(0, 0);
  for (int j = 0; j < count; ++j)
  {
    const float x = batch.screenX[j] - left;
    const float y = batch.screenY[j] - bottom;
    const int inside =
      (x >= 0.0f) & (x < width) & (y >= 0.0f) & (y < height) & (batch.depth[j] >= 0.0f);
    const auto column = static_cast<std::int32_t>(inside ? x : 0.0f);
    const auto row = static_cast<std::int32_t>(inside ? y : 0.0f);
    batch.offset[j] = inside ? corner + row * stride + column : 0;
  }
  for (int j = 0; j < count; ++j)
  {
    std::uint32_t bits;
    __builtin_memcpy(&bits, &batch.depth[j], 4);
    batch.key[j] = static_cast<RasterKey>(
      std::uint64_t(bits & 0x7fffffffu) << 32 | (index + static_cast<std::uint32_t>(j)));
  }
  for (int j = 0; j < count; ++j)
  {
    RasterKey* const pixel = keys + batch.offset[j];
    const RasterKey key = batch.key[j], old = *pixel;
    *pixel = key < old ? key : old;
  }
}

/// Squares that fit in the margin: rows are drawn whole, four or eight pixels at a time.
template <bool Four>
inline void drawBlocks(const RasterWindow& window, RasterBatch& batch, int count, int size,
  std::uint32_t index, RasterKey* keys)
{
  const float back = 0.5f * static_cast<float>(size - 1);
  const auto reach = static_cast<float>(size);
  const auto width = static_cast<float>(window.width);
  const auto height = static_cast<float>(window.height);
  const auto left = static_cast<float>(window.left);
  const auto bottom = static_cast<float>(window.bottom);
  const std::int32_t stride = window.stride;
  const std::int32_t corner = window.at(0, 0);
  for (int j = 0; j < count; ++j)
  {
    const float x = __builtin_floorf(batch.screenX[j] - back) - left;
    const float y = __builtin_floorf(batch.screenY[j] - back) - bottom;
    const int seen =
      (x > -reach) & (x < width) & (y > -reach) & (y < height) & (batch.depth[j] >= 0.0f);
    const auto column = static_cast<std::int32_t>(seen ? x : 0.0f);
    const auto row = static_cast<std::int32_t>(seen ? y : 0.0f);
    batch.offset[j] = seen ? corner + row * stride + column : 0;
  }
  for (int j = 0; j < count; ++j)
  {
    RasterKey* row = keys + batch.offset[j];
    const float depth = batch.depth[j] >= 0.0f ? batch.depth[j] : 0.0f;
    const std::uint32_t id = index + static_cast<std::uint32_t>(j);
    for (int y = 0; y < size; ++y, row += stride)
    {
      if (Four)
      {
        keepRow4(row, depth, id, size);
        continue;
      }
      int x = 0;
      for (; x + 4 < size; x += 4)
      {
        keepRow4(row + x, depth, id, 4);
      }
      keepRow4(row + x, depth, id, size - x);
    }
  }
}

/// Squares that may be larger than the margin.
inline void drawLargeSquares(const RasterWindow& window, RasterBatch& batch, int count, int size,
  std::uint32_t index, RasterKey* keys)
{
  const float back = 0.5f * static_cast<float>(size - 1);
  const auto most = static_cast<float>(1 << 24);
  for (int j = 0; j < count; ++j)
  {
    const float x = __builtin_floorf(batch.screenX[j] - back);
    const float y = __builtin_floorf(batch.screenY[j] - back);
    if (!(batch.depth[j] >= 0.0f) || !(x > -most && x < most && y > -most && y < most))
    {
      continue;
    }
    const int left = static_cast<int>(x) - window.left;
    const int low = static_cast<int>(y) - window.bottom;
    const int right = left + size < window.width ? left + size : window.width;
    const int top = low + size < window.height ? low + size : window.height;
    std::uint32_t bits;
    __builtin_memcpy(&bits, &batch.depth[j], 4);
    const auto key =
      static_cast<RasterKey>(std::uint64_t(bits) << 32 | (index + static_cast<std::uint32_t>(j)));
    for (int row = low > 0 ? low : 0; row < top; ++row)
    {
      RasterKey* const pixels = keys + window.at(0, row);
      for (int column = left > 0 ? left : 0; column < right; ++column)
      {
        pixels[column] = key < pixels[column] ? key : pixels[column];
      }
    }
  }
}

inline void drawSquares(const RasterWindow& window, RasterBatch& batch, int count, int size,
  std::uint32_t index, RasterKey* keys)
{
  if (size <= 1)
  {
    drawPixels(window, batch, count, index, keys);
  }
  else if (size <= 4)
  {
    drawBlocks<true>(window, batch, count, size, index, keys);
  }
  else if (size < rasterMargin)
  {
    drawBlocks<false>(window, batch, count, size, index, keys);
  }
  else
  {
    drawLargeSquares(window, batch, count, size, index, keys);
  }
}

} // namespace
} // namespace pointfront
