#include "pointfront/Plan/FramePlanner.h"

#include "pointfront/Front/PointPrefix.h"
#include "pointfront/Plan/ClosingRadii.h"
#include "pointfront/Plan/LensCulling.h"

#include <algorithm>
#include <utility>

namespace pointfront
{
namespace
{

/// A node whose few points stand farther apart than its level can see has strays in it, no surface.
constexpr float mostSpacings = 2.0f;
/// A whole layer of fewer points is no surface: its points are as small as can be.
constexpr std::size_t fewestOfSurface = 64;

/// Of what is seen in a lens only, what can be.
void keepWhatIsSeen(const FramePlan& plan, DrawBatch& batch)
{
  const auto lens = static_cast<std::size_t>(std::max<std::int16_t>(batch.style->lens, 0));
  if (batch.style->lens < 0 || batch.style->lensMask || lens >= plan.shading.lenses.size())
  {
    return;
  }
  std::vector<PlanItem>& items = batch.items;
  items.erase(std::remove_if(items.begin(), items.end(), [&](const PlanItem& item)
                { return !mayReach(plan, item, *batch.style, plan.shading.lenses[lens]); }),
    items.end());
}

/// The items of each layer that has a style, near to far.
std::vector<std::vector<PlanItem>> itemsByLayer(
  const ViewFront& front, const std::vector<LayerStyles>& styles)
{
  std::vector<std::vector<PlanItem>> items(styles.size());
  for (const DrawItem& item : front.last().draw)
  {
    std::shared_ptr<const NodeColumns> node = front.find(item.node);
    if (!node || node->layer >= styles.size() || styles[node->layer].empty())
    {
      continue;
    }
    const auto last = std::min(item.pointCount, static_cast<std::uint32_t>(node->size()));
    const float spacing = prefixSpacing(*node, last, item.spacingRatio);
    PlanItem planned{ std::move(node), 0, last, 1.0f, spacing };
    const NodeColumns& columns = *planned.node;
    planned.radiusScale =
      columns.spacing > 0.0f ? std::max(1.0f, spacing / columns.spacing) : 1.0f;
    const float measured = std::min(columns.splatRadius, mostSpacings * columns.spacing);
    const bool strays = columns.parent == noNode && columns.size() < fewestOfSurface;
    planned.unfinished = !columns.leaf || last < columns.size();
    planned.closingRadius =
      strays ? 0.0f : measured > 0.0f ? measured * planned.radiusScale : spacing;
    items[columns.layer].push_back(std::move(planned));
  }
  return items;
}

/// One batch each, without a style; layers of which nothing is in sight have none.
std::vector<DrawBatch> batchesOfLayers(
  const ViewFront& front, const std::vector<LayerStyles>& styles)
{
  std::vector<std::vector<PlanItem>> items = itemsByLayer(front, styles);
  std::vector<DrawBatch> batches;
  for (std::size_t layer = 0; layer < items.size(); ++layer)
  {
    if (!items[layer].empty())
    {
      batches.push_back({ static_cast<std::uint16_t>(layer), nullptr, std::move(items[layer]) });
    }
  }
  return batches;
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
  std::vector<DrawBatch> layers = batchesOfLayers(front, request.styles);
  matchNeighbours(layers, plan.grid);
  for (const DrawBatch& layer : layers)
  {
    for (const std::shared_ptr<const ResolvedStyle>& style : request.styles[layer.layer])
    {
      DrawBatch batch{ layer.layer, style, layer.items };
      keepWhatIsSeen(plan, batch);
      if (!batch.items.empty())
      {
        plan.batches.push_back(std::move(batch));
      }
    }
  }
  return plan;
}

} // namespace pointfront
