#pragma once

#include "pointfront/Front/ActiveTree.h"
#include "pointfront/Front/DrawOrder.h"
#include "pointfront/Front/FrontThreshold.h"
#include "pointfront/Front/NodeRequests.h"
#include "pointfront/Front/RenderFront.h"

#include <cstdint>
#include <vector>

namespace pointfront
{

/// Decides which nodes of the active tree are drawn and which are requested, given the resident
/// ones: the last step of an update. Also marks every node that the view needs
/// (ActiveNode::needed).
/// Threads  one.
class FrontPlan
{
public:
  /// Fills draw, requests, pointsDrawn, errorPx and failedNodes of `delta`.
  void make(ActiveTree& tree, const FrontThreshold& threshold, const ResidencySnapshot& residency,
    const FrontLimits& limits, std::uint32_t update, FrontDelta& delta);

  /// Nodes that the view needs and that are neither resident nor failed.
  std::uint32_t missing() const { return requests_.missing(); }
  // The budget that cut points off: where nodes are drawn whole, or there is not a slot of GPU
  // memory for each root.
  bool cutByPoints() const { return allowance_.cutByPoints(); }
  bool cutBySlots() const { return allowance_.cutBySlots(); }

private:
  struct Visit
  {
    double errorAbovePx; ///< on screen while this node is missing
    bool drawable; ///< all that must be there before something of this branch is drawn is
    bool itself; ///< Replace: this node can stand in for its branch
  };
  using Presence = ResidencySnapshot::State;

  void listRoots(const FrontThreshold& threshold);
  void visitAdd(SlotIndex slot, Visit visit);
  void visitReplace(SlotIndex slot, Visit visit);
  bool childrenReady(const ActiveNode& node, double errorPx);
  Presence require(ActiveNode& node, double priority);
  std::uint32_t draw(const ActiveNode& node, std::uint32_t points);
  void prefetch(const ActiveNode& node, double priority);
  void noteError(const ActiveNode& node, std::uint32_t drawn, bool refined);

  ActiveTree* tree_ = nullptr;
  const FrontLimits* limits_ = nullptr;
  FrontDelta* delta_ = nullptr;
  NodeRequests requests_;
  DrawOrder order_;
  DrawAllowance allowance_;
  double thresholdPx_ = 0.0; ///< threshold of the layer being visited
  std::uint32_t update_ = 0;
  std::vector<SlotIndex> roots_; ///< those of layers that are shown, in the order of visits
};

} // namespace pointfront
