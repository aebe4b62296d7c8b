#include "pointfront/Trees/KdCut.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cassert>

namespace pointfront
{
namespace
{
std::uint64_t sum(const std::vector<KdShare>& shares)
{
  std::uint64_t points = 0;
  for (const KdShare& share : shares)
  {
    points += share.points;
  }
  return points;
}

/// The part of each share that falls on `weight` of `total`, rounded down.
std::vector<KdShare> portion(
  const std::vector<KdShare>& shares, std::uint64_t weight, std::uint64_t total)
{
  std::vector<KdShare> part = shares;
  for (KdShare& share : part)
  {
    // Shares are below 2^21 and weights below 2^42.
    share.points = total > 0 ? share.points * weight / total : 0;
  }
  return part;
}
} // namespace

std::uint64_t kdLeftPoints(std::uint64_t points, std::uint32_t nodePoints)
{
  const std::uint64_t nodes = (points + nodePoints - 1) / nodePoints;
  return std::min(points, (nodes + 1) / 2 * nodePoints);
}

KdCut::KdCut(const std::vector<KdCell>& cells, const KdRule& rule, std::uint16_t layer)
  : cells_(cells)
  , rule_(rule)
  , layer_(layer)
  , places_(cells.size())
{
  Region all;
  for (std::uint32_t i = 0; i < cells.size(); ++i)
  {
    all.items.push_back({ i, i, cells[i].count });
  }
  std::vector<Region> open;
  if (!cells.empty())
  {
    open.push_back(std::move(all));
  }
  while (!open.empty())
  {
    Region region = std::move(open.back());
    open.pop_back();
    std::uint64_t count = 0;
    for (const Item& item : region.items)
    {
      count += item.count;
    }
    const std::uint64_t own = count - sum(region.shares);
    if (own <= rule_.partPoints())
    {
      addPart(region, count);
    }
    else
    {
      const std::uint32_t node = addNode(region, count);
      if (!rule_.leavesOnly)
      {
        region.shares.push_back({ node, rule_.nodePoints });
      }
      region.parent = node;
      divide(std::move(region), own - rule_.innerPoints(), open);
    }
  }
  if (rule_.leavesOnly)
  {
    joinLevels();
  }
}

/// Every second level of inner nodes goes away; their children become those of the nodes above.
void KdCut::joinLevels()
{
  std::vector<PartNode> kept;
  std::vector<std::uint32_t> place(tree_.size()); // in `kept`, of each node or the one above it
  std::vector<bool> odd(tree_.size(), false);
  for (std::size_t i = 0; i < tree_.size(); ++i) // parents come before their children
  {
    const std::uint32_t parent = tree_[i].parent;
    odd[i] = parent != PartNode::none && !odd[parent];
    if (odd[i] && tree_[i].part == PartNode::none)
    {
      place[i] = place[parent];
      continue;
    }
    place[i] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(std::move(tree_[i]));
    kept.back().children.clear();
    if (parent != PartNode::none)
    {
      kept.back().parent = place[parent];
      kept[place[parent]].children.push_back(place[i]);
    }
  }
  tree_ = std::move(kept);
  shares_.assign(tree_.size(), {});
}

std::uint32_t KdCut::addNode(const Region& region, std::uint64_t count)
{
  const auto index = static_cast<std::uint32_t>(tree_.size());
  tree_.emplace_back();
  tree_.back().count = count;
  tree_.back().parent = region.parent;
  tree_.back().layer = layer_;
  shares_.push_back(region.shares);
  if (region.parent != PartNode::none)
  {
    tree_[region.parent].children.push_back(index);
  }
  return index;
}

void KdCut::addPart(const Region& region, std::uint64_t count)
{
  tree_[addNode(region, count)].part = parts_;
  for (const Item& item : region.items)
  {
    places_[item.place].part = parts_;
  }
  ++parts_;
}

/// Longest axis of the box of the region's cells. A single cell is divided along each axis in turn.
unsigned KdCut::longestAxis(const Region& region) const
{
  TreePosition low(UINT32_MAX);
  TreePosition high(0);
  for (const Item& item : region.items)
  {
    low = glm::min(low, cells_[item.cell].origin);
    high = glm::max(high, cells_[item.cell].origin);
  }
  if (low == high)
  {
    return region.depth % 3;
  }
  const TreePosition size = high - low;
  return size.x >= size.y && size.x >= size.z ? 0u : size.y >= size.z ? 1u : 2u;
}

/// The first item whose points, without what is owed of them, fill the left.
KdCut::Median KdCut::median(const Region& region, std::uint64_t leftPoints) const
{
  // A cell's weight is its area, but never more points than it has: sparse cells owe what they
  // have, others twice their even share.
  const std::uint64_t most = 2 * (sum(region.shares) + region.items.size()) / region.items.size();
  std::uint64_t total = 0;
  for (const Item& item : region.items)
  {
    total += std::min(item.count, most);
  }
  Median median;
  std::uint64_t weight = 0;
  std::uint64_t points = 0;
  for (std::size_t i = 0; i < region.items.size(); ++i)
  {
    const Item& item = region.items[i];
    const std::uint64_t weightAfter = weight + std::min(item.count, most);
    if (points + item.count >= leftPoints + sum(portion(region.shares, weightAfter, total)))
    {
      median.item = i;
      median.left = portion(region.shares, weight, total);
      median.inside = leftPoints + sum(median.left) - points;
      assert(median.inside <= item.count);
      return median;
    }
    weight = weightAfter;
    points += item.count;
  }
  assert(false); // all points together always do
  return median;
}

void KdCut::divide(Region region, std::uint64_t own, std::vector<Region>& open)
{
  const unsigned axis = longestAxis(region);
  const auto before = [&](const Item& a, const Item& b)
  {
    const std::uint32_t pa = cells_[a.cell].origin[static_cast<int>(axis)];
    const std::uint32_t pb = cells_[b.cell].origin[static_cast<int>(axis)];
    return pa != pb ? pa < pb : a.cell != b.cell ? a.cell < b.cell : a.place < b.place;
  };
  std::sort(region.items.begin(), region.items.end(), before);
  const Median at = median(region, kdLeftPoints(own, rule_.nodePoints));
  Region left;
  Region right;
  left.parent = right.parent = region.parent;
  left.depth = right.depth = region.depth + 1;
  left.items.assign(
    region.items.begin(), region.items.begin() + static_cast<std::ptrdiff_t>(at.item));
  right.items.assign(
    region.items.begin() + static_cast<std::ptrdiff_t>(at.item) + 1, region.items.end());
  Item median = region.items[at.item];
  if (at.inside == median.count)
  {
    left.items.push_back(median);
  }
  else if (at.inside == 0)
  {
    right.items.push_back(median);
  }
  else
  {
    KdPlace& place = places_[median.place];
    place.axis = static_cast<std::uint8_t>(axis);
    place.first = at.inside;
    place.left = static_cast<std::uint32_t>(places_.size());
    place.right = place.left + 1;
    left.items.push_back({ median.cell, place.left, at.inside });
    right.items.push_back({ median.cell, place.right, median.count - at.inside });
    places_.resize(places_.size() + 2);
  }
  left.shares = at.left;
  right.shares = region.shares;
  for (std::size_t i = 0; i < at.left.size(); ++i)
  {
    right.shares[i].points -= at.left[i].points;
  }
  open.push_back(std::move(right));
  open.push_back(std::move(left)); // the last in is the first out
}

} // namespace pointfront
