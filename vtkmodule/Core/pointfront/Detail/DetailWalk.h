#pragma once

#include "pointfront/Front/DrawOrder.h"
#include "pointfront/Front/FrontBudgets.h"
#include "pointfront/Front/NodeRequests.h"
#include "pointfront/Front/NodeSlots.h"
#include "pointfront/Front/View.h"
#include "pointfront/Store/Hierarchy.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pointfront
{

/// The nodes that one view shows when each layer has a share of its points to show: every
/// subtree of a layer the same share, in its own place.
/// Chunks    with Refinement::Add a node draws a prefix of its points (a fair subset) and leaves
///           the rest of its subtree's share to its children; with Replace it is drawn until its
///           share is more than its own representatives.
/// Order     requests near to far by slices of the frustum; the overview before all, in sight or
///           not. A subtree whose sphere falls on one pixel is not descended.
/// Ways      demand() counts what a layer would take, from the table alone; plan() makes the lists,
///           given what is resident. Both walk what they show, and nothing else.
/// Memory    none is taken in the steady state.
/// Threads   one.
/// Source    Futterlieb, Teutsch & Berndt 2016, section 3.1.2 (SMOOTH-3).
class DetailWalk
{
public:
  /// The share of a layer's points that is shown, 0 to 1.
  struct Shown
  {
    double overview = 0.0; ///< in sight or not, and kept in memory
    double detail = 0.0; ///< in sight
  };

  explicit DetailWalk(const Hierarchy& hierarchy);

  /// Sets view and limits for the next calls; they must outlive these.
  void begin(const View& view, const FrontLimits& limits);

  std::size_t layerCount() const { return layerCount_; }
  bool visible(std::size_t layer) const { return limitsOf(layer).visible; }
  /// Number of points below all roots; hidden layers too.
  double points() const { return points_; }

  /// The demand of a visible layer: the points that it would draw and hold.
  Demand demand(std::size_t layer, const Shown& shown);

  /// Fills draw, requests, pointsDrawn, errorPx, failedNodes and rowsComing of `delta`; draws
  /// as much as the limits allow. `shown` is by layer.
  void plan(const ResidencySnapshot& residency, const std::vector<Shown>& shown, FrontDelta& delta);

  // Counts of the last plan:
  std::uint32_t missing() const { return requests_.missing(); } ///< neither resident nor failed
  std::uint64_t held() const { return sum_.held; } ///< points of all nodes needed
  const NodeSlots& needed() const { return needed_; }
  // The budget that cut points off, as FrontPlan's:
  bool cutByPoints() const { return allowance_.cutByPoints(); }
  bool cutBySlots() const { return allowance_.cutBySlots(); }

private:
  struct Quota;
  struct Visit;
  struct Descent;

  const LayerLimits& limitsOf(std::size_t layer) const
  {
    return limitsOfLayer(limits_->layers, layer);
  }
  std::optional<std::uint32_t> drawableOf(NodeIndex node, const Node& row) const;
  Demand demandOfRoot(std::size_t root, const Shown& shown);
  void listRoots(const std::vector<Shown>& shown);
  void enter(std::size_t root, const Shown& shown);
  void visit(const Visit& at);
  void visitAdd(const Visit& at, bool inSight, double distance, bool onPixel);
  void visitReplace(const Visit& at, bool inSight, double distance, bool onPixel);
  void descend(const Visit& at, const Quota& left, const Descent& descent);
  bool childrenReady(const Visit& at, double priority);
  ResidencySnapshot::State require(NodeIndex node, const Node& row, double priority);
  std::uint32_t draw(const Visit& at, std::uint32_t count, double distance);
  void noteError(const Visit& at, std::uint32_t shown, double distance, bool refined);
  double errorOf(const Visit& at, double distance) const;
  double priorityOf(const Visit& at, double distance) const;
  void noteRow(RowState state, bool counted);

  const Hierarchy& hierarchy_;
  std::vector<Node> rootRows_;
  std::vector<std::size_t> roots_; ///< those of layers that are shown, in the order of the plan
  std::size_t layerCount_ = 0;
  double points_ = 0.0;
  const View* view_ = nullptr;
  const FrontLimits* limits_ = nullptr;
  const ResidencySnapshot* residency_ = nullptr; ///< null: the walk only counts
  FrontDelta* delta_ = nullptr; ///< null likewise
  Demand sum_;
  DrawAllowance allowance_;
  bool rowsComing_ = false;
  NodeSlots needed_;
  NodeRequests requests_;
  DrawOrder order_;
};

} // namespace pointfront
