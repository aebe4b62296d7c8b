#include "pointfront/Plan/FramePlanner.h"

#include "pointfront/Front/PointPrefix.h"
#include "pointfront/Plan/ClosingRadii.h"
#include "pointfront/Plan/LensCulling.h"

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

/// No splat is made larger than this, in pixels, to bridge what grows: a node around the eye is
/// thousands of pixels coarse at its nearest point, and its other points are not.
constexpr double mostGrowingPx = 32.0;

// The front's threshold is an error at the nearest point of a node. Most points of a node that
// reaches to the eye are far from there, so they are much closer together on screen.
/// Of points spread evenly over the viewport: no more spacings lie between thinned points.
constexpr double mostEvenSpacings = 4.0;
/// Up to there the threshold is taken at its word.
constexpr double smallSpacingPx = 8.0;

/// Of the next step of a ladder: what differs by less is drawn alike, so in one group.
float inSteps(double spacingPx)
{
  return static_cast<float>(
    std::exp2(std::ceil(stepsAnOctave * std::log2(spacingPx)) / stepsAnOctave));
}

/// Pixels between the points on screen while `spread` of a node's points have grown. A leaf has no
/// finer points, so what it lacks is counted from `spacingPx` on.
float growingSpacing(const NodeColumns& node, std::uint32_t spread, float spacingRatio,
  double errorPx, double spacingPx)
{
  const double whole = node.leaf ? std::min(errorPx, spacingPx) : errorPx;
  const auto points = static_cast<std::uint32_t>(node.size());
  const double most = std::max(mostGrowingPx, spacingPx);
  return inSteps(std::min(most, prefixErrorPx(points, spread, whole, spacingRatio)));
}

/// What closes the surface among the first `drawn` points of a node, before its neighbours are
/// looked at.
struct MeasuredRadius
{
  float spacing = 0.0f; ///< between the points on screen
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

/// Of what is seen in a lens only, what can be.
void keepWhatIsSeen(const FramePlan& plan, DrawBatch& batch)
{
  const auto lens = static_cast<std::size_t>(std::max<std::int16_t>(batch.style->lens, 0));
  if (batch.style->lens < 0 || batch.style->lensMask || lens >= plan.shading.lenses.size())
  {
    return;
  }
  std::vector<PlanItem>& items = batch.items;
  items.erase(std::remove_if(items.begin(), items.end(),
                [&](const PlanItem& item)
                { return !mayReach(plan, item, *batch.style, plan.shading.lenses[lens]); }),
    items.end());
}

/// Points [0, points) of a node; `spread` of them say how far they are apart.
PlanItem itemOf(std::shared_ptr<const NodeColumns> node, const DetailGrowth::Shown& shown,
  float spacingRatio, float errorPx, double spacingPx)
{
  const NodeColumns& columns = *node;
  PlanItem item;
  item.node = std::move(node);
  item.last = shown.points;
  item.growth = shown.growth;
  const auto points = static_cast<std::uint32_t>(columns.size());
  const MeasuredRadius radius(columns, points, shown.spread, columns.leaf, spacingRatio);
  item.spacing = radius.spacing;
  item.radiusScale = radius.radiusScale;
  item.growingSpacingPx = shown.growth.whole()
    ? 0.0f
    : growingSpacing(columns, shown.spread, spacingRatio, errorPx, spacingPx);
  item.unfinished = !columns.leaf || shown.points < points;
  item.closingRadius = radius.closing;
  return item;
}

/// FramePlan::spacingPx. Without a bound by how many points there are, a coarse view around the eye
/// would draw each point hundreds of pixels large: the fewer points, the longer the frame.
double thinnedSpacingPx(const ViewFront& front, const FrameCamera& camera)
{
  std::uint64_t points = 1;
  for (const DrawItem& item : front.last().draw)
  {
    points += item.pointCount;
  }
  for (const OtherPieces::Drawn& drawn : front.drawnElsewhere())
  {
    points += drawn.item.pointCount;
  }
  const double pixels = double(camera.width) * double(camera.height);
  const double even = std::sqrt(pixels / static_cast<double>(points));
  return std::min(front.last().thresholdPx, std::max(smallSpacingPx, mostEvenSpacings * even));
}

/// The items of each layer that has a style, near to far.
std::vector<std::vector<PlanItem>> itemsByLayer(
  const ViewFront& front, const PlanRequest& request, double spacingPx)
{
  const std::vector<LayerStyles>& styles = request.styles;
  const auto shows = [&](const std::shared_ptr<const NodeColumns>& node)
  { return node && node->layer < styles.size() && !styles[node->layer].empty(); };
  DetailGrowth still; // that of no duration
  DetailGrowth& growth = request.growth ? *request.growth : still;
  growth.begin(
    request.growth ? request.moment : GrowthMoment(), front.refinement() == Refinement::Add);
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
        items[layer].push_back(
          itemOf(std::move(node), shown, item.spacingRatio, item.errorPx, spacingPx));
      }
    }
  }
  for (DetailGrowth::Leaving& leaving : growth.finish())
  {
    if (shows(leaving.node))
    {
      const std::uint16_t layer = leaving.node->layer;
      items[layer].push_back(itemOf(std::move(leaving.node),
        { leaving.points, leaving.points, leaving.growth }, 0.0f, 0.0f, spacingPx));
    }
  }
  return items;
}

/// One batch each, without a style; layers of which nothing is in sight have none.
std::vector<DrawBatch> batchesOfLayers(
  const ViewFront& front, const PlanRequest& request, double spacingPx)
{
  std::vector<std::vector<PlanItem>> items = itemsByLayer(front, request, spacingPx);
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

bool leavesOut(const FrontDelta& delta, const FrameRequest& demand)
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
  const double spacingPx = thinnedSpacingPx(front, request.camera);
  plan.spacingPx = static_cast<float>(spacingPx);
  plan.keepsVisible = request.keepsVisible;
  plan.composited = request.composited;
  plan.exchange = request.exchange;
  plan.shading = std::move(request.shading);
  std::vector<DrawBatch> layers = batchesOfLayers(front, request, spacingPx);
  matchNeighbours(layers, plan.grid, nodesElsewhere(front, request.styles));
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
