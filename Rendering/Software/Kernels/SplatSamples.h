#pragma once

#include "RasterBatch.h"
#include "RasterKernels.h"
#include "SplatSetUp.h"

namespace pointfront
{
namespace
{

// A splat's value at a pixel, for eight pixels or eight splats at a time, on the Lanes that were
// included before.

/// Splats at pixels, in eight lanes.
struct SplatSample
{
  Lanes q; ///< 0 at the centre, 1 at the rim
  Lanes depth;
  LaneMask covered;
};

/// A splat that is smaller than the distance of pixels covers the one it lies in.
inline LaneMask inCentrePixel(Lanes dx, Lanes dy)
{
  const Lanes half = all(0.5f), minusHalf = all(-0.5f);
  return (dx <= half) & (minusHalf <= dx) & (dy <= half) & (minusHalf <= dy);
}

/// One splat in all lanes, or eight splats that lie one after the other in a batch, one in each.
struct OneSplat
{
  int j;
  Lanes operator()(const float* quantity) const { return all(quantity[j]); }
};
struct EightSplats
{
  int first;
  Lanes operator()(const float* quantity) const { return load8(quantity + first); }
};

/// A splat's shape, to be asked at pixels.
template <SplatShape Shape, bool Parallel>
struct SplatAt;

/// The centre's direction, as directionOf().
struct LaneDirection
{
  Lanes x;
  Lanes y;
};
template <bool Parallel, typename Points>
inline LaneDirection laneDirection(
  const RasterCamera& camera, const RasterBatch& batch, Points points)
{
  const float perspective = Parallel ? 0.0f : 1.0f;
  return { (points(batch.screenX) - all(camera.centreX)) * all(perspective / camera.scaleX),
    (points(batch.screenY) - all(camera.centreY)) * all(perspective / camera.scaleY) };
}

/// A plane through a splat's centre, and where rays of pixels near the centre's meet it. A ray is
/// the centre's plus a small offset: all is computed from that offset, so that nothing cancels.
template <bool Parallel>
struct LanePlane
{
  /// Where a ray meets it.
  struct Place
  {
    Lanes depth;
    Lanes x, y, z; ///< from the centre to there, in view coordinates
  };
  template <typename Points>
  LanePlane(const RasterCamera& camera, const RasterBatch& batch, Points points)
    : nx(points(batch.normalX))
    , ny(points(batch.normalY))
    , depth(points(batch.depth))
    , widthX(all(1.0f / camera.scaleX))
    , widthY(all(1.0f / camera.scaleY))
  {
    const LaneDirection to = laneDirection<Parallel>(camera, batch, points);
    toX = to.x;
    toY = to.y;
    facing = nx * to.x + ny * to.y + points(batch.normalZ);
  }
  /// `dx` and `dy`: the offset in pixels.
  Place at(Lanes dx, Lanes dy) const
  {
    const Lanes x = dx * widthX, y = dy * widthY;
    const Lanes turned = nx * x + ny * y;
    const Lanes further =
      Parallel ? all(0.0f) - turned / facing : all(0.0f) - depth * turned / (facing + turned);
    const Lanes t = depth + further;
    return { t, Parallel ? x : further * toX + t * x, Parallel ? y : further * toY + t * y,
      further };
  }
  Lanes nx, ny, depth, widthX, widthY, toX, toY, facing;
};

template <bool Parallel>
struct SplatAt<SplatShape::Disc, Parallel>
{
  template <typename Points>
  SplatAt(const RasterCamera&, const SplatPass&, const RasterBatch& batch, Points points)
    : inverse(points(batch.inverseRadius2))
    , depth(points(batch.depth))
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
  template <typename Points>
  SplatAt(const RasterCamera&, const SplatPass& pass, const RasterBatch& batch, Points points)
    : xx(points(batch.quadraticXX))
    , xy(points(batch.quadraticXY))
    , yy(points(batch.quadraticYY))
    , slopeX(points(batch.slopeX))
    , slopeY(points(batch.slopeY))
    , radius(points(batch.radius))
    , depth(points(batch.depth))
    , mostAtCentre(all(pass.mostAtCentre()))
  {
  }
  SplatSample at(Lanes dx, Lanes dy) const
  {
    const Lanes form = (xx * dx + xy * dy) * dx + yy * dy * dy;
    const Lanes q = choose(inCentrePixel(dx, dy), smaller(form, mostAtCentre), form);
    const Lanes rise = slopeX * dx + slopeY * dy;
    const Lanes bounded = larger(smaller(rise, radius), all(0.0f) - radius);
    return { q, depth + bounded, q <= all(1.0f) };
  }
  Lanes xx, xy, yy, slopeX, slopeY, radius, depth, mostAtCentre;
};

template <bool Parallel>
struct SplatAt<SplatShape::ExactEllipse, Parallel>
{
  template <typename Points>
  SplatAt(
    const RasterCamera& camera, const SplatPass& pass, const RasterBatch& batch, Points points)
    : plane(camera, batch, points)
    , inverse(points(batch.inverseRadius2))
    , filter(all(pass.lowPass > 0.0f ? 1.0f / (pass.lowPass * pass.lowPass) : 0.0f))
    , mostAtCentre(all(pass.mostAtCentre()))
    , filtered(pass.lowPass > 0.0f)
  {
  }
  SplatSample at(Lanes dx, Lanes dy) const
  {
    const auto met = plane.at(dx, dy);
    const Lanes q = (met.x * met.x + met.y * met.y + met.z * met.z) * inverse;
    const LaneMask onDisc = (q <= all(1.0f)) & (all(1.0e-30f) <= met.depth);
    const LaneMask centre = inCentrePixel(dx, dy);
    const Lanes distance = filtered ? (dx * dx + dy * dy) * filter : all(2.0f);
    const Lanes near = choose(centre, smaller(distance, mostAtCentre), distance);
    SplatSample sample;
    sample.q = choose(onDisc, smaller(q, near), near);
    sample.depth = choose(onDisc, met.depth, plane.depth);
    sample.covered = onDisc | (near <= all(1.0f));
    return sample;
  }
  LanePlane<Parallel> plane;
  Lanes inverse, filter, mostAtCentre;
  bool filtered;
};

/// The ray is computed from its offset, as above; p is the way from the sphere's centre to the
/// ray's nearest point.
template <bool Parallel>
struct SplatAt<SplatShape::Sphere, Parallel>
{
  template <typename Points>
  SplatAt(const RasterCamera& camera, const SplatPass&, const RasterBatch& batch, Points points)
    : inverse(points(batch.inverseRadius2))
    , square(points(batch.radius) * points(batch.radius))
    , depth(points(batch.depth))
    , widthX(all(1.0f / camera.scaleX))
    , widthY(all(1.0f / camera.scaleY))
  {
    const LaneDirection to = laneDirection<Parallel>(camera, batch, points);
    toX = to.x;
    toY = to.y;
    length2 = all(1.0f) + to.x * to.x + to.y * to.y;
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

/// `aside` and `down` are places on the wall. All of it is its rim: pushed back by the paraboloid.
/// Of walls in one plane, as points above each other have, the one is seen whose top is nearest:
/// which one it is must not hang on how a machine rounds their depths.
template <bool Parallel>
struct SplatAt<SplatShape::Wall, Parallel>
{
  template <typename Points>
  SplatAt(const RasterCamera& camera, const SplatPass&, const RasterBatch& batch, Points points)
    : plane(camera, batch, points)
    , rightX(points(batch.quadraticXX))
    , rightY(points(batch.quadraticXY))
    , rightZ(points(batch.quadraticYY))
    , radius(points(batch.radius))
    , height(points(batch.height))
    , upX(all(camera.up[0]))
    , upY(all(camera.up[1]))
    , upZ(all(camera.up[2]))
    , nearest(all(camera.nearDepth))
    , farthest(all(camera.farDepth))
  {
  }
  SplatSample at(Lanes dx, Lanes dy) const
  {
    const auto met = plane.at(dx, dy);
    const Lanes aside = met.x * rightX + met.y * rightY + met.z * rightZ;
    const Lanes down = all(0.0f) - (met.x * upX + met.y * upY + met.z * upZ);
    const LaneMask within =
      (aside <= radius) & (all(0.0f) - radius <= aside) & (all(0.0f) <= down) & (down <= height);
    const LaneMask seen = (nearest <= met.depth) & (met.depth <= farthest);
    return { all(1.0f), met.depth + all(wallFall) * down, within & seen };
  }
  /// Units that a wall lies further back for each unit further down. Tops that are a pixel apart
  /// differ by 20 times as much as the depth of their walls is rounded.
  static constexpr float wallFall = 1.0f / 64.0f;

  LanePlane<Parallel> plane;
  Lanes rightX, rightY, rightZ, radius, height, upX, upY, upZ, nearest, farthest;
};

/// The affine map is good near a splat's centre. Of a splat near the eye it reaches far beyond what
/// the disc can cover, even above the horizon, so pixels count whose rays come near the splat's
/// sphere. What cullBesidePyramid() leaves out has no such pixel: a picture of a part of the
/// viewport is that part of the whole picture.
template <SplatShape Shape, bool Parallel>
struct LargeSplatAt : SplatAt<Shape, Parallel>
{
  using Splat = SplatAt<Shape, Parallel>;
  /// Radii a unit of depth: from there on.
  static constexpr float nearEye = 0.02f;

  LargeSplatAt(const RasterCamera& camera, const SplatPass& pass, const RasterBatch& batch, int j)
    : Splat(camera, pass, batch, OneSplat{ j })
    , bounded(
        Shape == SplatShape::Ellipse && !Parallel && batch.radius[j] > nearEye * batch.depth[j])
    , widthX(all(1.0f / camera.scaleX))
    , widthY(all(1.0f / camera.scaleY))
  {
    const LaneDirection to = laneDirection<Parallel>(camera, batch, OneSplat{ j });
    toX = to.x;
    toY = to.y;
    length2 = all(1.0f) + to.x * to.x + to.y * to.y;
    const float reach = splatReach(batch.radius[j], batch.depth[j], 1.0f / camera.scaleX);
    share2 = all(reach / batch.depth[j] * (reach / batch.depth[j]));
  }
  SplatSample at(Lanes dx, Lanes dy) const
  {
    SplatSample sample = Splat::at(dx, dy);
    if (bounded)
    {
      const Lanes x = dx * widthX, y = dy * widthY;
      const Lanes aside = toX * x + toY * y;
      const Lanes offset2 = x * x + y * y;
      const Lanes ray2 = length2 + aside + aside + offset2;
      sample.covered = sample.covered & (length2 * offset2 - aside * aside <= share2 * ray2);
    }
    return sample;
  }
  bool bounded;
  Lanes widthX, widthY, toX, toY, length2, share2;
};

} // namespace
} // namespace pointfront
