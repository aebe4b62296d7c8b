#include "WinnerResolve.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pointfront
{
namespace
{

/// Beyond that a sum of weighted colours may have overflowed: 2^32 / 255.
constexpr std::uint32_t mostWeight = 16843009u;

float depthOf(RasterKey key)
{
  const auto bits = static_cast<std::uint32_t>(static_cast<std::uint64_t>(key) >> 32);
  float depth;
  std::memcpy(&depth, &bits, 4);
  return depth;
}

/// The target's depths count from the eye's plane; a parallel view's keys count from the near
/// plane.
float fromEye(const RasterItems& items, float depth)
{
  const FrameCamera& camera = items.plan().camera;
  if (!camera.parallel)
  {
    return depth;
  }
  const glm::dmat4& clip = camera.viewToClip;
  return depth + static_cast<float>((clip[3][2] + clip[3][3]) / (clip[2][2] + clip[2][3]));
}

} // namespace

/// Where pixels of one node follow each other they are worked on together.
void WinnerResolve::row(int y, SoftwareTarget& target, int targetRow)
{
  const std::int32_t begin = source_.window.at(0, y);
  RasterKey* const merged = source_.merged + begin;
  const int width = source_.window.width;
  for (std::size_t other = 1; other < source_.keys.size(); ++other)
  {
    const RasterKey* const keys = source_.keys[other] + begin;
    for (int x = 0; x < width; ++x)
    {
      merged[x] = keys[x] < merged[x] ? keys[x] : merged[x];
    }
  }
  for (int x = 0; x < width; ++x)
  {
    if (merged[x] != emptyKey)
    {
      take(y, x, merged[x], target, targetRow);
    }
  }
  flush(y, target, targetRow);
}

void WinnerResolve::take(int y, int x, RasterKey key, SoftwareTarget& target, int targetRow)
{
  const auto index = static_cast<std::uint32_t>(key);
  const bool same = item_ && index - item_->base < item_->node().size();
  const RasterItem& item = same ? *item_ : source_.items->find(index);
  const Winner winner{ x, index - item.base, depthOf(key) };
  if (item.passes.depthInKey() && !source_.normals)
  {
    item_ = waiting_.empty() ? &item : item_;
    const auto pixel = static_cast<std::size_t>(std::int64_t(targetRow) * target.width + x);
    put(item, winner, fromEye(*source_.items, winner.keyDepth), y, target, pixel);
    return;
  }
  if (&item != item_ || waiting_.size() == static_cast<std::size_t>(RasterBatch::size))
  {
    flush(y, target, targetRow);
  }
  item_ = &item;
  waiting_.push_back(winner);
}

bool WinnerResolve::blendedColour(int y, int x, std::uint32_t& rgba) const
{
  const std::int64_t place = 4 * std::int64_t(source_.window.at(x, y));
  std::uint32_t total[4] = { 0, 0, 0, 0 };
  for (const std::uint32_t* const sums : source_.sums)
  {
    for (int c = 0; c < 4; ++c)
    {
      total[c] += sums[place + c];
    }
  }
  if (total[3] == 0 || total[3] > mostWeight)
  {
    return false;
  }
  const std::uint64_t half = total[3] / 2;
  const auto mean = [&](int c)
  { return static_cast<std::uint32_t>((std::uint64_t(total[c]) + half) / total[3]); };
  const std::uint8_t bytes[4] = { static_cast<std::uint8_t>(mean(0)),
    static_cast<std::uint8_t>(mean(1)), static_cast<std::uint8_t>(mean(2)), 255 };
  std::memcpy(&rgba, bytes, 4);
  return true;
}

void WinnerResolve::put(const RasterItem& item, const Winner& winner, float depth, int y,
  SoftwareTarget& target, std::size_t pixel)
{
  if (!(depth < target.depth[pixel]))
  {
    return;
  }
  target.depth[pixel] = depth;
  std::uint32_t rgba = 0;
  const bool blended = item.passes.blended && blendedColour(y, winner.x, rgba);
  target.rgba[pixel] = blended ? rgba : item.colours->at(winner.index);
  if (target.keepPoints)
  {
    target.points[pixel] = { source_.store, item.node().node, winner.index };
  }
}

/// The depth of the splat's plane in that pixel; where the key's was pushed back, or light asks for
/// more than a depth.
float WinnerResolve::planeDepth(const RasterItem& item, int j, int x, int y) const
{
  const SplatPass& pass = item.passes.first;
  const float dx = static_cast<float>(x) + 0.5f - batch_.screenX[j];
  const float dy = static_cast<float>(y + source_.window.bottom) + 0.5f - batch_.screenY[j];
  if (pass.shape == SplatShape::Ellipse)
  {
    const float rise = batch_.slopeX[j] * dx + batch_.slopeY[j] * dy;
    return batch_.depth[j] + std::clamp(rise, -batch_.radius[j], batch_.radius[j]);
  }
  if (pass.shape == SplatShape::ExactEllipse)
  {
    const float perspective = item.camera.parallel ? 0.0f : 1.0f;
    const float toX =
      (batch_.screenX[j] - item.camera.centreX) * (perspective / item.camera.scaleX);
    const float toY =
      (batch_.screenY[j] - item.camera.centreY) * (perspective / item.camera.scaleY);
    const float facing =
      batch_.normalX[j] * toX + batch_.normalY[j] * toY + batch_.normalZ[j];
    const float turned = batch_.normalX[j] * (dx / item.camera.scaleX) +
      batch_.normalY[j] * (dy / item.camera.scaleY);
    const float further = item.camera.parallel
      ? -turned / facing
      : -batch_.depth[j] * turned / (facing + turned);
    const bool met = std::abs(further) <= batch_.radius[j];
    return met ? batch_.depth[j] + further : batch_.depth[j];
  }
  return batch_.depth[j]; // a disc that faces the eye
}

/// View space, towards the eye.
void WinnerResolve::putNormal(
  const RasterItem& item, int j, int x, int y, float depth, float* normal) const
{
  glm::vec3 n(batch_.normalX[j], batch_.normalY[j], -batch_.normalZ[j]);
  if (item.passes.first.shape == SplatShape::Sphere && !item.passes.squares)
  {
    const auto place = [&](float px, float py, float d)
    {
      const float reach = item.camera.parallel ? 1.0f : d;
      return glm::vec3((px - item.camera.centreX) * reach / item.camera.scaleX,
        (py - item.camera.centreY) * reach / item.camera.scaleY, -d);
    };
    n = place(static_cast<float>(x) + 0.5f,
          static_cast<float>(y + source_.window.bottom) + 0.5f, depth) -
      place(batch_.screenX[j], batch_.screenY[j], batch_.depth[j]);
  }
  else if (!item.normals && item.style->orientation != SplatOrientation::Fixed)
  {
    n = glm::vec3(0.0f);
  }
  const float length = glm::length(n);
  n = length > 0.0f ? n / length : n;
  n = n.z < 0.0f && item.passes.first.shape != SplatShape::Sphere ? -n : n;
  normal[0] = n.x;
  normal[1] = n.y;
  normal[2] = n.z;
}

void WinnerResolve::flush(int y, SoftwareTarget& target, int targetRow)
{
  if (waiting_.empty())
  {
    item_ = nullptr;
    return;
  }
  const RasterItem& item = *item_;
  const int count = static_cast<int>(waiting_.size());
  RasterPositions positions = item.positions;
  positions.clippingPlanes = 0; // who won was not clipped
  positions.filtered = false;
  std::uint32_t gathered[3 * RasterBatch::size];
  std::uint32_t points[RasterBatch::size];
  for (int j = 0; j < count; ++j)
  {
    points[j] = waiting_[static_cast<std::size_t>(j)].index;
    std::memcpy(gathered + 3 * j, item.positions.xyz + 3 * std::size_t(points[j]), 12);
  }
  positions.xyz = gathered;
  const RasterKernels& kernels = *source_.kernels;
  kernels.project(item.camera, positions, count, batch_);
  const bool discs = item.passes.squares || item.passes.first.shape == SplatShape::Disc;
  if (!discs || source_.normals)
  {
    source_.items->fillShape(item, points, count, item.passes.firstRadius, batch_);
    kernels.setUp(item.camera, source_.window, item.passes.first, count, batch_);
  }
  for (int j = 0; j < count; ++j)
  {
    const Winner& winner = waiting_[static_cast<std::size_t>(j)];
    const float depth =
      item.passes.depthInKey() ? winner.keyDepth : planeDepth(item, j, winner.x, y);
    const auto pixel = static_cast<std::size_t>(std::int64_t(targetRow) * target.width + winner.x);
    const float eyeDepth = fromEye(*source_.items, depth);
    const bool nearer = eyeDepth < target.depth[pixel];
    put(item, winner, eyeDepth, y, target, pixel);
    if (nearer && source_.normals)
    {
      putNormal(item, j, winner.x, y, depth, &target.normals[3 * pixel]);
    }
  }
  waiting_.clear();
  item_ = nullptr;
}

} // namespace pointfront
