#include "pointfront/Front/FrontDemand.h"

#include <algorithm>

namespace pointfront
{

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
    ActiveNode child;
    if (!tree_.childOf(parent, c, child))
    {
      continue; // its row is coming: the threshold stays until then
    }
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

/// Demand curves in the making.
struct FrontDemand::Curves
{
  DemandCurve& drawn;
  DemandCurve& held;
  DemandCurve drawnUpTo; ///< points that are drawn at all thresholds up to a step
  DemandCurve heldUpTo;
};

/// `beginPx`: the node is held at thresholds below this.
void FrontDemand::addBelow(const ActiveNode& node, double beginPx, Curves& curves) const
{
  const bool replace = refinement_ == Refinement::Replace;
  if (!node.visible && !replace)
  {
    return;
  }
  const std::size_t begin = DemandCurve::stepOf(beginPx);
  curves.heldUpTo[begin] += node.pointCount;
  if (!node.visible)
  {
    return; // a sibling that must be there before its parent is replaced
  }
  const std::size_t whole = std::min(begin, DemandCurve::stepOf(node.errorPx));
  if (replace)
  {
    const std::size_t end = node.leaf() ? 0 : whole; // its children come in its place there
    for (std::size_t s = end; s <= begin; ++s)
    {
      curves.drawn[s] += node.pointCount;
    }
  }
  else
  {
    curves.drawnUpTo[whole] += node.pointCount;
    for (std::size_t s = whole + 1; s <= begin; ++s)
    {
      curves.drawn[s] += pointsOf(node, refinement_, DemandCurve::pxOf(s));
    }
  }
  for (std::uint8_t c = 0; node.expanded() && c < node.childCount; ++c)
  {
    const ActiveNode& child = tree_[node.children + c];
    // Prefixes begin before the parent's error is reached.
    const double ratio = child.spacingRatio > 0.0f ? child.spacingRatio : 1.0;
    const double ownBegin = replace ? node.errorPx : child.errorPx / ratio;
    addBelow(child, std::min(beginPx, ownBegin), curves);
  }
}

void FrontDemand::curves(DemandCurve& drawn, DemandCurve& held) const
{
  drawn.clear();
  held.clear();
  Curves making{ drawn, held, {}, {} };
  for (SlotIndex root = 0; root < tree_.rootCount(); ++root)
  {
    if (!tree_[root].hidden)
    {
      // Roots stay in memory; a prefix of one point is the least that is drawn.
      addBelow(tree_[root], DemandCurve::pxOf(DemandCurve::size - 1), making);
    }
  }
  std::uint64_t drawnSum = 0;
  std::uint64_t heldSum = 0;
  for (std::size_t s = DemandCurve::size; s-- > 0;)
  {
    drawn[s] += drawnSum += making.drawnUpTo[s];
    held[s] += heldSum += making.heldUpTo[s];
  }
}

} // namespace pointfront
