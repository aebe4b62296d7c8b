#include "pointfront/Plan/ClosingRadii.h"

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace pointfront
{
namespace
{

constexpr float mostOfDenser = 2.0f;
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

void refine(const std::vector<LayeredItem>& items)
{
  // Children stand behind their parents in every table: each is finished when it is passed on.
  for (auto child = items.rbegin(); child != items.rend(); ++child)
  {
    const NodeIndex parent = child->item->node->parent;
    auto place = std::lower_bound(items.begin(), items.end(), parent,
      [](const LayeredItem& item, NodeIndex node) { return item.node() < node; });
    for (; place != items.end() && place->node() == parent; ++place)
    {
      PlanItem& above = *place->item;
      above.closingRadius = above.refined
        ? std::max(above.closingRadius, child->item->closingRadius)
        : child->item->closingRadius;
      above.refined = true;
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
    items[i].item->closingRadius = std::min(radii[i], mostOfDenser * densest);
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
