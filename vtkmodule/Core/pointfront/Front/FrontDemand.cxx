#include "pointfront/Front/FrontDemand.h"

#include <algorithm>

namespace pointfront
{

Demand FrontDemand::joined(const ActiveNode& node, const Demand& children, double thresholdPx) const
{
  const std::uint64_t own = node.visible ? pointsOf(node, refinement_, thresholdPx) : 0;
  if (refinement_ == Refinement::Replace)
  {
    // The parent stands in while a child is missing: both must fit.
    return { std::max(own, children.drawn), std::max(gpuSlotsOf(own), children.slots),
      node.pointCount + children.held };
  }
  return { own + children.drawn, gpuSlotsOf(own) + children.slots,
    (own > 0 ? node.pointCount : 0) + children.held };
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
    tree_.evaluate(child, view_, 0);
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

/// `beginPx`: the node is held at thresholds below this. `upTo` gets what is taken at all
/// thresholds up to a step, `at` the rest.
void FrontDemand::addBelow(
  const ActiveNode& node, double beginPx, DemandCurves& at, DemandCurves& upTo) const
{
  const bool replace = refinement_ == Refinement::Replace;
  if (!node.visible && !replace)
  {
    return;
  }
  const std::size_t begin = DemandCurve::stepOf(beginPx);
  upTo.held[begin] += node.pointCount;
  if (!node.visible)
  {
    return; // a sibling that must be there before its parent is replaced
  }
  const std::size_t whole = std::min(begin, DemandCurve::stepOf(node.errorPx));
  const auto add = [&](std::size_t step, std::uint32_t points)
  {
    at.drawn[step] += points;
    at.slots[step] += gpuSlotsOf(points);
  };
  if (replace)
  {
    const std::size_t end = node.leaf() ? 0 : whole; // its children come in its place there
    for (std::size_t s = end; s <= begin; ++s)
    {
      add(s, node.pointCount);
    }
  }
  else
  {
    upTo.drawn[whole] += node.pointCount;
    upTo.slots[whole] += gpuSlotsOf(node.pointCount);
    for (std::size_t s = whole + 1; s <= begin; ++s)
    {
      add(s, pointsOf(node, refinement_, DemandCurve::pxOf(s)));
    }
  }
  for (std::uint8_t c = 0; node.expanded() && c < node.childCount; ++c)
  {
    const ActiveNode& child = tree_[node.children + c];
    // Prefixes begin before the parent's error is reached.
    const double ratio = child.spacingRatio > 0.0f ? child.spacingRatio : 1.0;
    const double ownBegin = replace ? node.errorPx : child.errorPx / ratio;
    addBelow(child, std::min(beginPx, ownBegin), at, upTo);
  }
}

void FrontDemand::curves(DemandCurves& curves) const
{
  curves = {};
  DemandCurves upTo;
  for (SlotIndex root = 0; root < tree_.rootCount(); ++root)
  {
    if (!tree_[root].hidden)
    {
      // Roots stay in memory; a prefix of one point is the least that is drawn.
      addBelow(tree_[root], DemandCurve::pxOf(DemandCurve::size - 1), curves, upTo);
    }
  }
  const auto sum = [](DemandCurve& curve, const DemandCurve& below)
  {
    std::uint64_t all = 0;
    for (std::size_t s = DemandCurve::size; s-- > 0;)
    {
      curve[s] += all += below[s];
    }
  };
  sum(curves.drawn, upTo.drawn);
  sum(curves.slots, upTo.slots);
  sum(curves.held, upTo.held);
}

} // namespace pointfront
