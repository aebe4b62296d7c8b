#include "pointfront/InPlace/QuadTree.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pointfront
{
namespace
{
constexpr std::uint64_t mostChildren = 255;

double areaOf(const Square& square)
{
  return std::ldexp(1.0, static_cast<int>(2 * square.logSide));
}
} // namespace

QuadTree::QuadTree(const CellGrid& grid, std::uint32_t leafPoints)
  : grid_(grid)
  , leafPoints_(leafPoints)
{
  const Found whole = build(grid.whole());
  if (whole.points > 0)
  {
    arrange(draftOf(whole));
    chooseSteps();
  }
  drafts_ = {};
}

QuadTree::Found QuadTree::buildCell(const CellGrid::Range& range)
{
  CellGrid::Range inside;
  if (grid_.cut(range, inside))
  {
    return build(inside);
  }
  Found found;
  found.points = grid_.points(range);
  found.area = found.points > 0 ? areaOf(range.square) : 0.0;
  found.range = range;
  return found;
}

QuadTree::Found QuadTree::build(const CellGrid::Range& range)
{
  if (range.bits == 0)
  {
    return buildCell(range);
  }
  std::array<Found, 4> parts;
  Found sum;
  sum.range = range;
  unsigned filled = 0;
  unsigned last = 0;
  for (unsigned which = 0; which < parts.size(); ++which)
  {
    parts[which] = build(CellGrid::quadrant(range, which));
    sum.points += parts[which].points;
    sum.area += parts[which].area;
    if (parts[which].points > 0)
    {
      ++filled;
      last = which;
    }
  }
  if (sum.points <= leafPoints_)
  {
    return sum; // still part of a leaf
  }
  if (filled == 1)
  {
    return parts[last];
  }
  Draft draft;
  draft.node.points = sum.points;
  draft.node.area = sum.area;
  draft.node.square = range.square;
  for (const Found& part : parts)
  {
    if (part.points > 0)
    {
      draft.children.push_back(draftOf(part));
    }
  }
  sum.draft = static_cast<std::uint32_t>(drafts_.size());
  drafts_.push_back(std::move(draft));
  return sum;
}

std::uint32_t QuadTree::draftOf(const Found& found)
{
  if (found.draft != noNode)
  {
    return found.draft;
  }
  Draft draft;
  draft.node.points = found.points;
  draft.node.area = found.area;
  draft.node.square = found.range.square;
  draft.node.range = found.range;
  if (found.points > leafPoints_)
  {
    slice(draft); // one grid position in the plane
  }
  drafts_.push_back(std::move(draft));
  return static_cast<std::uint32_t>(drafts_.size() - 1);
}

void QuadTree::slice(Draft& draft)
{
  QuadNode& node = draft.node;
  const std::uint64_t slices =
    std::min<std::uint64_t>(mostChildren, (node.points + leafPoints_ - 1) / leafPoints_);
  node.sliced = true;
  node.sliceStep = (node.points + slices - 1) / slices;
  for (std::uint64_t begin = 0; begin < node.points; begin += node.sliceStep)
  {
    Draft part;
    part.node.points = std::min(node.sliceStep, node.points - begin);
    part.node.area = node.area;
    part.node.square = node.square;
    draft.children.push_back(static_cast<std::uint32_t>(drafts_.size()));
    drafts_.push_back(std::move(part));
  }
}

void QuadTree::arrange(std::uint32_t root)
{
  std::vector<std::uint32_t> drafts{ root }; // numbers in nodes_, in its order
  nodes_.push_back(drafts_[root].node);
  for (std::size_t i = 0; i < nodes_.size(); ++i)
  {
    const std::vector<std::uint32_t>& children = drafts_[drafts[i]].children;
    nodes_[i].childCount = static_cast<std::uint8_t>(children.size());
    nodes_[i].firstChild = children.empty() ? noNode : static_cast<NodeIndex>(nodes_.size());
    const std::uint8_t level = nodes_[i].level;
    for (const std::uint32_t child : children)
    {
      QuadNode node = drafts_[child].node;
      node.parent = static_cast<NodeIndex>(i);
      node.level = static_cast<std::uint8_t>(level + 1);
      nodes_.push_back(node);
      drafts.push_back(child);
    }
  }
}

void QuadTree::chooseSteps()
{
  for (QuadNode& node : nodes_)
  {
    if (node.leaf())
    {
      continue;
    }
    std::uint8_t logStep = 0;
    while ((node.points >> logStep) > leafPoints_ / 2)
    {
      ++logStep;
    }
    node.logStep = node.parent == noNode ? logStep : std::min(logStep, nodes_[node.parent].logStep);
  }
}

void QuadTree::assignCells(CellGrid& grid) const
{
  for (NodeIndex i = 0; i < nodes_.size(); ++i)
  {
    const bool slice = nodes_[i].parent != noNode && nodes_[nodes_[i].parent].sliced;
    if (nodes_[i].sliced || (nodes_[i].leaf() && !slice))
    {
      grid.assign(nodes_[i].range, i);
    }
  }
}

std::vector<QuadTree::Holder> QuadTree::holdersAbove(NodeIndex node) const
{
  std::vector<Holder> holders;
  for (NodeIndex above = nodes_[node].parent; above != noNode; above = nodes_[above].parent)
  {
    const NodeIndex parent = nodes_[above].parent;
    if (parent == noNode || nodes_[parent].logStep != nodes_[above].logStep)
    {
      holders.push_back({ above, nodes_[above].logStep });
    }
  }
  std::reverse(holders.begin(), holders.end());
  return holders;
}

} // namespace pointfront
