#pragma once

#include "pointfront/Front/ActiveTree.h"
#include "pointfront/Front/DemandCurve.h"
#include "pointfront/Front/FrontBudgets.h"
#include "pointfront/Front/PointPrefix.h"
#include "pointfront/Front/View.h"

#include <cstdint>

namespace pointfront
{

/// Counts, from the table alone, the demand of a threshold. Loaded nodes play no part, so a view
/// settles at the same threshold in whatever order its nodes arrive, and the front begins nothing
/// that it would have to take back when data comes. Front nodes above the threshold count with
/// their children (one level ahead of the tree). The demand never rises with the threshold, so
/// bisection finds the lowest threshold that fits.
class FrontDemand
{
public:
  /// Nodes that a threshold reaches must have been evaluated for this view.
  FrontDemand(const ActiveTree& tree, Refinement refinement, const View& view)
    : tree_(tree)
    , refinement_(refinement)
    , view_(view)
  {
  }

  /// The demand of the tree under a root, at a threshold in the pixels of ActiveNode::errorPx.
  Demand ofRoot(SlotIndex root, double thresholdPx) const
  {
    return below(tree_[root], thresholdPx);
  }
  /// The demand at all thresholds, of the active nodes alone.
  void curves(DemandCurves& curves) const;
  /// The demand of the children that a front node has in the table.
  Demand ofChildren(const ActiveNode& parent, double thresholdPx) const;
  /// Points of a visible node drawn at a threshold. Representatives (Replace) carry a
  /// radius that closes the surface when all of them are drawn: they come whole.
  static std::uint32_t pointsOf(const ActiveNode& node, Refinement refinement, double thresholdPx)
  {
    return refinement == Refinement::Replace
      ? node.pointCount
      : prefixLength(node.pointCount, node.errorPx, node.spacingRatio, thresholdPx);
  }

private:
  void addBelow(const ActiveNode& node, double beginPx, DemandCurves& at, DemandCurves& upTo) const;
  Demand below(const ActiveNode& node, double thresholdPx) const;
  Demand joined(const ActiveNode& node, const Demand& children, double thresholdPx) const;

  const ActiveTree& tree_;
  Refinement refinement_;
  const View& view_;
};

} // namespace pointfront
