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
/// Of a node's ground, what another has to share to say how dense it is there.
constexpr double leastShare = 0.25;

struct LayeredItem
{
  PlanItem* item;
  std::uint16_t layer;
  NodeIndex node() const { return item->node->node; }
};

std::vector<LayeredItem> itemsOf(std::vector<DrawBatch>& batches)
{
  std::vector<LayeredItem> items;
  for (DrawBatch& batch : batches)
  {
    for (PlanItem& item : batch.items)
    {
      items.push_back({ &item, batch.layer });
    }
  }
  std::sort(items.begin(), items.end(),
    [](const LayeredItem& a, const LayeredItem& b) { return a.node() < b.node(); });
  return items;
}

/// What closes the surface among finer nodes, from those that are drawn: the largest of those that
/// are all there, but at most twice the mean over their points, as a few strays are no surface.
/// Without such nodes the smallest: how far apart points are where some are left out is a matter of
/// pixels (FramePlan::spacingPx), and what is far away, where nodes are coarse, says nothing about
/// what is near.
struct FinerRadii
{
  double points = 0.0; ///< of nodes that are all there
  double sum = 0.0;    ///< of their radii
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
  static FinerRadii of(const PlanItem& item)
  {
    FinerRadii radii;
    const double radius = item.closingRadius;
    radii.sparsest = item.closingRadius;
    radii.unfinished = item.unfinished;
    radii.points = item.unfinished || radius == 0.0 ? 0.0 : double(item.last - item.first);
    radii.sum = radii.points * radius;
    radii.largestFinished = item.unfinished ? 0.0f : item.closingRadius;
    radii.leastUnfinished = item.unfinished ? item.closingRadius : 0.0f;
    return radii;
  }
  float closing() const
  {
    const auto bound = static_cast<float>(points > 0.0 ? mostOfMean * sum / points : 0.0);
    return points > 0.0 ? std::min(largestFinished, bound) : leastUnfinished;
  }
};

void refine(const std::vector<LayeredItem>& items)
{
  std::vector<FinerRadii> finer(items.size());
  // Children stand behind their parents in every table: each is finished when it is passed on.
  for (std::size_t child = items.size(); child-- > 0;)
  {
    PlanItem& item = *items[child].item;
    const FinerRadii radii = item.refined ? finer[child] : FinerRadii::of(item);
    item.sparsestRadius = radii.sparsest;
    item.unfinished = radii.unfinished;
    item.closingRadius = item.refined ? radii.closing() : item.closingRadius;
    const NodeIndex parent = item.node->parent;
    auto place = std::lower_bound(items.begin(), items.end(), parent,
      [](const LayeredItem& other, NodeIndex node) { return other.node() < node; });
    for (; place != items.end() && place->node() == parent; ++place)
    {
      place->item->refined = true;
      place->item->growingSpacingPx =
        std::max(place->item->growingSpacingPx, item.growingSpacingPx);
      finer[static_cast<std::size_t>(place - items.begin())].add(radii);
    }
  }
}

/// The radius that half of all points have at most.
float medianRadius(const std::vector<LayeredItem>& items)
{
  std::vector<std::pair<float, std::uint64_t>> radii;
  std::uint64_t points = 0;
  for (const LayeredItem& one : items)
  {
    radii.emplace_back(one.item->closingRadius, one.item->last - one.item->first);
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

/// A node's ground in world units.
struct Ground
{
  glm::dvec2 low;
  glm::dvec2 high;
};
Ground groundOf(const PlanItem& item, const QuantisationGrid& grid)
{
  const glm::dvec3 low = grid.toWorld(item.node->origin);
  const glm::dvec3 size = 2.0 * glm::dvec3(item.node->halfSize);
  return { { low.x, low.y }, { low.x + size.x, low.y + size.y } };
}

bool shares(const Ground& mine, const Ground& other)
{
  const glm::dvec2 common = glm::min(mine.high, other.high) - glm::max(mine.low, other.low);
  const glm::dvec2 own = mine.high - mine.low;
  return common.x > 0.0 && common.y > 0.0 && common.x * common.y >= leastShare * own.x * own.y;
}

void matchLayers(const std::vector<LayeredItem>& items, const QuantisationGrid& grid)
{
  const float median = medianRadius(items);
  std::vector<Ground> grounds;
  std::vector<float> radii; // as they are before any is changed
  for (const LayeredItem& one : items)
  {
    grounds.push_back(groundOf(*one.item, grid));
    radii.push_back(one.item->closingRadius);
  }
  for (std::size_t i = 0; i < items.size(); ++i)
  {
    float densest = radii[i];
    for (std::size_t j = 0; radii[i] > mostOfDenser * median && j < items.size(); ++j)
    {
      if (items[j].layer != items[i].layer && radii[j] > 0.0f && radii[j] < densest &&
        shares(grounds[i], grounds[j]))
      {
        densest = radii[j];
      }
    }
    PlanItem& item = *items[i].item;
    item.closingRadius = std::min(radii[i], mostOfDenser * densest);
    item.sparsestRadius = std::min(item.sparsestRadius, mostOfDenser * densest);
  }
}

} // namespace

void matchNeighbours(std::vector<DrawBatch>& batches, const QuantisationGrid& grid)
{
  const std::vector<LayeredItem> items = itemsOf(batches);
  refine(items);
  const bool layered = std::any_of(batches.begin(), batches.end(),
    [&](const DrawBatch& batch) { return batch.layer != batches.front().layer; });
  if (layered)
  {
    matchLayers(items, grid);
  }
}

} // namespace pointfront
