#include "pointfront/Neighbourhood/KdIndex.h"

#include <glm/common.hpp>

#include <algorithm>
#include <numeric>

namespace pointfront
{
namespace
{
constexpr std::uint32_t leafPlaces = 12;
} // namespace

KdIndex::KdIndex(const PositionSet& set, int axes)
  : set_(set)
  , axes_(axes)
  , order_(set.positions.size())
{
  std::iota(order_.begin(), order_.end(), 0u);
  if (!order_.empty())
  {
    divide(0, static_cast<std::uint32_t>(order_.size()));
  }
}

std::uint32_t KdIndex::divide(std::uint32_t begin, std::uint32_t end)
{
  const auto number = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({ 0.0, -1, 0, begin, end });
  if (end - begin <= leafPlaces)
  {
    return number;
  }
  glm::dvec3 low = set_.positions[order_[begin]];
  glm::dvec3 high = low;
  for (std::uint32_t i = begin; i < end; ++i)
  {
    low = glm::min(low, set_.positions[order_[i]]);
    high = glm::max(high, set_.positions[order_[i]]);
  }
  const glm::dvec3 size = high - low;
  int axis = size.y > size.x ? 1 : 0;
  axis = axes_ > 2 && size.z > size[axis] ? 2 : axis;
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
    [&](std::uint32_t a, std::uint32_t b)
    { return set_.positions[a][axis] < set_.positions[b][axis]; });
  const double cut = set_.positions[order_[middle]][axis];
  divide(begin, middle); // the node that follows this one
  const std::uint32_t above = divide(middle, end);
  nodes_[number].cut = cut;
  nodes_[number].axis = axis;
  nodes_[number].above = above;
  return number;
}

void KdIndex::search(const glm::dvec3& from, NeighbourList& list) const
{
  if (!nodes_.empty())
  {
    glm::dvec3 beyond(0.0);
    visit(0, from, beyond, list);
  }
}

/// `beyond`: along each axis, how far the node's half space is from `from`.
void KdIndex::visit(
  std::uint32_t node, const glm::dvec3& from, glm::dvec3& beyond, NeighbourList& list) const
{
  const Node& here = nodes_[node];
  if (here.axis < 0)
  {
    for (std::uint32_t i = here.begin; i < here.end; ++i)
    {
      const glm::dvec3 d = set_.positions[order_[i]] - from;
      list.offer(axes_ > 2 ? d.x * d.x + d.y * d.y + d.z * d.z : d.x * d.x + d.y * d.y, order_[i]);
    }
    return;
  }
  const double past = from[here.axis] - here.cut;
  visit(past < 0.0 ? node + 1 : here.above, from, beyond, list);
  const double before = beyond[here.axis];
  beyond[here.axis] = past;
  const double distance = beyond.x * beyond.x + beyond.y * beyond.y + beyond.z * beyond.z;
  if (distance <= list.bound())
  {
    visit(past < 0.0 ? here.above : node + 1, from, beyond, list);
  }
  beyond[here.axis] = before;
}

} // namespace pointfront
