#include "pointfront/Plan/FramePlanner.h"

#include "pointfront/Front/PointPrefix.h"

#include <algorithm>
#include <utility>

namespace pointfront
{
namespace
{

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
    planned.closingRadius =
      columns.splatRadius > 0.0f ? columns.splatRadius * planned.radiusScale : spacing;
    items[columns.layer].push_back(std::move(planned));
  }
  return items;
}

/// Splats of a node are as large as those of the finer nodes drawn among them.
void refineRadii(std::vector<DrawBatch>& batches)
{
  std::vector<PlanItem*> items;
  for (DrawBatch& batch : batches)
  {
    for (PlanItem& item : batch.items)
    {
      items.push_back(&item);
    }
  }
  const auto before = [](const PlanItem* a, const PlanItem* b)
  { return a->node->node < b->node->node; };
  std::sort(items.begin(), items.end(), before);
  // Children stand behind their parents in every table: each is finished when it is passed on.
  for (auto child = items.rbegin(); child != items.rend(); ++child)
  {
    const NodeIndex parent = (*child)->node->parent;
    auto place = std::lower_bound(items.begin(), items.end(), parent,
      [](const PlanItem* item, NodeIndex node) { return item->node->node < node; });
    for (; place != items.end() && (*place)->node->node == parent; ++place)
    {
      PlanItem& above = **place;
      above.closingRadius = above.refined
        ? std::max(above.closingRadius, (*child)->closingRadius)
        : (*child)->closingRadius;
      above.refined = true;
    }
  }
}

} // namespace

float prefixSpacing(const NodeColumns& node, std::uint32_t drawn, float spacingRatio)
{
  const auto points = static_cast<std::uint32_t>(node.size());
  return static_cast<float>(prefixErrorPx(points, drawn, node.spacing, spacingRatio));
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
  plan.shading = std::move(request.shading);
  std::vector<std::vector<PlanItem>> items = itemsByLayer(front, request.styles);
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
  refineRadii(plan.batches);
  return plan;
}

} // namespace pointfront
