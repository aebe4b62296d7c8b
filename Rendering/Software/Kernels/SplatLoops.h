#pragma once

#include "SplatSamples.h"
#include "SplatSetUp.h"
#include "TinySplatLoops.h"

namespace pointfront
{
namespace
{

// Loops over the pixels of splats, eight at a time, on the Lanes that were included before. No
// branch on the result of the depth test: load, minimum, store.

alignas(32) constexpr float laneX[8] = { 0, 1, 2, 3, 4, 5, 6, 7 };
alignas(32) constexpr float laneX4[8] = { 0, 1, 2, 3, 0, 1, 2, 3 };
alignas(32) constexpr float laneY4[8] = { 0, 0, 0, 0, 1, 1, 1, 1 };

/// Calls `take` with two rows of four pixels: offsets in the buffers, sample.
template <typename Splat, typename Take>
inline void visitSmall(
  const RasterWindow& window, const RasterBatch& batch, int j, const Splat& splat, const Take& take)
{
  const std::int32_t stride = window.stride;
  const std::int32_t offset = batch.offset[j];
  const Lanes dx = all(batch.firstX[j]) + load8(laneX4);
  const Lanes dy = all(batch.firstY[j]) + load8(laneY4);
  take(offset, offset + stride, splat.at(dx, dy));
  take(offset + 2 * stride, offset + 3 * stride, splat.at(dx, dy + all(2.0f)));
}

/// The rectangle inside the window of a splat that may be larger than the margin.
struct SplatRectangle
{
  std::int32_t offset;
  float left; ///< first pixel's centre less the splat's
  float low;
  int rows;
  int columns;
};
inline SplatRectangle clippedRectangle(const RasterWindow& window, const RasterBatch& batch, int j)
{
  const auto clamped = [](float x, float least, float most)
  { return x > least ? (x < most ? x : most) : least; };
  const auto left = static_cast<float>(window.left);
  const auto right = static_cast<float>(window.left + window.width - 1);
  const auto bottom = static_cast<float>(window.bottom);
  const auto top = static_cast<float>(window.bottom + window.height - 1);
  const float hx = batch.halfX[j] + 0.5f, hy = batch.halfY[j] + 0.5f;
  const float x0 = clamped(__builtin_ceilf(batch.middleX[j] - hx), left, right);
  const float x1 = clamped(__builtin_floorf(batch.middleX[j] + hx - 1.0f), left, right);
  const float y0 = clamped(__builtin_ceilf(batch.middleY[j] - hy), bottom, top);
  const float y1 = clamped(__builtin_floorf(batch.middleY[j] + hy - 1.0f), bottom, top);
  return { window.at(static_cast<int>(x0) - window.left, static_cast<int>(y0) - window.bottom),
    x0 + 0.5f - batch.screenX[j], y0 + 0.5f - batch.screenY[j], static_cast<int>(y1 - y0) + 1,
    static_cast<int>(x1 - x0) + 1 };
}

/// Calls `take` with eight pixels of a row each: offset in the buffers, sample.
template <typename Splat, typename Take>
inline void visitLarge(
  const RasterWindow& window, const RasterBatch& batch, int j, const Splat& splat, const Take& take)
{
  SplatRectangle rectangle{ batch.offset[j], batch.firstX[j], batch.firstY[j], batch.rows[j],
    batch.columns[j] };
  if (batch.extent[j] == RasterBatch::Clipped)
  {
    rectangle = clippedRectangle(window, batch, j);
  }
  const Lanes first = all(rectangle.left) + load8(laneX);
  std::int32_t offset = rectangle.offset;
  float dy = rectangle.low;
  for (int row = 0; row < rectangle.rows; ++row, offset += window.stride, dy += 1.0f)
  {
    Lanes dx = first;
    for (int column = 0; column < rectangle.columns; column += 8)
    {
      take(offset + column, splat.at(dx, all(dy)));
      dx = dx + all(8.0f);
    }
  }
}

/// The splats of the batch that are small, or larger, in a list: loops over one kind have no branch
/// that cannot be foreseen.
inline int listSmall(RasterBatch& batch, int count)
{
  return listEqual(batch.extent, count, RasterBatch::Within4, batch.list);
}
inline int listLarge(RasterBatch& batch, int count)
{
  const int wide = listEqual(batch.extent, count, RasterBatch::Wide, batch.list);
  return wide + listEqual(batch.extent, count, RasterBatch::Clipped, batch.list + wide);
}

template <SplatShape Shape, bool Parallel, bool Rimmed>
void drawShapeBy(const RasterCamera& camera, const RasterWindow& window, const SplatPass& pass,
  RasterBatch& batch, int count, std::uint32_t index, RasterKey* keys)
{
  drawTiny<Shape, Parallel, Rimmed>(camera, pass, batch, count, window.stride, index, keys);
  const int small = listSmall(batch, count);
  for (int i = 0; i < small; ++i)
  {
    const int j = batch.list[i];
    const SplatAt<Shape, Parallel> splat(camera, pass, batch, OneSplat{ j });
    const KeyDepth<Rimmed> keyDepth(pass, all(batch.radius[j]));
    const std::uint32_t id = index + static_cast<std::uint32_t>(j);
    visitSmall(window, batch, j, splat,
      [&](std::int32_t lower, std::int32_t upper, const SplatSample& s)
      { keepNearest4x2(keys + lower, keys + upper, keyDepth(s), id, s.covered); });
  }
  const int large = listLarge(batch, count);
  for (int i = 0; i < large; ++i)
  {
    const int j = batch.list[i];
    const LargeSplatAt<Shape, Parallel> splat(camera, pass, batch, j);
    const KeyDepth<Rimmed> keyDepth(pass, all(batch.radius[j]));
    const std::uint32_t id = index + static_cast<std::uint32_t>(j);
    visitLarge(window, batch, j, splat,
      [&](std::int32_t offset, const SplatSample& s)
      { keepNearest8(keys + offset, keyDepth(s), id, s.covered); });
  }
}

template <SplatShape Shape, bool Parallel>
void drawShape(const RasterCamera& camera, const RasterWindow& window, const SplatPass& pass,
  RasterBatch& batch, int count, std::uint32_t index, RasterKey* keys)
{
  pass.rimmed()
    ? drawShapeBy<Shape, Parallel, true>(camera, window, pass, batch, count, index, keys)
    : drawShapeBy<Shape, Parallel, false>(camera, window, pass, batch, count, index, keys);
}

template <SplatShape Shape, bool Parallel>
void addShape(const RasterCamera& camera, const RasterWindow& window, const SplatPass& pass,
  RasterBatch& batch, int count, const float* nearest, std::uint32_t* sums)
{
  addTiny<Shape, Parallel>(camera, pass, batch, count, window.stride, nearest, sums);
  const float pixelSize = pass.slackPixels / camera.scaleY;
  const auto slackOf = [&](int j) {
    return all(pass.slackRadii * batch.radius[j] + pixelSize * (Parallel ? 1.0f : batch.depth[j]));
  };
  const int small = listSmall(batch, count);
  for (int i = 0; i < small; ++i)
  {
    const int j = batch.list[i];
    const SplatAt<Shape, Parallel> splat(camera, pass, batch, OneSplat{ j });
    const Lanes rim = all(pass.paraboloid * batch.radius[j]), slack = slackOf(j);
    const Lanes centre = all(batch.weight[j]);
    const LaneColour colour = colourOf(batch.colour[j]);
    visitSmall(window, batch, j, splat,
      [&](std::int32_t lower, std::int32_t upper, const SplatSample& s)
      {
        const LaneMask added =
          s.covered & (s.depth + rim * s.q - slack <= load4x2(nearest + lower, nearest + upper));
        if (any(added))
        {
          addSums4x2(sums + 4 * std::int64_t(lower), sums + 4 * std::int64_t(upper),
            weightsOf(s, centre, added), colour);
        }
      });
  }
  const int large = listLarge(batch, count);
  for (int i = 0; i < large; ++i)
  {
    const int j = batch.list[i];
    const LargeSplatAt<Shape, Parallel> splat(camera, pass, batch, j);
    const Lanes rim = all(pass.paraboloid * batch.radius[j]), slack = slackOf(j);
    const Lanes centre = all(batch.weight[j]);
    const LaneColour colour = colourOf(batch.colour[j]);
    visitLarge(window, batch, j, splat,
      [&](std::int32_t offset, const SplatSample& s)
      {
        const LaneMask added = s.covered & (s.depth + rim * s.q - slack <= load8(nearest + offset));
        if (any(added))
        {
          addSums8(sums + 4 * std::int64_t(offset), weightsOf(s, centre, added), colour);
        }
      });
  }
}

template <bool Parallel>
void drawSplatsOf(const RasterCamera& camera, const RasterWindow& window, const SplatPass& pass,
  RasterBatch& batch, int count, std::uint32_t index, RasterKey* keys)
{
  switch (pass.shape)
  {
    case SplatShape::Disc:
      drawShape<SplatShape::Disc, Parallel>(camera, window, pass, batch, count, index, keys);
      break;
    case SplatShape::Ellipse:
      drawShape<SplatShape::Ellipse, Parallel>(camera, window, pass, batch, count, index, keys);
      break;
    case SplatShape::ExactEllipse:
      drawShape<SplatShape::ExactEllipse, Parallel>(
        camera, window, pass, batch, count, index, keys);
      break;
    case SplatShape::Sphere:
      drawShapeBy<SplatShape::Sphere, Parallel, false>(
        camera, window, pass, batch, count, index, keys);
      break;
    case SplatShape::Wall:
      drawShapeBy<SplatShape::Wall, Parallel, false>(
        camera, window, pass, batch, count, index, keys);
      break;
  }
}

inline void drawSplats(const RasterCamera& camera, const RasterWindow& window,
  const SplatPass& pass, RasterBatch& batch, int count, std::uint32_t index, RasterKey* keys)
{
  camera.parallel ? drawSplatsOf<true>(camera, window, pass, batch, count, index, keys)
                  : drawSplatsOf<false>(camera, window, pass, batch, count, index, keys);
}

template <bool Parallel>
void addSplatsOf(const RasterCamera& camera, const RasterWindow& window, const SplatPass& pass,
  RasterBatch& batch, int count, const float* nearest, std::uint32_t* sums)
{
  switch (pass.shape)
  {
    case SplatShape::Disc:
      addShape<SplatShape::Disc, Parallel>(camera, window, pass, batch, count, nearest, sums);
      break;
    case SplatShape::Ellipse:
      addShape<SplatShape::Ellipse, Parallel>(camera, window, pass, batch, count, nearest, sums);
      break;
    case SplatShape::ExactEllipse:
      addShape<SplatShape::ExactEllipse, Parallel>(
        camera, window, pass, batch, count, nearest, sums);
      break;
    case SplatShape::Sphere:
      addShape<SplatShape::Sphere, Parallel>(camera, window, pass, batch, count, nearest, sums);
      break;
    case SplatShape::Wall:
      break; // never blended
  }
}

inline void addSplats(const RasterCamera& camera, const RasterWindow& window, const SplatPass& pass,
  RasterBatch& batch, int count, const float* nearest, std::uint32_t* sums)
{
  camera.parallel ? addSplatsOf<true>(camera, window, pass, batch, count, nearest, sums)
                  : addSplatsOf<false>(camera, window, pass, batch, count, nearest, sums);
}

} // namespace
} // namespace pointfront
