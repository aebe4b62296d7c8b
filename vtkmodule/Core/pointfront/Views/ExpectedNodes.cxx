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
  parents_.clear();
  for (const TabledNode& node : nodes_)
  {
    parents_.push_back(node.row.parent);
  }
  std::sort(parents_.begin(), parents_.end());
  points_ = 0;
  refinedPoints_.clear();
  for (const TabledNode& node : nodes_)
  {
    points_ += node.item.pointCount;
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

std::uint32_t ExpectedNodes::finerNodes(NodeIndex node) const
{
  const auto range = std::equal_range(parents_.begin(), parents_.end(), node);
  return static_cast<std::uint32_t>(range.second - range.first);
}

} // namespace pointfront
