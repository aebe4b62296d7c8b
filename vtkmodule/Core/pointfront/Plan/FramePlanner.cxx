#include "pointfront/Plan/FramePlanner.h"

#include "pointfront/Front/PointPrefix.h"
#include "pointfront/Plan/ClosingRadii.h"
#include "pointfront/Plan/LensCulling.h"
#include "pointfront/Plan/MeasuredRadius.h"
#include "pointfront/Plan/StandIns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace pointfront
{
namespace
{

/// Steps in which the distance of a growing node's points changes.
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

/// Rounds to the next step of a ladder: smaller differences are drawn alike, so in one group.
float inSteps(double spacingPx)
{
  return static_cast<float>(
    std::exp2(std::ceil(stepsAnOctave * std::log2(spacingPx)) / stepsAnOctave));
}

/// Pixels between the points on screen while `spread` of a node's points have grown; 0: they close
/// the surface as it is drawn at `spacingPx`. A leaf has no finer points, so what it lacks is
/// counted from there on.
float growingSpacing(const NodeColumns& node, std::uint32_t spread, float spacingRatio,
  double errorPx, double spacingPx)
{
  const double whole = node.leaf ? std::min(errorPx, spacingPx) : errorPx;
  const auto points = static_cast<std::uint32_t>(node.size());
  const double most = std::max(mostGrowingPx, spacingPx);
  const float px = inSteps(std::min(most, prefixErrorPx(points, spread, whole, spacingRatio)));
  return px > std::exp2(1.0 / stepsAnOctave) * spacingPx ? px : 0.0f;
}

/// Keeps the nodes that can be seen, for a batch that is seen in a lens only.
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

/// Whether coarser nodes stand in for points of this style: splats that close the surface, and the
/// mask of a lens in trees where the nodes above are no part of the picture.
bool hasStandIns(const ResolvedStyle& style, Refinement refinement)
{
  return style.size.mode == SplatSize::Mode::Spacing ||
    (style.lensMask && refinement == Refinement::Replace);
}

bool allHaveStandIns(const std::vector<LayerStyles>& layers, Refinement refinement)
{
  return std::all_of(layers.begin(), layers.end(),
    [&](const LayerStyles& styles)
    {
      return std::all_of(styles.begin(), styles.end(),
        [&](const auto& style) { return hasStandIns(*style, refinement); });
    });
}

/// The nodes of the complete view, for a refining view (FramePlan::refining); null: for any other.
const ExpectedNodes* expectedOf(const ViewFront& front, const PlanRequest& request)
{
  const ExpectedNodes* const expected = front.expected();
  const Refinement refinement = front.refinement();
  // Where children take their parent's place, it stands in for them.
  const bool usable = request.refines && !request.exchange && expected && expected->points() > 0 &&
    (refinement == Refinement::Add || allHaveStandIns(request.styles, refinement));
  const FrontDelta& last = front.last();
  // Its nodes may all be there and still grow.
  const bool grows = request.growth && !request.growth->whole() && expected &&
    expected->points() == last.pointsDrawn && expected->thresholdPx() == last.thresholdPx;
  return usable && (!last.complete || grows) ? expected : nullptr;
}

/// FramePlan::spacingPx. Without a bound by how many points there are, a coarse view around the eye
/// would draw each point hundreds of pixels large: the fewer points, the longer the frame.
double thinnedSpacingPx(
  const ViewFront& front, const FrameCamera& camera, const ExpectedNodes* expected)
{
  const double pixels = double(camera.width) * double(camera.height);
  const auto among = [&](double thresholdPx, std::uint64_t points)
  {
    const double even = std::sqrt(pixels / static_cast<double>(points));
    return std::min(thresholdPx, std::max(smallSpacingPx, mostEvenSpacings * even));
  };
  if (expected)
  {
    return among(expected->thresholdPx(), 1 + expected->points());
  }
  std::uint64_t points = 1;
  for (const DrawItem& item : front.last().draw)
  {
    points += item.pointCount;
  }
  for (const OtherPieces::Drawn& drawn : front.drawnElsewhere())
  {
    points += drawn.item.pointCount;
  }
  return among(front.last().thresholdPx, points);
}

/// A batch's items and stand-ins of each layer, near to far.
struct LayerItems
{
  std::vector<std::vector<PlanItem>> items;
  std::vector<DrawBatch> standIns; ///< without a style
};

/// The item of a node in a refining view: it has the size of the complete view.
PlanItem expectedItem(std::shared_ptr<const NodeColumns> node, DetailGrowth::Shown shown,
  const DrawItem& complete, double spacingPx)
{
  shown.spread = complete.pointCount;
  const auto points = static_cast<std::uint32_t>(node->size());
  const bool unfinished = !node->leaf || complete.pointCount < points;
  PlanItem item =
    itemOf(std::move(node), shown, complete.spacingRatio, complete.errorPx, spacingPx);
  item.growingSpacingPx = 0.0f; // stand-ins close the surface meanwhile
  item.sizedFor = complete.pointCount;
  item.unfinished = unfinished;
  return item;
}

/// The sides of a frame's view, margin included.
std::array<glm::dvec4, 4> sidesOf(const FrameCamera& camera)
{
  const View view = View::fromMatrix(camera.storeToClip(), camera.width, camera.height);
  std::array<glm::dvec4, 4> sides;
  std::copy_n(view.planes.begin(), sides.size(), sides.begin());
  return sides;
}

bool ofNode(const std::vector<TabledNode>& nodes, NodeIndex node)
{
  return std::binary_search(nodes.begin(), nodes.end(), TabledNode{ { node }, {} },
    [](const TabledNode& a, const TabledNode& b) { return a.item.node < b.item.node; });
}

/// Those that have a style.
LayerItems itemsByLayer(const ViewFront& front, const PlanRequest& request, double spacingPx,
  const ExpectedNodes* expected)
{
  const std::vector<LayerStyles>& styles = request.styles;
  const auto shows = [&](const std::shared_ptr<const NodeColumns>& node)
  { return node && node->layer < styles.size() && !styles[node->layer].empty(); };
  DetailGrowth still; // that of no duration
  DetailGrowth& growth = request.growth ? *request.growth : still;
  GrowthMoment moment = request.growth ? request.moment : GrowthMoment();
  moment.sides = sidesOf(request.camera);
  growth.begin(moment, front.refinement() == Refinement::Add);
  LayerItems layers;
  std::vector<std::vector<PlanItem>>& items = layers.items;
  items.resize(styles.size());
  std::optional<StandIns> standIns;
  if (expected)
  {
    standIns.emplace(*expected);
    for (const TabledNode& replaced : expected->replaced())
    {
      const std::shared_ptr<const NodeColumns> node = front.find(replaced.item.node);
      shows(node) ? standIns->noteWhole(node, replaced) : void();
    }
  }
  for (const DrawItem& item : front.last().draw)
  {
    std::shared_ptr<const NodeColumns> node = front.find(item.node);
    if (shows(node))
    {
      const auto points = std::min(item.pointCount, static_cast<std::uint32_t>(node->size()));
      const DetailGrowth::Shown shown = growth.grow(node, points, growth.saw(node->box()));
      const std::uint16_t layer = node->layer;
      const TabledNode* const complete = expected ? expected->find(item.node) : nullptr;
      if (complete && shown.growth.whole() && shown.points >= complete->item.pointCount)
      {
        standIns->noteWhole(node, *complete);
      }
      const bool beside = expected && !complete &&
        (ofNode(expected->replaced(), item.node) || expected->passesOver(item.node));
      if (shown.points > 0 && !beside)
      {
        items[layer].push_back(complete
            ? expectedItem(std::move(node), shown, complete->item, spacingPx)
            : itemOf(std::move(node), shown, item.spacingRatio, item.errorPx, spacingPx));
      }
    }
  }
  for (DetailGrowth::Leaving& leaving : growth.finish())
  {
    if (shows(leaving.node) && !expected) // else stand-ins
    {
      const std::uint16_t layer = leaving.node->layer;
      items[layer].push_back(itemOf(std::move(leaving.node),
        { leaving.points, leaving.points, leaving.growth }, 0.0f, 0.0f, spacingPx));
    }
  }
  layers.standIns = standIns ? standIns->batches() : layers.standIns;
  return layers;
}

/// One batch each, without a style; layers of which nothing is in sight have none.
std::vector<DrawBatch> batchesOf(std::vector<std::vector<PlanItem>> items)
{
  std::vector<DrawBatch> batches;
  for (std::size_t layer = 0; layer < items.size(); ++layer)
  {
    if (!items[layer].empty())
    {
      batches.push_back({ static_cast<std::uint16_t>(layer), nullptr, std::move(items[layer]), 0 });
    }
  }
  return batches;
}

/// Lists nodes that others draw, or that are drawn later, if their layers have a style.
std::vector<NodeElsewhere> nodesElsewhere(
  const std::vector<TabledNode>& tabled, const std::vector<LayerStyles>& styles)
{
  std::vector<NodeElsewhere> nodes;
  for (const TabledNode& drawn : tabled)
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

/// A batch for each style of each layer; stand-ins where a style has some.
void addStyled(const std::vector<DrawBatch>& layers, const std::vector<LayerStyles>& styles,
  const FramePlan& plan, Refinement refinement, std::vector<DrawBatch>& batches)
{
  const bool standIns = &batches == &plan.standIns;
  for (const DrawBatch& layer : layers)
  {
    std::uint16_t number = 0;
    for (const std::shared_ptr<const ResolvedStyle>& style : styles[layer.layer])
    {
      DrawBatch batch{ layer.layer, style, layer.items, layer.level, number++ };
      keepWhatIsSeen(plan, batch);
      const bool wanted = !standIns || hasStandIns(*style, refinement);
      if (wanted && !batch.items.empty())
      {
        batches.push_back(std::move(batch));
      }
    }
  }
}

} // namespace

float prefixSpacing(const NodeColumns& node, std::uint32_t drawn, float spacingRatio)
{
  const auto points = static_cast<std::uint32_t>(node.size());
  return static_cast<float>(prefixErrorPx(points, drawn, node.spacing, spacingRatio));
}

bool leavesOut(const FrontDelta& delta, const FrameRequest& request)
{
  // In motion the frame time limits the front: at rest the same view may show more.
  const bool limited = request.interacting && delta.errorPx > request.targetErrorPx;
  return !request.complete && (!delta.complete || limited);
}

void restyle(FramePlan& plan, const std::vector<LayerStyles>& styles)
{
  for (std::vector<DrawBatch>* batches : { &plan.batches, &plan.standIns })
  {
    for (DrawBatch& batch : *batches)
    {
      if (batch.layer < styles.size() && batch.styleNumber < styles[batch.layer].size())
      {
        batch.style = styles[batch.layer][batch.styleNumber];
      }
    }
  }
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
  const ExpectedNodes* const expected = expectedOf(front, request);
  const double spacingPx = thinnedSpacingPx(front, request.camera, expected);
  plan.spacingPx = static_cast<float>(spacingPx);
  plan.keepsVisible = request.keepsVisible;
  plan.composited = request.composited;
  plan.exchange = request.exchange;
  plan.shading = std::move(request.shading);
  LayerItems items = itemsByLayer(front, request, spacingPx, expected);
  const bool whole = front.last().complete && (!request.growth || request.growth->whole());
  plan.refining = expected && !whole;
  std::vector<DrawBatch> layers = batchesOf(std::move(items.items));
  matchNeighbours(layers,
    nodesElsewhere(plan.refining ? expected->nodes() : front.drawnElsewhere(), request.styles));
  addStyled(layers, request.styles, plan, front.refinement(), plan.batches);
  addStyled(items.standIns, request.styles, plan, front.refinement(), plan.standIns);
  return plan;
}

} // namespace pointfront
