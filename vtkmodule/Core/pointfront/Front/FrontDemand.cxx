#include "pointfront/Front/FrontDemand.h"

#include "pointfront/Front/PointPrefix.h"

#include <algorithm>

namespace pointfront
{

std::uint32_t FrontDemand::pointsOf(
  const ActiveNode& node, Refinement refinement, double thresholdPx)
{
  return refinement == Refinement::Replace
    ? node.pointCount
    : prefixLength(node.pointCount, node.errorPx, node.spacingRatio, thresholdPx);
}

Demand FrontDemand::joined(
  const ActiveNode& node, const Demand& children, double thresholdPx) const
{
  const std::uint64_t own = node.visible ? pointsOf(node, refinement_, thresholdPx) : 0;
  if (refinement_ == Refinement::Replace)
  {
    // The parent stands in while a child is missing: both must fit.
    return { std::max(own, children.drawn), node.pointCount + children.held };
  }
  return { own + children.drawn, (own > 0 ? node.pointCount : 0) + children.held };
}

Demand FrontDemand::ofChildren(const ActiveNode& parent, double thresholdPx) const
{
  Demand sum;
  for (std::uint8_t c = 0; c < parent.childCount; ++c)
  {
    ActiveNode child = tree_.childOf(parent, c);
    evaluate(child, view_, 0);
    sum += joined(child, {}, thresholdPx);
  }
  return sum;
}

Demand FrontDemand::below(const ActiveNode& node, double thresholdPx) const
{
  Demand children;
  if (node.visible && node.errorPx > thresholdPx && !node.leaf())
  {
    if (!node.expanded())
    {
      return joined(node, ofChildren(node, thresholdPx), thresholdPx);
    }
    for (std::uint8_t c = 0; c < node.childCount; ++c)
    {
      children += below(tree_[node.children + c], thresholdPx);
    }
  }
  return joined(node, children, thresholdPx);
}

} // namespace pointfront
