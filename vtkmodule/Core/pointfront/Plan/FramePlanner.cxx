#include "pointfront/Plan/FramePlanner.h"

#include "pointfront/Front/PointPrefix.h"
#include "pointfront/Plan/ClosingRadii.h"

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

/// What closes the surface among the first `drawn` points of a node, before its neighbours are
/// looked at.
struct MeasuredRadius
{
  float spacing = 0.0f;     ///< between the points on screen
  float radiusScale = 1.0f; ///< as PlanItem's
  float closing = 0.0f;
  bool unfinished = false;

  template <typename Row> // Node or NodeColumns
  MeasuredRadius(
    const Row& row, std::uint32_t points, std::uint32_t drawn, bool leaf, float spacingRatio)
    : spacing(static_cast<float>(prefixErrorPx(points, drawn, row.spacing, spacingRatio)))
    , radiusScale(row.spacing > 0.0f ? std::max(1.0f, spacing / row.spacing) : 1.0f)
    , unfinished(!leaf || drawn < points)
  {
    const float measured = std::min(row.splatRadius, mostSpacings * row.spacing);
    const bool strays = row.parent == noNode && points < fewestOfSurface;
    closing = strays ? 0.0f : measured > 0.0f ? measured * radiusScale : spacing;
  }
};

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
    const auto points = static_cast<std::uint32_t>(node->size());
    const auto last = std::min(item.pointCount, points);
    const MeasuredRadius radius(*node, points, last, node->leaf, item.spacingRatio);
    PlanItem planned{ std::move(node), 0, last, 1.0f, radius.spacing };
    planned.radiusScale = radius.radiusScale;
    planned.unfinished = radius.unfinished;
    planned.closingRadius = radius.closing;
    items[planned.node->layer].push_back(std::move(planned));
  }
  return items;
}

/// What other processes draw of layers that have a style.
std::vector<NodeElsewhere> nodesElsewhere(
  const ViewFront& front, const std::vector<LayerStyles>& styles)
{
  std::vector<NodeElsewhere> nodes;
  for (const OtherPieces::Drawn& drawn : front.drawnElsewhere())
  {
    const Node& row = drawn.row;
    if (row.layer < styles.size() && !styles[row.layer].empty())
    {
      const MeasuredRadius radius(
        row, row.pointCount, drawn.item.pointCount, row.leaf(), drawn.item.spacingRatio);
      nodes.push_back({ drawn.item.node, row.parent, row.layer, drawn.item.pointCount,
        radius.closing, radius.unfinished, row.box() });
    }
  }
  return nodes;
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
  plan.composited = request.composited;
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
  matchNeighbours(plan.batches, plan.grid, nodesElsewhere(front, request.styles));
  return plan;
}

} // namespace pointfront
