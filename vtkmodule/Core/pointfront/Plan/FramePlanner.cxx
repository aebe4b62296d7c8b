#include "pointfront/Plan/FramePlanner.h"

#include "pointfront/Front/PointPrefix.h"
#include "pointfront/Plan/ClosingRadii.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pointfront
{
namespace
{

/// A node whose few points stand farther apart than its level can see has strays in it, no surface.
constexpr float mostSpacings = 2.0f;
/// A whole layer of fewer points is no surface: its points are as small as can be.
constexpr std::size_t fewestOfSurface = 64;
/// Of how far points of a node that grows are apart.
constexpr double stepsAnOctave = 16.0;

/// Of the next step of a ladder: what differs by less is drawn alike, so in one group.
float inSteps(double spacingPx)
{
  return static_cast<float>(
    std::exp2(std::ceil(stepsAnOctave * std::log2(spacingPx)) / stepsAnOctave));
}

/// Points [0, points) of a node; `spread` of them say how far they are apart.
PlanItem itemOf(std::shared_ptr<const NodeColumns> node, const DetailGrowth::Shown& shown,
  float spacingRatio, float errorPx)
{
  const NodeColumns& columns = *node;
  PlanItem item;
  item.node = std::move(node);
  item.last = shown.points;
  item.growth = shown.growth;
  item.spacing = prefixSpacing(columns, shown.spread, spacingRatio);
  item.radiusScale =
    columns.spacing > 0.0f ? std::max(1.0f, item.spacing / columns.spacing) : 1.0f;
  item.growingSpacingPx = shown.growth.whole()
    ? 0.0f
    : inSteps(prefixErrorPx(
        static_cast<std::uint32_t>(columns.size()), shown.spread, errorPx, spacingRatio));
  const float measured = std::min(columns.splatRadius, mostSpacings * columns.spacing);
  const bool strays = columns.parent == noNode && columns.size() < fewestOfSurface;
  item.unfinished = !columns.leaf || shown.points < columns.size();
  item.closingRadius =
    strays ? 0.0f : measured > 0.0f ? measured * item.radiusScale : item.spacing;
  return item;
}

/// The items of each layer that has a style, near to far.
std::vector<std::vector<PlanItem>> itemsByLayer(const ViewFront& front, const PlanRequest& request)
{
  const std::vector<LayerStyles>& styles = request.styles;
  const auto shows = [&](const std::shared_ptr<const NodeColumns>& node)
  { return node && node->layer < styles.size() && !styles[node->layer].empty(); };
  DetailGrowth still; // that of no duration
  DetailGrowth& growth = request.growth ? *request.growth : still;
  growth.begin(request.growth ? request.moment : GrowthMoment(),
    front.refinement() == Refinement::Add);
  std::vector<std::vector<PlanItem>> items(styles.size());
  for (const DrawItem& item : front.last().draw)
  {
    std::shared_ptr<const NodeColumns> node = front.find(item.node);
    if (shows(node))
    {
      const auto points = std::min(item.pointCount, static_cast<std::uint32_t>(node->size()));
      const DetailGrowth::Shown shown = growth.grow(node, points);
      const std::uint16_t layer = node->layer;
      if (shown.points > 0)
      {
        items[layer].push_back(itemOf(std::move(node), shown, item.spacingRatio, item.errorPx));
      }
    }
  }
  for (DetailGrowth::Leaving& leaving : growth.finish())
  {
    if (shows(leaving.node))
    {
      const std::uint16_t layer = leaving.node->layer;
      items[layer].push_back(itemOf(
        std::move(leaving.node), { leaving.points, leaving.points, leaving.growth }, 0.0f, 0.0f));
    }
  }
  return items;
}

} // namespace

float prefixSpacing(const NodeColumns& node, std::uint32_t drawn, float spacingRatio)
{
  const auto points = static_cast<std::uint32_t>(node.size());
  return static_cast<float>(prefixErrorPx(points, drawn, node.spacing, spacingRatio));
}

bool leavesOut(const FrontDelta& delta, const FrameDemand& demand)
{
  // In motion the frame time limits the front: at rest the same view may show more.
  const bool limited = demand.interacting && delta.errorPx > demand.targetErrorPx;
  return !demand.complete && (!delta.complete || limited);
}

FramePlan planFrame(
  const ViewFront& front, const StoreDescription& description, PlanRequest request)
{
  FramePlan plan;
  plan.camera = request.camera;
  plan.clippingPlanes = std::move(request.clippingPlanes);
  plan.grid = description.grid;
  plan.schema = std::make_shared<const AttributeSchema>(description.schema);
  plan.splatRadiusBase = description.splatRadiusBase;
  plan.spacingPx = static_cast<float>(front.last().thresholdPx);
  plan.keepsVisible = request.keepsVisible;
  plan.shading = std::move(request.shading);
  std::vector<std::vector<PlanItem>> items = itemsByLayer(front, request);
  for (std::size_t layer = 0; layer < items.size(); ++layer)
  {
    for (const std::shared_ptr<const ResolvedStyle>& style : request.styles[layer])
    {
      if (!items[layer].empty())
      {
        plan.batches.push_back({ static_cast<std::uint16_t>(layer), style, items[layer] });
      }
    }
  }
  matchNeighbours(plan.batches, plan.grid);
  return plan;
}

} // namespace pointfront
