#pragma once

#include "RasterBatch.h"
#include "RasterKernels.h"
#include "SplatSetUp.h"

namespace pointfront
{
namespace
{

// Loops over the pixels of splats, eight at a time, on the Lanes that were included before. No
// branch on the result of the depth test: load, minimum, store.

alignas(32) constexpr float laneX[8] = { 0, 1, 2, 3, 4, 5, 6, 7 };
alignas(32) constexpr float laneX4[8] = { 0, 1, 2, 3, 0, 1, 2, 3 };
alignas(32) constexpr float laneY4[8] = { 0, 0, 0, 0, 1, 1, 1, 1 };

/// One splat at eight pixels.
struct SplatSample
{
  Lanes q;          ///< 0 at the centre, 1 at the rim
  Lanes depth;
  LaneMask covered;
};

/// A splat that is smaller than the distance of pixels covers the one it lies in.
inline LaneMask inCentrePixel(Lanes dx, Lanes dy)
{
  const Lanes half = all(0.5f), minusHalf = all(-0.5f);
  return (dx <= half) & (minusHalf <= dx) & (dy <= half) & (minusHalf <= dy);
}

template <SplatShape Shape, bool Parallel>
struct SplatAt;

template <bool Parallel>
struct SplatAt<SplatShape::Disc, Parallel>
{
  SplatAt(const RasterCamera&, const SplatPass&, const RasterBatch& batch, int j)
    : inverse(all(batch.inverseRadius2[j]))
    , depth(all(batch.depth[j]))
  {
  }
  SplatSample at(Lanes dx, Lanes dy) const
  {
    const Lanes q = inverse * (dx * dx + dy * dy);
    return { q, depth, q <= all(1.0f) };
  }
  Lanes inverse;
  Lanes depth;
};

template <bool Parallel>
struct SplatAt<SplatShape::Ellipse, Parallel>
{
  SplatAt(const RasterCamera&, const SplatPass&, const RasterBatch& batch, int j)
    : xx(all(batch.quadraticXX[j]))
    , xy(all(batch.quadraticXY[j]))
    , yy(all(batch.quadraticYY[j]))
    , slopeX(all(batch.slopeX[j]))
    , slopeY(all(batch.slopeY[j]))
    , radius(all(batch.radius[j]))
    , depth(all(batch.depth[j]))
  {
  }
  SplatSample at(Lanes dx, Lanes dy) const
  {
    const Lanes form = (xx * dx + xy * dy) * dx + yy * dy * dy;
    const Lanes q = choose(inCentrePixel(dx, dy), smaller(form, all(0.999f)), form);
    const Lanes rise = slopeX * dx + slopeY * dy;
    const Lanes bounded = larger(smaller(rise, radius), all(0.0f) - radius);
    return { q, depth + bounded, q <= all(1.0f) };
  }
  Lanes xx, xy, yy, slopeX, slopeY, radius, depth;
};

/// The ray through the pixel is the centre's plus a small offset: all is computed from that offset,
/// so that nothing cancels. t is the depth where the ray meets the disc's plane, u the way from the
/// centre to there.
template <bool Parallel>
struct SplatAt<SplatShape::ExactEllipse, Parallel>
{
  SplatAt(const RasterCamera& camera, const SplatPass& pass, const RasterBatch& batch, int j)
    : nx(all(batch.normalX[j]))
    , ny(all(batch.normalY[j]))
    , inverse(all(batch.inverseRadius2[j]))
    , depth(all(batch.depth[j]))
    , widthX(all(1.0f / camera.scaleX))
    , widthY(all(1.0f / camera.scaleY))
    , filter(all(pass.lowPass > 0.0f ? 1.0f / (pass.lowPass * pass.lowPass) : 0.0f))
    , filtered(pass.lowPass > 0.0f)
  {
    const Direction to = directionOf<Parallel>(camera, batch, j);
    toX = all(to.x);
    toY = all(to.y);
    facing = all(batch.normalX[j] * to.x + batch.normalY[j] * to.y + batch.normalZ[j]);
  }
  SplatSample at(Lanes dx, Lanes dy) const
  {
    const Lanes x = dx * widthX, y = dy * widthY;
    const Lanes turned = nx * x + ny * y;
    const Lanes further =
      Parallel ? all(0.0f) - turned / facing : all(0.0f) - depth * turned / (facing + turned);
    const Lanes t = depth + further;
    const Lanes ux = Parallel ? x : further * toX + t * x;
    const Lanes uy = Parallel ? y : further * toY + t * y;
    const Lanes q = (ux * ux + uy * uy + further * further) * inverse;
    const LaneMask onDisc = (q <= all(1.0f)) & (all(1.0e-30f) <= t);
    const LaneMask centre = inCentrePixel(dx, dy);
    const Lanes distance = filtered ? (dx * dx + dy * dy) * filter : all(2.0f);
    const Lanes near = choose(centre, smaller(distance, all(0.999f)), distance);
    SplatSample sample;
    sample.q = choose(onDisc, smaller(q, near), near);
    sample.depth = choose(onDisc, t, depth);
    sample.covered = onDisc | (near <= all(1.0f));
    return sample;
  }
  Lanes nx, ny, inverse, depth, widthX, widthY, filter;
  Lanes toX, toY, facing;
  bool filtered;
};

/// As above; p is the way from the sphere's centre to the ray's nearest point, `half` from there to
/// the surface.
template <bool Parallel>
struct SplatAt<SplatShape::Sphere, Parallel>
{
  SplatAt(const RasterCamera& camera, const SplatPass&, const RasterBatch& batch, int j)
    : inverse(all(batch.inverseRadius2[j]))
    , square(all(batch.radius[j] * batch.radius[j]))
    , depth(all(batch.depth[j]))
    , widthX(all(1.0f / camera.scaleX))
    , widthY(all(1.0f / camera.scaleY))
  {
    const Direction to = directionOf<Parallel>(camera, batch, j);
    toX = all(to.x);
    toY = all(to.y);
    length2 = all(1.0f + to.x * to.x + to.y * to.y);
  }
  SplatSample at(Lanes dx, Lanes dy) const
  {
    const Lanes x = dx * widthX, y = dy * widthY;
    const Lanes aside = toX * x + toY * y;
    const Lanes offset2 = x * x + y * y;
    const Lanes ray2 = Parallel ? all(1.0f) : length2 + aside + aside + offset2;
    const Lanes nearest = Parallel ? all(0.0f) : all(0.0f) - depth * (aside + offset2) / ray2;
    const Lanes t = depth + nearest;
    const Lanes px = Parallel ? x : nearest * toX + t * x;
    const Lanes py = Parallel ? y : nearest * toY + t * y;
    const Lanes distance2 = px * px + py * py + nearest * nearest;
    const Lanes within = larger(square - distance2, all(0.0f));
    const Lanes front = t - rootOf(within / ray2);
    const LaneMask centre = inCentrePixel(dx, dy);
    SplatSample sample;
    sample.q = distance2 * inverse;
    sample.depth = front;
    sample.covered = ((distance2 <= square) | centre) & (all(1.0e-30f) <= front);
    return sample;
  }
  Lanes inverse, square, depth, widthX, widthY, toX, toY, length2;
};

/// Calls `take` with two rows of four pixels: offsets in the buffers, sample.
template <typename Splat, typename Take>
inline void visitSmall(const RasterWindow& window, const RasterBatch& batch, int j,
  const Splat& splat, const Take& take)
{
  const std::int32_t stride = window.stride;
  const std::int32_t offset = batch.offset[j];
  const Lanes dx = all(batch.firstX[j]) + load8(laneX4);
  const Lanes dy = all(batch.firstY[j]) + load8(laneY4);
  take(offset, offset + stride, splat.at(dx, dy));
  take(offset + 2 * stride, offset + 3 * stride, splat.at(dx, dy + all(2.0f)));
}

/// Of a splat that may be larger than the margin: its rectangle inside the window.
struct SplatRectangle
{
  std::int32_t offset;
  float left; ///< first pixel's centre less the splat's
  float low;
  int rows;
  int columns;
};
inline SplatRectangle clippedRectangle(
  const RasterWindow& window, const RasterBatch& batch, int j)
{
  const auto clamped = [](float x, float least, float most)
  { return x > least ? (x < most ? x : most) : least; };
  const auto right = static_cast<float>(window.width - 1);
  const auto bottom = static_cast<float>(window.bottom);
  const auto top = static_cast<float>(window.bottom + window.height - 1);
  const float hx = batch.halfX[j] + 0.5f, hy = batch.halfY[j] + 0.5f;
  const float x0 = clamped(__builtin_ceilf(batch.middleX[j] - hx), 0.0f, right);
  const float x1 = clamped(__builtin_floorf(batch.middleX[j] + hx - 1.0f), 0.0f, right);
  const float y0 = clamped(__builtin_ceilf(batch.middleY[j] - hy), bottom, top);
  const float y1 = clamped(__builtin_floorf(batch.middleY[j] + hy - 1.0f), bottom, top);
  return { window.at(static_cast<int>(x0), static_cast<int>(y0) - window.bottom),
    x0 + 0.5f - batch.screenX[j], y0 + 0.5f - batch.screenY[j], static_cast<int>(y1 - y0) + 1,
    static_cast<int>(x1 - x0) + 1 };
}

/// Calls `take` with eight pixels of a row each: offset in the buffers, sample.
template <typename Splat, typename Take>
inline void visitLarge(const RasterWindow& window, const RasterBatch& batch, int j,
  const Splat& splat, const Take& take)
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

/// The points of the batch that are small, or larger, in a list: loops over one kind have no branch
/// that cannot be foreseen.
inline int listSmall(RasterBatch& batch, int count)
{
  int listed = 0;
  for (int j = 0; j < count; ++j)
  {
    batch.list[listed] = j;
    listed += batch.extent[j] == RasterBatch::Within4;
  }
  return listed;
}
inline int listLarge(RasterBatch& batch, int count)
{
  int listed = 0;
  for (int j = 0; j < count; ++j)
  {
    batch.list[listed] = j;
    listed += batch.extent[j] > RasterBatch::Within4;
  }
  return listed;
}

template <SplatShape Shape, bool Parallel>
void drawShape(const RasterCamera& camera, const RasterWindow& window, const SplatPass& pass,
  RasterBatch& batch, int count, std::uint32_t index, RasterKey* keys)
{
  const int small = listSmall(batch, count);
  for (int i = 0; i < small; ++i)
  {
    const int j = batch.list[i];
    const SplatAt<Shape, Parallel> splat(camera, pass, batch, j);
    const Lanes rim = all(pass.paraboloid * batch.radius[j]);
    const std::uint32_t id = index + static_cast<std::uint32_t>(j);
    visitSmall(window, batch, j, splat,
      [&](std::int32_t lower, std::int32_t upper, const SplatSample& s)
      { keepNearest4x2(keys + lower, keys + upper, s.depth + rim * s.q, id, s.covered); });
  }
  const int large = listLarge(batch, count);
  for (int i = 0; i < large; ++i)
  {
    const int j = batch.list[i];
    const SplatAt<Shape, Parallel> splat(camera, pass, batch, j);
    const Lanes rim = all(pass.paraboloid * batch.radius[j]);
    const std::uint32_t id = index + static_cast<std::uint32_t>(j);
    visitLarge(window, batch, j, splat,
      [&](std::int32_t offset, const SplatSample& s)
      { keepNearest8(keys + offset, s.depth + rim * s.q, id, s.covered); });
  }
}

/// Weights (1 - q)^2 in 6 bits: 267,000 splats on a pixel before a sum could overflow.
inline LaneWeights weightsOf(const SplatSample& s, LaneMask added)
{
  const Lanes fall = all(1.0f) - s.q;
  return weights(fall * fall * all(63.0f) + all(0.5f), added);
}

template <SplatShape Shape, bool Parallel>
void addShape(const RasterCamera& camera, const RasterWindow& window, const SplatPass& pass,
  RasterBatch& batch, int count, const float* nearest, std::uint32_t* sums)
{
  const float pixelSize = pass.slackPixels / camera.scaleY;
  const auto slackOf = [&](int j)
  {
    return all(
      pass.slackRadii * batch.radius[j] + pixelSize * (Parallel ? 1.0f : batch.depth[j]));
  };
  const int small = listSmall(batch, count);
  for (int i = 0; i < small; ++i)
  {
    const int j = batch.list[i];
    const SplatAt<Shape, Parallel> splat(camera, pass, batch, j);
    const Lanes rim = all(pass.paraboloid * batch.radius[j]), slack = slackOf(j);
    const LaneColour colour = colourOf(batch.colour[j]);
    visitSmall(window, batch, j, splat,
      [&](std::int32_t lower, std::int32_t upper, const SplatSample& s)
      {
        const LaneMask added =
          s.covered & (s.depth + rim * s.q - slack <= load4x2(nearest + lower, nearest + upper));
        if (any(added))
        {
          addSums4x2(sums + 4 * std::int64_t(lower), sums + 4 * std::int64_t(upper),
            weightsOf(s, added), colour);
        }
      });
  }
  const int large = listLarge(batch, count);
  for (int i = 0; i < large; ++i)
  {
    const int j = batch.list[i];
    const SplatAt<Shape, Parallel> splat(camera, pass, batch, j);
    const Lanes rim = all(pass.paraboloid * batch.radius[j]), slack = slackOf(j);
    const LaneColour colour = colourOf(batch.colour[j]);
    visitLarge(window, batch, j, splat,
      [&](std::int32_t offset, const SplatSample& s)
      {
        const LaneMask added =
          s.covered & (s.depth + rim * s.q - slack <= load8(nearest + offset));
        if (any(added))
        {
          addSums8(sums + 4 * std::int64_t(offset), weightsOf(s, added), colour);
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
      drawShape<SplatShape::Sphere, Parallel>(camera, window, pass, batch, count, index, keys);
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
  }
}

inline void addSplats(const RasterCamera& camera, const RasterWindow& window,
  const SplatPass& pass, RasterBatch& batch, int count, const float* nearest, std::uint32_t* sums)
{
  camera.parallel ? addSplatsOf<true>(camera, window, pass, batch, count, nearest, sums)
                  : addSplatsOf<false>(camera, window, pass, batch, count, nearest, sums);
}

} // namespace
} // namespace pointfront
