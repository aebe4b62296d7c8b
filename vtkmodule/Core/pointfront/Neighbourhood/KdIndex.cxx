#include "pointfront/Neighbourhood/KdIndex.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::uint32_t leafPlaces = 12;

glm::vec3 rounded(const glm::dvec3& offset, float towards)
{
  const glm::vec3 nearest(offset);
  return { std::nextafter(nearest.x, towards), std::nextafter(nearest.y, towards),
    std::nextafter(nearest.z, towards) };
}
} // namespace

KdIndex::KdIndex(const PositionSet& set, int axes)
  : set_(set)
  , axes_(axes)
  , order_(set.positions.size())
{
  std::iota(order_.begin(), order_.end(), 0u);
  if (!order_.empty())
  {
    origin_ = set.positions.front();
    divide(0, static_cast<std::uint32_t>(order_.size()));
  }
}

std::uint32_t KdIndex::divide(std::uint32_t begin, std::uint32_t end)
{
  glm::dvec3 low = set_.positions[order_[begin]];
  glm::dvec3 high = low;
  for (std::uint32_t i = begin; i < end; ++i)
  {
    low = glm::min(low, set_.positions[order_[i]]);
    high = glm::max(high, set_.positions[order_[i]]);
  }
  constexpr float infinite = std::numeric_limits<float>::infinity();
  const auto number = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(
    { rounded(low - origin_, -infinite), rounded(high - origin_, infinite), 0, begin, end });
  if (end - begin <= leafPlaces)
  {
    return number;
  }
  const glm::dvec3 size = high - low;
  int axis = size.y > size.x ? 1 : 0;
  axis = axes_ > 2 && size.z > size[axis] ? 2 : axis;
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
    [&](std::uint32_t a, std::uint32_t b)
    { return set_.positions[a][axis] < set_.positions[b][axis]; });
  divide(begin, middle); // the node that follows this one
  const std::uint32_t above = divide(middle, end);
  nodes_[number].above = above;
  return number;
}

void KdIndex::search(const glm::dvec3& from, NeighbourList& list) const
{
  if (!nodes_.empty())
  {
    visit(0, from, list);
  }
}

/// From the place at that offset from the origin to the node's box, over the axes of the index.
double KdIndex::squaredDistance(std::uint32_t node, const glm::dvec3& offset) const
{
  const Node& here = nodes_[node];
  double sum = 0.0;
  for (int axis = 0; axis < axes_; ++axis)
  {
    const double out =
      std::max({ 0.0, here.low[axis] - offset[axis], offset[axis] - here.high[axis] });
    sum += out * out;
  }
  return sum;
}

void KdIndex::visit(std::uint32_t node, const glm::dvec3& from, NeighbourList& list) const
{
  const Node& here = nodes_[node];
  if (here.above == 0)
  {
    for (std::uint32_t i = here.begin; i < here.end; ++i)
    {
      const glm::dvec3 d = set_.positions[order_[i]] - from;
      list.offer(axes_ > 2 ? d.x * d.x + d.y * d.y + d.z * d.z : d.x * d.x + d.y * d.y, order_[i]);
    }
    return;
  }
  const glm::dvec3 offset = from - origin_;
  std::pair<double, std::uint32_t> nearer{ squaredDistance(node + 1, offset), node + 1 };
  std::pair<double, std::uint32_t> farther{ squaredDistance(here.above, offset), here.above };
  if (farther.first < nearer.first)
  {
    std::swap(nearer, farther);
  }
  for (const auto& [distance, child] : { nearer, farther })
  {
    if (distance <= list.bound())
    {
      visit(child, from, list);
    }
  }
}

} // namespace pointfront
