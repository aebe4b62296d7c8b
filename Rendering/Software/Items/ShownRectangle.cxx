#include "ShownRectangle.h"

#include "HoleFiller.h"
#include "PointShapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pointfront
{
namespace
{

/// Splats of a larger angular size may be anywhere.
constexpr double mostSize = 0.5;
/// Rounding of places to single precision, and of rectangles to pixels.
constexpr double roundingPixels = 2.0;
/// Half sizes of nodes are rounded to single precision.
constexpr double boxRounding = 1e-6;

/// Directions and depths of a node's corners: x and y in units at depth 1, or in world units where
/// rays are parallel.
struct CornerRange
{
  glm::dvec2 low{ std::numeric_limits<double>::max() };
  glm::dvec2 high{ std::numeric_limits<double>::lowest() };
  double nearest = std::numeric_limits<double>::max();
  double farthest = std::numeric_limits<double>::lowest();
};

/// Corners of the box of the node's points; for walls, down to the lowest end of any.
CornerRange cornersOf(const RasterItem& item, const FramePlan& plan)
{
  const FrameCamera& camera = plan.camera;
  const NodeColumns& node = item.node();
  const glm::dvec3 down(0.0, 0.0, item.passes.walls() ? PointShapes::largestHeight(item) : 0.0);
  const glm::dvec3 size = (1.0 + boxRounding) * (2.0 * glm::dvec3(node.halfSize) + down);
  const glm::dvec3 slack = boxRounding * size + plan.grid.scale;
  const glm::dmat3 turn(camera.storeToView);
  // The offset less the reference first: both are large.
  const glm::dvec3 origin = (plan.grid.offset - camera.reference) +
    plan.grid.scale * glm::dvec3(node.origin) - slack - down;
  CornerRange range;
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::dvec3 share(corner & 1, corner >> 1 & 1, corner >> 2);
    const glm::dvec3 place =
      turn * (origin + share * (size + 2.0 * slack)) + camera.referenceInView;
    const double depth = -place.z;
    range.nearest = std::min(range.nearest, depth);
    range.farthest = std::max(range.farthest, depth);
    const glm::dvec2 at = glm::dvec2(place) / (camera.parallel ? 1.0 : depth);
    range.low = glm::min(range.low, at);
    range.high = glm::max(range.high, at);
  }
  return range;
}

/// How far splats reach from their centres, in pixels; not finite where nothing is known.
glm::dvec2 reachOf(const RasterItem& item, const CornerRange& corners)
{
  const RasterCamera& camera = item.camera;
  const TechniquePasses& passes = item.passes;
  if (passes.squares)
  {
    return glm::dvec2(0.5 * passes.squareSize + 1.0);
  }
  const double share = std::max(passes.firstRadius, passes.blended ? passes.secondRadius : 0.0f);
  const double least =
    std::max(passes.first.leastRadius, passes.blended ? passes.second.leastRadius : 0.0f);
  const double filter =
    std::max(passes.first.lowPass, passes.blended ? passes.second.lowPass : 0.0f);
  double size = PointShapes::largestRadius(item) * share;
  size = camera.parallel ? size : size / corners.nearest;
  const bool ofPixels = item.style->size.mode == SplatSize::Mode::Pixels;
  size = ofPixels ? 0.5 * item.style->size.value * share / camera.scaleY : size;
  // A wall that is widened at its top may go down towards the eye.
  const bool nearer = item.passes.walls() && !camera.parallel;
  size =
    std::max(size, least / camera.scaleY * (nearer ? corners.farthest / corners.nearest : 1.0));
  const glm::dvec2 scale(camera.scaleX, camera.scaleY);
  if (camera.parallel)
  {
    return scale * (size + filter / camera.scaleY) + 1.0;
  }
  if (!(size <= mostSize))
  {
    return glm::dvec2(std::numeric_limits<double>::infinity());
  }
  // Beside the middle of the view spheres are ellipses, and affine images of discs larger still
  // (setUpEllipses).
  const glm::dvec2 aside = glm::max(glm::abs(corners.low), glm::abs(corners.high));
  const glm::dvec2 bent = 1.0 + 1.5 * aside + 0.5 * aside * aside;
  return scale * (size * (1.0 + 5.27 * size * size)) * bent + filter + 1.0;
}

int pixelWithin(double place, int most)
{
  return static_cast<int>(std::clamp(place, 0.0, static_cast<double>(most)));
}

PixelRectangle rectangleOf(const RasterItem& item, const FramePlan& plan)
{
  const PixelRectangle all{ 0, 0, plan.camera.width, plan.camera.height };
  const CornerRange corners = cornersOf(item, plan);
  const RasterCamera& camera = item.camera;
  if (!camera.parallel)
  {
    if (corners.farthest < camera.nearDepth)
    {
      return {}; // behind the eye: none of its points is drawn
    }
    if (!(corners.nearest > camera.nearDepth) || !(corners.nearest > 0.0))
    {
      return all;
    }
  }
  const glm::dvec2 scale(camera.scaleX, camera.scaleY);
  const glm::dvec2 centre(camera.centreX, camera.centreY);
  const glm::dvec2 reach = reachOf(item, corners) + roundingPixels;
  const glm::dvec2 one = centre + scale * corners.low, other = centre + scale * corners.high;
  const glm::dvec2 low = glm::min(one, other) - reach, high = glm::max(one, other) + reach;
  if (!std::isfinite(low.x + low.y) || !std::isfinite(high.x + high.y))
  {
    return all;
  }
  return common(all,
    { pixelWithin(std::floor(low.x), all.right), pixelWithin(std::floor(low.y), all.top),
      pixelWithin(std::ceil(high.x), all.right), pixelWithin(std::ceil(high.y), all.top) });
}

} // namespace

PixelRectangle shownRectangle(const RasterItems& items)
{
  const FrameCamera& camera = items.plan().camera;
  const PixelRectangle all{ 0, 0, camera.width, camera.height };
  PixelRectangle shown;
  for (const RasterItem& item : items.items())
  {
    if (item.item->last > item.item->first)
    {
      shown = around(shown, rectangleOf(item, items.plan()));
    }
    if (shown.contains(all))
    {
      break;
    }
  }
  return shown;
}

PixelRectangle withHoles(const PixelRectangle& place, const FramePlan& plan)
{
  return plan.shading.fillHoles ? filledFrom(place, plan.camera) : place;
}

} // namespace pointfront
