#include "pointfront/Plan/ClosingRadii.h"

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace pointfront
{
namespace
{

constexpr float mostOfDenser = 2.0f;
constexpr double mostOfMean = 2.0;
/// Closing radius of even points in a volume, where it is the least, by their spacing.
constexpr float radiusOfSpacing = 0.75f;
/// Share of a node's ground that another has to share to say how dense it is there. Cells of trees
/// halve, so a quarter is a usual share; a little less counts, too: rounding must not decide.
constexpr double leastShare = 0.24;
/// Points of a node alone are at most so many times as far apart as with all coarser ones: those
/// close the surface while a child grows. Coarser nodes lie across the whole view; their splats
/// would cover what is not growing. A step of FramePlanner's ladder (a quarter of an octave).
constexpr float withoutCoarser = 1.1892071f;

/// A node's ground in world units.
struct Ground
{
  glm::dvec2 low;
  glm::dvec2 high;
};

/// A node that is drawn, here or elsewhere, once however many styles draw it.
struct DrawnNode
{
  NodeIndex node;
  NodeIndex parent;
  std::uint16_t layer;
  std::uint32_t points;
  float closingRadius;
  bool unfinished;
  Ground ground;
  float sparsestRadius = 0.0f;
  float growingSpacingPx = 0.0f;
  bool refined = false;
  float handedSpacingPx = 0.0f; ///< that the node's parent has to close while the node grows
};

Ground groundOf(const Bounds& box)
{
  return { { box.low.x, box.low.y }, { box.high.x, box.high.y } };
}

bool before(const DrawnNode& drawn, NodeIndex node)
{
  return drawn.node < node;
}

std::vector<DrawnNode> nodesOf(
  const std::vector<DrawBatch>& batches, const std::vector<NodeElsewhere>& elsewhere)
{
  std::vector<DrawnNode> nodes;
  for (const NodeElsewhere& other : elsewhere)
  {
    nodes.push_back({ other.node, other.parent, other.layer, other.points, other.closingRadius,
      other.unfinished, groundOf(other.box) });
  }
  for (const DrawBatch& batch : batches)
  {
    for (const PlanItem& item : batch.items)
    {
      nodes.push_back({ item.node->node, item.node->parent, batch.layer, item.last - item.first,
        item.closingRadius, item.unfinished, groundOf(item.node->box()), 0.0f,
        item.growingSpacingPx, false, item.growingSpacingPx });
    }
  }
  std::stable_sort(nodes.begin(), nodes.end(),
    [](const DrawnNode& a, const DrawnNode& b) { return a.node < b.node; });
  nodes.erase(std::unique(nodes.begin(), nodes.end(),
                [](const DrawnNode& a, const DrawnNode& b) { return a.node == b.node; }),
    nodes.end());
  return nodes;
}

/// The radius that closes the surface among finer nodes, from those that are drawn: the largest of
/// nodes that are all there, but at most twice the mean over their points, as a few strays are no
/// surface. Without such nodes the smallest: how far apart points are where some are left out is a
/// matter of pixels (FramePlan::spacingPx), and what is far away, where nodes are coarse, says
/// nothing about what is near.
struct FinerRadii
{
  double points = 0.0; ///< points in nodes that are all there
  double sum = 0.0; ///< sum of their radii
  float largestFinished = 0.0f;
  float leastUnfinished = 0.0f; ///< 0: there is none
  float sparsest = 0.0f;
  bool unfinished = false;

  void add(const FinerRadii& other)
  {
    points += other.points;
    sum += other.sum;
    const bool known = leastUnfinished > 0.0f && other.leastUnfinished > 0.0f;
    leastUnfinished = known ? std::min(leastUnfinished, other.leastUnfinished)
                            : std::max(leastUnfinished, other.leastUnfinished);
    largestFinished = std::max(largestFinished, other.largestFinished);
    sparsest = std::max(sparsest, other.sparsest);
    unfinished = unfinished || other.unfinished;
  }
  static FinerRadii of(const DrawnNode& drawn)
  {
    FinerRadii radii;
    const double radius = drawn.closingRadius;
    radii.sparsest = drawn.closingRadius;
    radii.unfinished = drawn.unfinished;
    radii.points = drawn.unfinished || radius == 0.0 ? 0.0 : double(drawn.points);
    radii.sum = radii.points * radius;
    radii.largestFinished = drawn.unfinished ? 0.0f : drawn.closingRadius;
    radii.leastUnfinished = drawn.unfinished ? drawn.closingRadius : 0.0f;
    return radii;
  }
  float closing() const
  {
    const auto bound = static_cast<float>(points > 0.0 ? mostOfMean * sum / points : 0.0);
    return points > 0.0 ? std::min(largestFinished, bound) : leastUnfinished;
  }
};

void refine(std::vector<DrawnNode>& nodes)
{
  std::vector<FinerRadii> finer(nodes.size());
  // Children stand behind their parents in every table: each is finished when it is passed on.
  for (std::size_t child = nodes.size(); child-- > 0;)
  {
    DrawnNode& drawn = nodes[child];
    const FinerRadii radii = drawn.refined ? finer[child] : FinerRadii::of(drawn);
    drawn.sparsestRadius = radii.sparsest;
    drawn.unfinished = radii.unfinished;
    drawn.closingRadius = drawn.refined ? radii.closing() : drawn.closingRadius;
    const auto parent = std::lower_bound(nodes.begin(), nodes.end(), drawn.parent, before);
    if (parent != nodes.end() && parent->node == drawn.parent)
    {
      parent->refined = true;
      const float own = parent->parent == noNode ? 1.0f : withoutCoarser;
      parent->growingSpacingPx = std::max(parent->growingSpacingPx, own * drawn.handedSpacingPx);
      finer[static_cast<std::size_t>(parent - nodes.begin())].add(radii);
    }
  }
}

/// The radius that half of all points have at most.
float medianRadius(const std::vector<DrawnNode>& nodes)
{
  std::vector<std::pair<float, std::uint64_t>> radii;
  std::uint64_t points = 0;
  for (const DrawnNode& drawn : nodes)
  {
    radii.emplace_back(drawn.closingRadius, drawn.points);
    points += radii.back().second;
  }
  std::sort(radii.begin(), radii.end());
  std::uint64_t below = 0;
  for (const auto& [radius, count] : radii)
  {
    below += count;
    if (2 * below >= points)
    {
      return radius;
    }
  }
  return 0.0f;
}

bool shares(const Ground& mine, const Ground& other)
{
  const glm::dvec2 common = glm::min(mine.high, other.high) - glm::max(mine.low, other.low);
  const glm::dvec2 own = mine.high - mine.low;
  return common.x > 0.0 && common.y > 0.0 && common.x * common.y >= leastShare * own.x * own.y;
}

void matchLayers(std::vector<DrawnNode>& nodes)
{
  const float median = medianRadius(nodes);
  std::vector<float> radii; // as they are before any is changed
  radii.reserve(nodes.size());
  for (const DrawnNode& drawn : nodes)
  {
    radii.push_back(drawn.closingRadius);
  }
  for (std::size_t i = 0; i < nodes.size(); ++i)
  {
    float densest = radii[i];
    for (std::size_t j = 0; radii[i] > mostOfDenser * median && j < nodes.size(); ++j)
    {
      if (nodes[j].layer != nodes[i].layer && radii[j] > 0.0f && radii[j] < densest &&
        shares(nodes[i].ground, nodes[j].ground))
      {
        densest = radii[j];
      }
    }
    nodes[i].closingRadius = std::min(radii[i], mostOfDenser * densest);
    nodes[i].sparsestRadius = std::min(nodes[i].sparsestRadius, mostOfDenser * densest);
  }
}

/// Most points of an unevenly dense leaf may lie close together. Its spacing is that of the sparse
/// ones (SparsePoints.h), and of even points less than four thirds of the closing radius.
float sparsestOfLeaf(const PlanItem& item)
{
  return item.node->leaf && item.closingRadius > 0.0f ? radiusOfSpacing * item.spacing : 0.0f;
}

} // namespace

void matchNeighbours(std::vector<DrawBatch>& batches, const std::vector<NodeElsewhere>& elsewhere)
{
  std::vector<DrawnNode> nodes = nodesOf(batches, elsewhere);
  refine(nodes);
  const bool layered = std::any_of(nodes.begin(), nodes.end(),
    [&](const DrawnNode& drawn) { return drawn.layer != nodes.front().layer; });
  if (layered)
  {
    matchLayers(nodes);
  }
  for (DrawBatch& batch : batches)
  {
    for (PlanItem& item : batch.items)
    {
      const auto drawn = std::lower_bound(nodes.begin(), nodes.end(), item.node->node, before);
      item.closingRadius = drawn->closingRadius;
      item.sparsestRadius = std::max(drawn->sparsestRadius, sparsestOfLeaf(item));
      item.growingSpacingPx = drawn->growingSpacingPx;
      item.refined = drawn->refined;
      item.unfinished = drawn->unfinished;
    }
  }
}

} // namespace pointfront
