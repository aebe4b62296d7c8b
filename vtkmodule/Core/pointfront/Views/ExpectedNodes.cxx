#include "pointfront/Views/ExpectedNodes.h"

#include <algorithm>
#include <utility>

namespace pointfront
{

ExpectedNodes::ExpectedNodes(
  std::shared_ptr<const Hierarchy> hierarchy, WholeFront::Selection selection)
  : hierarchy_(std::move(hierarchy))
  , selection_(selection)
{
}

void ExpectedNodes::listReplaced()
{
  replaced_.clear();
  std::vector<NodeIndex> above;
  for (const TabledNode& node : nodes_)
  {
    above.push_back(node.row.parent);
  }
  while (refinement() == Refinement::Replace && !above.empty())
  {
    std::sort(above.begin(), above.end());
    above.erase(std::unique(above.begin(), above.end()), above.end());
    std::vector<NodeIndex> next;
    for (const NodeIndex node : above)
    {
      Node row;
      if (node != noNode && hierarchy_->peek(node, row) == RowState::Here)
      {
        replaced_.push_back({ { node, row.pointCount, 0.0f, 0.0f, 0.0f }, row });
        next.push_back(row.parent);
      }
    }
    above = std::move(next);
  }
  const auto before = [](const TabledNode& a, const TabledNode& b)
  { return a.item.node < b.item.node; };
  const auto same = [](const TabledNode& a, const TabledNode& b)
  { return a.item.node == b.item.node; };
  std::sort(replaced_.begin(), replaced_.end(), before);
  replaced_.erase(std::unique(replaced_.begin(), replaced_.end(), same), replaced_.end());
}

void ExpectedNodes::update(const View& view, const FrontLimits& limits, double thresholdPx)
{
  if (!front_)
  {
    front_ = std::make_unique<WholeFront>(hierarchy_, selection_);
    seen_ = 0;
  }
  const FrontDelta& delta = front_->update(view, limits, thresholdPx, {});
  thresholdPx_ = delta.thresholdPx;
  if (delta.number == seen_)
  {
    return;
  }
  seen_ = delta.number;
  nodes_ = front_->drawn([](NodeIndex) { return true; });
  listReplaced();
  parents_.clear();
  for (const std::vector<TabledNode>* const nodes : { &nodes_, &replaced_ })
  {
    for (const TabledNode& node : *nodes)
    {
      parents_.push_back(node.row.parent);
    }
  }
  std::sort(parents_.begin(), parents_.end());
  points_ = 0;
  refinedPoints_.clear();
  for (const TabledNode& node : nodes_)
  {
    points_ += node.item.pointCount;
  }
  for (const TabledNode& node : refinement() == Refinement::Replace ? replaced_ : nodes_)
  {
    const std::size_t level = node.row.level;
    refinedPoints_.resize(std::max(refinedPoints_.size(), level + 1), 0);
    refinedPoints_[level] += finerNodes(node.item.node) > 0 ? node.item.pointCount : 0;
  }
}

void ExpectedNodes::finish()
{
  front_.reset();
}

const TabledNode* ExpectedNodes::find(NodeIndex node) const
{
  const auto found = std::lower_bound(nodes_.begin(), nodes_.end(), node,
    [](const TabledNode& each, NodeIndex wanted) { return each.item.node < wanted; });
  return found != nodes_.end() && found->item.node == node ? &*found : nullptr;
}

bool ExpectedNodes::passesOver(NodeIndex node) const
{
  const bool isAbove = std::binary_search(parents_.begin(), parents_.end(), node);
  Node row;
  while (!isAbove && node != noNode && !find(node))
  {
    if (hierarchy_->peek(node, row) != RowState::Here)
    {
      return false;
    }
    node = row.parent;
  }
  return !isAbove && node == noNode;
}

std::uint32_t ExpectedNodes::finerNodes(NodeIndex node) const
{
  const auto range = std::equal_range(parents_.begin(), parents_.end(), node);
  return static_cast<std::uint32_t>(range.second - range.first);
}

} // namespace pointfront
