#pragma once

#include "RasterBatch.h"
#include "RasterKernels.h"

namespace pointfront
{
namespace
{

// From radius and normal to what the loops over pixels need. X and Y are the centre's direction:
// its place in camera space divided by its depth (perspective), 0 where rays are parallel. Cameras
// come by value: what might change with each store to the batch keeps compilers from vectorising.

/// Discs are not drawn more edge on than that cosine: what the affine map makes of them then has
/// nothing to do with them (EWA-5).
constexpr float leastCosine = 0.05f;
/// Pixels: what grows from nothing has that radius at least, so that nothing is divided by 0.
constexpr float leastGrown = 0.05f;
/// Radius of a splat that is everywhere: larger than any viewport.
constexpr float everywhere = 1.0e5f;

/// World units from a splat's centre within which it is seen: a little more than its radius,
/// because what covers its centre's pixel reaches over the edge.
inline float splatReach(float radius, float depth, float pixelWidth)
{
  return radius * 1.01f + depth * pixelWidth;
}

struct Direction
{
  float x;
  float y;
};
template <bool Parallel>
inline Direction directionOf(const RasterCamera& camera, const RasterBatch& batch, int j)
{
  const float perspective = Parallel ? 0.0f : 1.0f;
  return { (batch.screenX[j] - camera.centreX) * (perspective / camera.scaleX),
    (batch.screenY[j] - camera.centreY) * (perspective / camera.scaleY) };
}

/// A radius in world units becomes what covers at least a pixel, and what of that is grown.
template <bool Parallel>
inline void widen(
  RasterCamera camera, float leastPixels, float mostPixels, int count, RasterBatch& batch)
{
  const float scale = camera.scaleY;
  const float inverseScale = 1.0f / scale;
  for (int j = 0; j < count; ++j)
  {
    const float reach = Parallel ? 1.0f : batch.depth[j];
    float pixels = batch.radius[j] * scale * batch.inverseReach[j];
    pixels = pixels > leastPixels ? pixels : leastPixels;
    pixels = pixels < mostPixels ? pixels : mostPixels;
    const float grown = pixels * batch.grown[j];
    pixels = grown > leastGrown ? grown : leastGrown;
    batch.halfX[j] = pixels;
    batch.radius[j] = pixels * reach * inverseScale;
  }
}

inline void setUpDiscs(int count, RasterBatch& batch)
{
  for (int j = 0; j < count; ++j)
  {
    const float pixels = batch.halfX[j];
    batch.halfY[j] = pixels;
    batch.inverseRadius2[j] = 1.0f / (pixels * pixels);
    batch.middleX[j] = batch.screenX[j];
    batch.middleY[j] = batch.screenY[j];
  }
}

/// A point without a normal faces the eye. Of any length.
template <bool Parallel>
inline void completeNormals(RasterCamera camera, int count, RasterBatch& batch)
{
  for (int j = 0; j < count; ++j)
  {
    const Direction to = directionOf<Parallel>(camera, batch, j);
    const float x = batch.normalX[j], y = batch.normalY[j], z = batch.normalZ[j];
    const float square = x * x + y * y + z * z;
    const int known = (square > 1e-12f) & (square < 1e12f);
    batch.normalX[j] = known ? x : to.x;
    batch.normalY[j] = known ? y : to.y;
    batch.normalZ[j] = known ? z : 1.0f;
  }
}

inline void normalise(int count, RasterBatch& batch)
{
  for (int j = 0; j < count; ++j)
  {
    const float x = batch.normalX[j], y = batch.normalY[j], z = batch.normalZ[j];
    const float inverse = 1.0f / __builtin_sqrtf(x * x + y * y + z * z);
    batch.normalX[j] = x * inverse;
    batch.normalY[j] = y * inverse;
    batch.normalZ[j] = z * inverse;
  }
}

/// Source  Kovac 2009, 4.1 and 4.2, with the sign of the errata; the affine map's inverse variance
///         with a low-pass added (docs/adr/0016). Roots and divisions make up its cost:
///         bounds that need not be sharp do without.
template <bool Parallel>
inline void setUpEllipses(RasterCamera camera, float lowPass, int count, RasterBatch& batch)
{
  const float filter = lowPass * lowPass;
  const float widthX = 1.0f / camera.scaleX;
  const float widthY = 1.0f / camera.scaleY;
  for (int j = 0; j < count; ++j)
  {
    const Direction to = directionOf<Parallel>(camera, batch, j);
    const float nx = batch.normalX[j], ny = batch.normalY[j], nz = batch.normalZ[j];
    const float reach = Parallel ? 1.0f : batch.depth[j];
    float facing = nx * to.x + ny * to.y + nz;
    const float side = facing < 0.0f ? -1.0f : 1.0f;
    const float aside2 = to.x * to.x + to.y * to.y;
    const float least =
      leastCosine * __builtin_sqrtf((nx * nx + ny * ny + nz * nz) * (1.0f + aside2));
    facing = facing * side;
    facing = facing > least ? facing : least;
    const float pixelX = reach * widthX, pixelY = reach * widthY; // world units at its depth
    const float slope = -side / facing;
    const float gx = nx * slope * pixelX, gy = ny * slope * pixelY;
    const float ax = pixelX + to.x * gx, ay = to.y * gx;
    const float bx = to.x * gy, by = pixelY + to.y * gy;
    const float xx = ax * ax + ay * ay + gx * gx; // q = (xx dx^2 + 2 xy dx dy + yy dy^2) / r^2
    const float xy = ax * bx + ay * by + gx * gy;
    const float yy = bx * bx + by * by + gy * gy;
    const float area = batch.radius[j] * batch.radius[j] / (xx * yy - xy * xy);
    const float varianceX = yy * area + filter;
    const float covariance = -xy * area;
    const float varianceY = xx * area + filter;
    const float back = 1.0f / (varianceX * varianceY - covariance * covariance);
    batch.quadraticXX[j] = varianceY * back;
    batch.quadraticXY[j] = -2.0f * covariance * back;
    batch.quadraticYY[j] = varianceX * back;
    batch.slopeX[j] = gx;
    batch.slopeY[j] = gy;
    const float halfX = __builtin_sqrtf(varianceX), halfY = __builtin_sqrtf(varianceY);
    // The disc is inside its sphere; its affine image need not be, far from the middle of the view.
    // Of a sphere of angular size s: s sqrt(1 + x^2) / (1 - s^2), from above.
    const float size = batch.halfX[j] * widthY;
    const float size2 = size * size;
    const float bent = Parallel ? 1.0f : 1.0f + 5.27f * (size2 < 0.81f ? size2 : 0.81f);
    const float mostX = size * camera.scaleX * (1.0f + 0.5f * to.x * to.x) * bent + 1.0f;
    const float mostY = size * camera.scaleY * (1.0f + 0.5f * to.y * to.y) * bent + 1.0f;
    const float withinX = halfX < mostX ? halfX : mostX;
    const float withinY = halfY < mostY ? halfY : mostY;
    batch.halfX[j] = withinX > 0.5f ? withinX : 0.5f;
    batch.halfY[j] = withinY > 0.5f ? withinY : 0.5f;
    batch.middleX[j] = batch.screenX[j];
    batch.middleY[j] = batch.screenY[j];
  }
}

/// Where a conic is on screen: centre and half width along one axis, in units of the direction,
/// from three entries of its dual, taken relative to the centre's direction so that nothing
/// cancels. A conic that comes near the eye's plane is everywhere.
struct ConicExtent
{
  float middle;
  float half;
};
inline ConicExtent conicExtent(float a00, float a02, float a22, float depth)
{
  const float root2 = a02 * a02 - a00 * a22;
  const float root = __builtin_sqrtf(root2 > 0.0f ? root2 : 0.0f);
  const int bounded = a22 < -1.0e-3f * depth * depth;
  const float inverse = 1.0f / (bounded ? a22 : -1.0f);
  return { bounded ? a02 * inverse : 0.0f, bounded ? -root * inverse : everywhere };
}

/// The dual conic of the disc r (cos t u + sin t v) + c is r^2 (I - n n^T) - c c^T.
template <bool Parallel>
inline void setUpExact(RasterCamera camera, float lowPass, int count, RasterBatch& batch)
{
  for (int j = 0; j < count; ++j)
  {
    const Direction to = directionOf<Parallel>(camera, batch, j);
    const float nx = batch.normalX[j], ny = batch.normalY[j], nz = batch.normalZ[j];
    const float depth = batch.depth[j];
    const float square = batch.radius[j] * batch.radius[j];
    const float tiltX = nx - to.x * nz, tiltY = ny - to.y * nz;
    const float a22 = square * (1.0f - nz * nz) - depth * depth;
    const ConicExtent x = conicExtent(
      square * (1.0f + to.x * to.x - tiltX * tiltX), square * (-to.x - tiltX * nz), a22, depth);
    const ConicExtent y = conicExtent(
      square * (1.0f + to.y * to.y - tiltY * tiltY), square * (-to.y - tiltY * nz), a22, depth);
    const float flatX = 1.0f - nx * nx, flatY = 1.0f - ny * ny;
    const float parallelX = batch.radius[j] * __builtin_sqrtf(flatX > 0.0f ? flatX : 0.0f);
    const float parallelY = batch.radius[j] * __builtin_sqrtf(flatY > 0.0f ? flatY : 0.0f);
    const float halfX = (Parallel ? parallelX : x.half) * camera.scaleX;
    const float halfY = (Parallel ? parallelY : y.half) * camera.scaleY;
    const float least = lowPass > 0.5f ? lowPass : 0.5f;
    // The low-pass lies around the centre, which the conic's middle need not be near.
    const float moveX = Parallel ? 0.0f : x.middle * camera.scaleX;
    const float moveY = Parallel ? 0.0f : y.middle * camera.scaleY;
    const float sideX = moveX < 0.0f ? -moveX : moveX, sideY = moveY < 0.0f ? -moveY : moveY;
    batch.halfX[j] = halfX > least + sideX ? halfX : least + sideX;
    batch.halfY[j] = halfY > least + sideY ? halfY : least + sideY;
    batch.middleX[j] = batch.screenX[j] + moveX;
    batch.middleY[j] = batch.screenY[j] + moveY;
    batch.inverseRadius2[j] = 1.0f / square;
  }
}

/// The dual conic of a sphere's outline is r^2 I - c c^T. A sphere around the eye shows nothing:
/// its near side is behind.
template <bool Parallel>
inline void setUpSpheres(RasterCamera camera, int count, RasterBatch& batch)
{
  for (int j = 0; j < count; ++j)
  {
    const Direction to = directionOf<Parallel>(camera, batch, j);
    const float depth = batch.depth[j];
    const float square = batch.radius[j] * batch.radius[j];
    const float a22 = square - depth * depth;
    const ConicExtent x = conicExtent(square * (1.0f + to.x * to.x), -square * to.x, a22, depth);
    const ConicExtent y = conicExtent(square * (1.0f + to.y * to.y), -square * to.y, a22, depth);
    const float flat = batch.radius[j];
    batch.halfX[j] = (Parallel ? flat : x.half) * camera.scaleX;
    batch.halfY[j] = (Parallel ? flat : y.half) * camera.scaleY;
    batch.middleX[j] = batch.screenX[j] + (Parallel ? 0.0f : x.middle * camera.scaleX);
    batch.middleY[j] = batch.screenY[j] + (Parallel ? 0.0f : y.middle * camera.scaleY);
    batch.inverseRadius2[j] = 1.0f / square;
    const float distance2 = depth * depth * (1.0f + to.x * to.x + to.y * to.y);
    const int outside = Parallel | (distance2 > square);
    batch.depth[j] = outside ? depth : -1.0f;
  }
}

/// Beyond that the eye looks along a wall: nothing of it is seen.
constexpr float leastWallSine = 1.0e-3f;

/// A wall's plane is upright and turned towards the eye about the point's vertical; its rectangle
/// on screen is that of its corners. What goes down behind the near plane ends there.
template <bool Parallel>
inline void setUpWalls(RasterCamera camera, int count, RasterBatch& batch)
{
  const float upX = camera.up[0], upY = camera.up[1], upZ = camera.up[2];
  const float nearDepth = camera.nearDepth;
  for (int j = 0; j < count; ++j)
  {
    const Direction to = directionOf<Parallel>(camera, batch, j);
    const float depth = batch.depth[j], radius = batch.radius[j], height = batch.height[j];
    const float along = to.x * upX + to.y * upY + upZ;
    const float nx = along * upX - to.x, ny = along * upY - to.y, nz = along * upZ - 1.0f;
    const float square = nx * nx + ny * ny + nz * nz;
    const float length2 = 1.0f + to.x * to.x + to.y * to.y;
    const int seen =
      (square > leastWallSine * leastWallSine * length2) & (height > 0.0f) & (depth >= 0.0f);
    const float inverse = 1.0f / __builtin_sqrtf(seen ? square : 1.0f);
    const float px = nx * inverse, py = ny * inverse, pz = nz * inverse;
    const float rightX = upY * pz - upZ * py;
    const float rightY = upZ * px - upX * pz;
    const float rightZ = upX * py - upY * px;
    const float ahead = depth - nearDepth;
    const float most = height * upZ > ahead ? ahead / upZ : height;
    const float downX = -most * upX, downY = -most * upY, downZ = -most * upZ;
    const float sideX = radius * rightX, sideY = radius * rightY, sideZ = radius * rightZ;
    float x0 = 0.0f, x1 = 0.0f, y0 = 0.0f, y1 = 0.0f;
    for (int corner = 0; corner < 4; ++corner)
    {
      const float side = corner % 2 == 0 ? -1.0f : 1.0f;
      const float down = corner < 2 ? 0.0f : 1.0f;
      const float z = side * sideZ + down * downZ;
      const float there = depth + z > nearDepth ? depth + z : nearDepth;
      const float reach = 1.0f / (Parallel ? 1.0f : (there > 1.0e-30f ? there : 1.0e-30f));
      const float x = (side * sideX + down * downX - to.x * z) * reach;
      const float y = (side * sideY + down * downY - to.y * z) * reach;
      x0 = x < x0 ? x : x0;
      x1 = x > x1 ? x : x1;
      y0 = y < y0 ? y : y0;
      y1 = y > y1 ? y : y1;
    }
    x0 = x0 * camera.scaleX > -everywhere ? x0 * camera.scaleX : -everywhere;
    x1 = x1 * camera.scaleX < everywhere ? x1 * camera.scaleX : everywhere;
    y0 = y0 * camera.scaleY > -everywhere ? y0 * camera.scaleY : -everywhere;
    y1 = y1 * camera.scaleY < everywhere ? y1 * camera.scaleY : everywhere;
    batch.halfX[j] = 0.5f * (x1 - x0);
    batch.halfY[j] = 0.5f * (y1 - y0);
    batch.middleX[j] = batch.screenX[j] + 0.5f * (x0 + x1);
    batch.middleY[j] = batch.screenY[j] + 0.5f * (y0 + y1);
    batch.normalX[j] = px;
    batch.normalY[j] = py;
    batch.normalZ[j] = pz;
    batch.quadraticXX[j] = rightX;
    batch.quadraticXY[j] = rightY;
    batch.quadraticYY[j] = rightZ;
    batch.depth[j] = seen ? depth : -1.0f;
  }
}

/// Splats whose spheres are outside the pyramid through the window are culled: rectangles of what
/// reaches behind the eye say nothing.
inline void cullBesidePyramid(
  RasterCamera camera, RasterWindow window, int count, RasterBatch& batch)
{
  const float right =
    (static_cast<float>(window.left + window.width) - camera.centreX) / camera.scaleX;
  const float left = (camera.centreX - static_cast<float>(window.left)) / camera.scaleX;
  const float up =
    (static_cast<float>(window.bottom + window.height) - camera.centreY) / camera.scaleY;
  const float down = (camera.centreY - static_cast<float>(window.bottom)) / camera.scaleY;
  const float lengthRight = __builtin_sqrtf(1.0f + right * right);
  const float lengthLeft = __builtin_sqrtf(1.0f + left * left);
  const float lengthUp = __builtin_sqrtf(1.0f + up * up);
  const float lengthDown = __builtin_sqrtf(1.0f + down * down);
  const float widthX = 1.0f / camera.scaleX, widthY = 1.0f / camera.scaleY;
  for (int j = 0; j < count; ++j)
  {
    const float depth = batch.depth[j];
    const float x = (batch.screenX[j] - camera.centreX) * widthX;
    const float y = (batch.screenY[j] - camera.centreY) * widthY;
    const float reach = splatReach(batch.radius[j], depth, widthX);
    const int seen = ((x - right) * depth <= reach * lengthRight) &
      ((-left - x) * depth <= reach * lengthLeft) & ((y - up) * depth <= reach * lengthUp) &
      ((-down - y) * depth <= reach * lengthDown);
    batch.depth[j] = seen ? depth : -1.0f;
  }
}

/// Bounding rectangles in pixels, and which loop draws them.
inline void sortByExtent(const RasterWindow& window, int count, RasterBatch& batch)
{
  const auto left = static_cast<float>(window.left);
  const auto right = static_cast<float>(window.left + window.width);
  const auto bottom = static_cast<float>(window.bottom);
  const auto top = static_cast<float>(window.bottom + window.height);
  const std::int32_t stride = window.stride;
  const std::int32_t corner = window.at(-window.left, -window.bottom);
  // Loops draw up to seven pixels more than a rectangle has.
  constexpr auto margin = static_cast<float>(rasterMargin);
  const float leftmost = left - margin, rightmost = right + margin - 8.0f;
  const float lowest = bottom - margin, highest = top + margin - 8.0f;
  for (int j = 0; j < count; ++j)
  {
    const float hx = batch.halfX[j], hy = batch.halfY[j];
    const float mx = batch.middleX[j], my = batch.middleY[j];
    const float larger = hx > hy ? hx : hy;
    const float x0 = __builtin_ceilf(mx - hx - 0.5f), y0 = __builtin_ceilf(my - hy - 0.5f);
    const float x1 = __builtin_floorf(mx + hx - 0.5f), y1 = __builtin_floorf(my + hy - 0.5f);
    const int seen =
      (batch.depth[j] >= 0.0f) & (x1 >= left) & (x0 < right) & (y1 >= bottom) & (y0 < top);
    // A splat may be small and yet reach over the margin: its centre is beyond the edge.
    const int inMargin = (x0 >= leftmost) & (x1 < rightmost) & (y0 >= lowest) & (y1 < highest);
    const int fits = seen & inMargin & (larger <= largestUnclipped);
    const float across = x1 - x0 > y1 - y0 ? x1 - x0 : y1 - y0;
    const int extent = RasterBatch::Within2 + (across > 1.0f) + (larger > 2.0f);
    batch.extent[j] = fits ? extent : seen * static_cast<int>(RasterBatch::Clipped);
    const float first = fits ? x0 : 0.0f, low = fits ? y0 : 0.0f;
    batch.firstX[j] = first + 0.5f - batch.screenX[j];
    batch.firstY[j] = low + 0.5f - batch.screenY[j];
    batch.offset[j] =
      corner + static_cast<std::int32_t>(low) * stride + static_cast<std::int32_t>(first);
    batch.rows[j] = static_cast<std::int32_t>(fits ? y1 - y0 + 1.0f : 0.0f);
    batch.columns[j] = static_cast<std::int32_t>(fits ? x1 - x0 + 1.0f : 0.0f);
  }
  for (int j = count; j < RasterBatch::size && j % 8 != 0; ++j)
  {
    batch.extent[j] = RasterBatch::Culled; // lanes behind the last splat
  }
}

template <bool Parallel>
void setUpOf(const RasterCamera& camera, const SplatPass& pass, int count, RasterBatch& batch)
{
  widen<Parallel>(camera, pass.leastRadius, pass.mostRadius, count, batch);
  switch (pass.shape)
  {
    case SplatShape::Disc:
      setUpDiscs(count, batch);
      break;
    case SplatShape::Ellipse:
      completeNormals<Parallel>(camera, count, batch);
      setUpEllipses<Parallel>(camera, pass.lowPass, count, batch);
      break;
    case SplatShape::ExactEllipse:
      completeNormals<Parallel>(camera, count, batch);
      normalise(count, batch);
      setUpExact<Parallel>(camera, pass.lowPass, count, batch);
      break;
    case SplatShape::Sphere:
      setUpSpheres<Parallel>(camera, count, batch);
      break;
    case SplatShape::Wall:
      setUpWalls<Parallel>(camera, count, batch);
      break;
  }
}

inline void setUp(const RasterCamera& camera, const RasterWindow& window, const SplatPass& pass,
  int count, RasterBatch& batch)
{
  camera.parallel ? setUpOf<true>(camera, pass, count, batch)
                  : setUpOf<false>(camera, pass, count, batch);
  if (!camera.parallel && pass.shape != SplatShape::Wall)
  {
    cullBesidePyramid(camera, window, count, batch);
  }
  sortByExtent(window, count, batch);
}

} // namespace
} // namespace pointfront
