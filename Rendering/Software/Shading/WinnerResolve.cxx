#include "WinnerResolve.h"

#include "PointShapes.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pointfront
{
namespace
{

/// Beyond that a sum of weighted colours may have overflowed: 2^32 / 255.
constexpr std::uint32_t mostWeight = 16843009u;

/// Winners that are found before they are resolved: what is fetched for them fits in a cache.
constexpr std::size_t winnersAtOnce = 4096;
constexpr float standInRadii = 2.0f;

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

/// How far a stand-in has to be in front of what is drawn at its final size: splats as coarse as
/// that say no more about where the surface is.
float standInSlack(const RasterItem& item, float depth)
{
  const float reach = item.camera.parallel ? 1.0f : depth;
  const float pixels = item.passes.first.leastRadius * reach / item.camera.scaleY;
  return standInRadii * std::max(item.radius, pixels);
}

/// Mixes a colour and another, that share from the first one; opaque.
std::uint32_t bytesOf(const Rgba8& from, const Rgba8& to, float share)
{
  std::uint8_t bytes[4] = { 0, 0, 0, 255 };
  for (std::size_t c = 0; c < 3; ++c)
  {
    const auto begin = static_cast<float>(from[c]), end = static_cast<float>(to[c]);
    bytes[c] = static_cast<std::uint8_t>(begin + (end - begin) * share + 0.5f);
  }
  std::uint32_t rgba;
  std::memcpy(&rgba, bytes, 4);
  return rgba;
}

} // namespace

void WinnerResolve::merge(int y)
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
}

void WinnerResolve::find(int y)
{
  const RasterKey* const merged = source_.merged + source_.window.at(0, y);
  const RasterItem* const items = source_.items->items().data();
  const ItemNumbers& numbers = source_.items->numbers();
  const std::int64_t most = std::int64_t(winnersAtOnce) + source_.window.width;
  Winner* const found = winners_.found.ofSize(most);
  std::uint32_t* const itemOfFound = winners_.item.ofSize(most);
  std::size_t count = winners_.count;
  std::uint32_t item = 0, begin = 0, end = 0;
  std::int64_t fetched = -1;
  for (int x = 0; x < source_.window.width; ++x)
  {
    const RasterKey key = merged[x];
    if (key == emptyKey)
    {
      continue;
    }
    const auto index = static_cast<std::uint32_t>(key);
    if (index < begin || index >= end)
    {
      item = numbers.itemOf(index);
      begin = numbers.beginOf(item);
      end = numbers.endOf(item);
    }
    if (source_.standIns && items[item].item->covered)
    {
      continue;
    }
    if (index != fetched) // else the splat of the pixel before
    {
      items[item].fetchAhead(index - begin);
      fetched = index;
    }
    if (winners_.places[item]++ == 0)
    {
      winners_.touched.push_back(item);
    }
    found[count] = { x, y, index - begin, depthOf(key) };
    itemOfFound[count] = item;
    ++count;
  }
  winners_.count = count;
}

void WinnerResolve::sortByItem()
{
  Winner* const sorted = winners_.sorted.ofSize(static_cast<std::int64_t>(winners_.count));
  const Winner* const found = winners_.found.data();
  const std::uint32_t* const itemOfFound = winners_.item.data();
  std::uint32_t next = 0;
  for (const std::uint32_t number : winners_.touched)
  {
    const std::uint32_t count = winners_.places[number];
    winners_.places[number] = next;
    next += count;
  }
  for (std::size_t i = 0; i < winners_.count; ++i)
  {
    sorted[winners_.places[itemOfFound[i]]++] = found[i];
  }
}

void WinnerResolve::resolveFound(SoftwareTarget& target)
{
  sortByItem();
  const std::vector<RasterItem>& items = source_.items->items();
  std::uint32_t begin = 0;
  for (const std::uint32_t number : winners_.touched)
  {
    const std::uint32_t end = winners_.places[number];
    for (; begin < end; begin += std::min<std::uint32_t>(RasterBatch::size, end - begin))
    {
      const auto count = static_cast<int>(std::min<std::uint32_t>(RasterBatch::size, end - begin));
      resolve(items[number], winners_.sorted.data() + begin, count, target);
    }
    winners_.places[number] = 0;
  }
  winners_.count = 0;
  winners_.touched.clear();
}

void WinnerResolve::rows(int begin, int end, SoftwareTarget& target)
{
  winners_.places.resize(source_.items->items().size(), 0u);
  for (int y = begin; y < end; ++y)
  {
    merge(y);
    find(y);
    if (winners_.count >= winnersAtOnce || y + 1 == end)
    {
      resolveFound(target);
    }
  }
}

bool WinnerResolve::blendedColour(const Winner& winner, std::uint32_t& rgba) const
{
  const std::int64_t place = 4 * std::int64_t(source_.window.at(winner.x, winner.y));
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
  // Exact: a quotient of such integers is no integer, or further from one than doubles round by.
  const double half = total[3] >> 1, weight = total[3];
  const auto mean = [&](int c) { return static_cast<std::uint32_t>((total[c] + half) / weight); };
  const std::uint8_t bytes[4] = { static_cast<std::uint8_t>(mean(0)),
    static_cast<std::uint8_t>(mean(1)), static_cast<std::uint8_t>(mean(2)), 255 };
  std::memcpy(&rgba, bytes, 4);
  return true;
}

/// False where what was drawn before is nearer, by what decides who is seen.
bool WinnerResolve::put(const RasterItem& item, int j, const Winner& winner, float depth,
  SoftwareTarget& target, std::size_t pixel)
{
  const float eyeDepth = fromEye(*source_.items, depth);
  if (source_.standIns && !(eyeDepth + standInSlack(item, depth) < target.depth[pixel]))
  {
    return false;
  }
  if (target.keepDecided)
  {
    const float decided = fromEye(*source_.items, winner.keyDepth);
    if (!(decided < target.decided[pixel]))
    {
      return false;
    }
    target.decided[pixel] = decided;
  }
  else if (!(eyeDepth < target.depth[pixel]))
  {
    return false;
  }
  target.depth[pixel] = eyeDepth;
  target.rgba[pixel] = colourOf(item, j, winner, depth);
  if (!target.highlights.empty())
  {
    target.highlights[pixel] = item.style->highlight;
  }
  if (!target.looks.empty())
  {
    target.looks[pixel] = item.style->look;
  }
  if (target.keepPoints)
  {
    target.points[pixel] = { source_.store, item.node().node, winner.index };
  }
  return true;
}

std::uint32_t WinnerResolve::colourOf(
  const RasterItem& item, int j, const Winner& winner, float depth) const
{
  const SplatPass& pass = item.passes.first;
  std::uint32_t rgba = 0;
  if (item.passes.blended && blendedColour(winner, rgba))
  {
    return rgba;
  }
  // The key says which part it is: rims are pushed back by far more than depths are rounded.
  const float inner = (pass.paraboloid * pass.rimFrom + 0.5f * pass.rimRadii);
  if (pass.rimmed() && winner.keyDepth - depth > inner * batch_.radius[j])
  {
    return bytesOf(item.style->rim, item.style->rim, 0.0f);
  }
  if (item.passes.walls() && item.style->wall)
  {
    const float* const up = item.camera.up;
    const float down =
      -glm::dot(fromCentre(item, j, winner, depth), glm::vec3(up[0], up[1], -up[2]));
    return bytesOf((*item.style->wall)[0], (*item.style->wall)[1],
      std::clamp(down / batch_.height[j], 0.0f, 1.0f));
  }
  return item.colours->at(winner.index);
}

/// The place of a splat that a pixel shows, in view space, from the splat's centre.
glm::vec3 WinnerResolve::fromCentre(
  const RasterItem& item, int j, const Winner& winner, float depth) const
{
  const auto place = [&](float px, float py, float d)
  {
    const float reach = item.camera.parallel ? 1.0f : d;
    return glm::vec3((px - item.camera.centreX) * reach / item.camera.scaleX,
      (py - item.camera.centreY) * reach / item.camera.scaleY, -d);
  };
  return place(static_cast<float>(winner.x + source_.window.left) + 0.5f,
           static_cast<float>(winner.y + source_.window.bottom) + 0.5f, depth) -
    place(batch_.screenX[j], batch_.screenY[j], batch_.depth[j]);
}

/// The depth of the splat's plane in that pixel; where the key's was pushed back, or light asks for
/// more than a depth.
float WinnerResolve::planeDepth(const RasterItem& item, int j, const Winner& winner) const
{
  const SplatPass& pass = item.passes.first;
  const float dx = static_cast<float>(winner.x + source_.window.left) + 0.5f - batch_.screenX[j];
  const float dy = static_cast<float>(winner.y + source_.window.bottom) + 0.5f - batch_.screenY[j];
  if (pass.shape == SplatShape::Ellipse)
  {
    const float rise = batch_.slopeX[j] * dx + batch_.slopeY[j] * dy;
    return batch_.depth[j] + std::clamp(rise, -batch_.radius[j], batch_.radius[j]);
  }
  if (pass.shape == SplatShape::ExactEllipse || pass.shape == SplatShape::Wall)
  {
    const float perspective = item.camera.parallel ? 0.0f : 1.0f;
    const float toX =
      (batch_.screenX[j] - item.camera.centreX) * (perspective / item.camera.scaleX);
    const float toY =
      (batch_.screenY[j] - item.camera.centreY) * (perspective / item.camera.scaleY);
    const float facing = batch_.normalX[j] * toX + batch_.normalY[j] * toY + batch_.normalZ[j];
    const float turned =
      batch_.normalX[j] * (dx / item.camera.scaleX) + batch_.normalY[j] * (dy / item.camera.scaleY);
    const float further =
      item.camera.parallel ? -turned / facing : -batch_.depth[j] * turned / (facing + turned);
    // As SplatAt does: a pixel that only the filter covers has the depth of the centre.
    const float along = perspective * (batch_.depth[j] + further) + 1.0f - perspective;
    const float x = further * toX + along * dx / item.camera.scaleX;
    const float y = further * toY + along * dy / item.camera.scaleY;
    const float most = batch_.radius[j] * batch_.radius[j];
    const bool onDisc =
      x * x + y * y + further * further <= most && batch_.depth[j] + further > 0.0f;
    const bool met = item.passes.walls() || onDisc;
    return met ? batch_.depth[j] + further : batch_.depth[j];
  }
  return batch_.depth[j]; // a disc that faces the eye
}

/// View space, towards the eye.
void WinnerResolve::putNormal(
  const RasterItem& item, int j, const Winner& winner, float depth, float* normal) const
{
  glm::vec3 n(batch_.normalX[j], batch_.normalY[j], -batch_.normalZ[j]);
  if (item.passes.first.shape == SplatShape::Sphere && !item.passes.squares)
  {
    n = fromCentre(item, j, winner, depth);
  }
  else if (!item.normals && !item.passes.walls() &&
    item.style->orientation != SplatOrientation::Fixed)
  {
    n = glm::vec3(0.0f);
  }
  const float square = glm::dot(n, n);
  const bool known = square > 1e-12f && square < 1e12f; // as splats have it; not of NaN
  n = known ? n / std::sqrt(square) : glm::vec3(0.0f);
  n = n.z < 0.0f && item.passes.first.shape != SplatShape::Sphere ? -n : n;
  normal[0] = n.x;
  normal[1] = n.y;
  normal[2] = n.z;
}

void WinnerResolve::resolve(
  const RasterItem& item, const Winner* winners, int count, SoftwareTarget& target)
{
  const bool keyIsDepth = item.passes.depthInKey();
  const bool discs = item.passes.squares ||
    (item.passes.first.shape == SplatShape::Disc && !item.passes.first.rimmed());
  if (!keyIsDepth || source_.normals)
  {
    std::uint32_t gathered[3 * RasterBatch::size];
    std::uint32_t points[RasterBatch::size];
    for (int j = 0; j < count; ++j)
    {
      points[j] = winners[j].index;
      std::memcpy(gathered + 3 * j, item.positions.xyz + 3 * std::size_t(points[j]), 12);
    }
    RasterPositions positions = item.positions;
    positions.clippingPlanes = 0; // who won was not clipped
    positions.filtered = false;
    positions.xyz = gathered;
    const RasterKernels& kernels = *source_.kernels;
    kernels.project(item.camera, positions, count, batch_);
    if (!discs || source_.normals)
    {
      PointShapes(*source_.items, kernels)
        .fill(item, points, count, item.passes.firstRadius, batch_);
      kernels.setUp(item.camera, source_.window, item.passes.first, count, batch_);
    }
  }
  for (int j = 0; j < count; ++j)
  {
    const Winner& winner = winners[j];
    const float depth = keyIsDepth ? winner.keyDepth : planeDepth(item, j, winner);
    const std::int64_t row = winner.y + source_.window.bottom - target.bottom;
    const auto pixel =
      static_cast<std::size_t>(row * target.width + winner.x + source_.window.left - target.left);
    if (put(item, j, winner, depth, target, pixel) && source_.normals)
    {
      putNormal(item, j, winner, depth, &target.normals[3 * pixel]);
    }
  }
}

} // namespace pointfront
