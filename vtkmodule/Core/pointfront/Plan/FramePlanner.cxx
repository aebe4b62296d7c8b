#include "pointfront/Plan/FramePlanner.h"

#include "pointfront/Front/PointPrefix.h"

#include <algorithm>
#include <utility>

namespace pointfront
{
namespace
{

constexpr std::size_t noBatch = ~std::size_t(0);

/// Batches of the layers that have a style, and which of them is a layer's.
std::vector<std::size_t> openBatches(
  const std::vector<std::shared_ptr<const ResolvedStyle>>& styles,
  std::vector<DrawBatch>& batches)
{
  std::vector<std::size_t> batchOf(styles.size(), noBatch);
  for (std::size_t layer = 0; layer < styles.size(); ++layer)
  {
    if (styles[layer])
    {
      batchOf[layer] = batches.size();
      batches.push_back({ static_cast<std::uint16_t>(layer), styles[layer], {} });
    }
  }
  return batchOf;
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
  const std::vector<std::size_t> batchOf = openBatches(request.styles, plan.batches);
  for (const DrawItem& item : front.last().draw)
  {
    std::shared_ptr<const NodeColumns> node = front.find(item.node);
    if (!node || node->layer >= batchOf.size() || batchOf[node->layer] == noBatch)
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
    plan.batches[batchOf[columns.layer]].items.push_back(std::move(planned));
  }
  plan.batches.erase(std::remove_if(plan.batches.begin(), plan.batches.end(),
                       [](const DrawBatch& batch) { return batch.items.empty(); }),
    plan.batches.end());
  refineRadii(plan.batches);
  return plan;
}

} // namespace pointfront
