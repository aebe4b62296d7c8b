#include "pointfront/Plan/LensCulling.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>

namespace pointfront
{
namespace
{

/// Factor of the closing radius, more than any technique draws.
constexpr double mostOfClosing = 4.0;
/// Pixels beyond that: the centre's own, a low-pass, rounding.
constexpr double culledMarginPx = 8.0;

/// Pixels that a point's splat reaches however far away it is.
double leastReachPx(const FramePlan& plan, const SplatSize& size)
{
  return size.mode == SplatSize::Mode::Pixels ? size.value
    : size.mode == SplatSize::Mode::Spacing
    ? mostOfClosing * static_cast<double>(plan.spacingPx) * std::max(1.0, size.value)
    : 0.0;
}

/// World units that a point's splat reaches from it.
double reachOf(const PlanItem& item, const SplatSize& size)
{
  if (size.mode == SplatSize::Mode::World)
  {
    return 0.5 * size.value;
  }
  const double closing = std::max({ item.closingRadius, item.sparsestRadius, item.spacing });
  return mostOfClosing * closing * std::max(1.0, size.value);
}

} // namespace

bool mayReach(
  const FramePlan& plan, const PlanItem& item, const ResolvedStyle& style, const FrameLens& lens)
{
  if (style.size.mode == SplatSize::Mode::Attribute)
  {
    return true; // as large as any value of the attribute
  }
  const FrameCamera& camera = plan.camera;
  const std::array<int, 4> extent = lens.extent(camera.width, camera.height);
  const double width = std::max(1, camera.width), height = std::max(1, camera.height);
  const double margin = culledMarginPx + plan.shading.reachPx() + leastReachPx(plan, style.size);
  const double left = 2.0 * (extent[0] - margin) / width - 1.0;
  const double right = 2.0 * (extent[2] + margin) / width - 1.0;
  const double bottom = 2.0 * (extent[1] - margin) / height - 1.0;
  const double top = 2.0 * (extent[3] + margin) / height - 1.0;

  const glm::dvec3 half(item.node->halfSize);
  const glm::dvec3 centre = item.node->centre;
  // In the view without the cancellation of large terms.
  const glm::dmat3 turn(camera.storeToView);
  const glm::dvec3 seen = turn * (centre - camera.reference) + camera.referenceInView;
  const double scale =
    std::max({ glm::length(turn[0]), glm::length(turn[1]), glm::length(turn[2]) });
  const double radius = scale * (glm::length(half) + reachOf(item, style.size));

  const glm::dmat4 rows = glm::transpose(camera.viewToClip);
  const glm::dvec4 planes[] = { rows[0] - left * rows[3], right * rows[3] - rows[0],
    rows[1] - bottom * rows[3], top * rows[3] - rows[1] };
  return std::all_of(std::begin(planes), std::end(planes),
    [&](const glm::dvec4& plane)
    {
      const glm::dvec3 normal(plane);
      return glm::dot(normal, seen) + plane.w >= -radius * glm::length(normal);
    });
}

} // namespace pointfront
