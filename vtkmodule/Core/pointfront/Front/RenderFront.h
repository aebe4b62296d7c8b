#pragma once

#include "pointfront/Front/DetailSelection.h"

#include <memory>

namespace pointfront
{

/// The cut through a hierarchy that is drawn this frame.
/// Front       the cut that the threshold asks for is kept from update to update and moved by the
///             table alone (FRONT-5, -6). Its resident nodes are drawn. Missing nodes are
///             requested, and their ancestors stand in for them (Add: ancestors are drawn anyway;
///             Replace: a node stands in until all of its children are there).
/// Threshold   starts at initialErrorPx and falls by a fifth an update while moves are not used up
///             and requests not piled up (FRONT-7). Budgets act on it: the lowest threshold whose
///             demand fits is taken, so the largest errors win, and a view that needs more settles
///             instead of thrashing. Layers have factors, shares and switches (LayerLimits.h).
/// Shapes      FrontDelta::draw is ordered near to far, ties by NodeIndex: two runs give the same
///             list.
/// Units       error in pixels; distances in world units.
/// Guarantees  detail that was on screen does not disappear while its replacement is loading. The
///             nodes of the front are a cut: no node of it is an ancestor of another, each
///             root-to-leaf path meets it once. With Refinement::Add the ancestors of what is drawn
///             are drawn too, whole, each point once; with Replace no ancestor of what is drawn
///             is. Never more than pointBudget points.
/// Never       opens a file, blocks, allocates GPU memory or includes VTK. It only names nodes. In
///             the steady state it does not allocate.
/// Errors      none; a node that failed to load stays unrequested, and what stands in goes on being
///             drawn. With Add its descendants, which are stored apart, are still refined into.
/// Threads     one instance, one thread; View and ResidencySnapshot are snapshots.
/// Source      Richter & Doellner 2010, section 3.2.1 (the rendering front); FRONT-4..8;
///             Richter, Discher & Doellner 2015, section 4.2 (LAYERS-11).
class RenderFront final : public DetailSelection
{
public:
  explicit RenderFront(std::shared_ptr<const Hierarchy> hierarchy);
  ~RenderFront() override;

  /// One frame. The result is owned by the front and valid until the next call.
  const FrontDelta& update(
    const View& view, const ResidencySnapshot& residency, const FrontLimits& limits) override;

  /// The demand of the last update's view on screen, on the GPU and in memory, at each threshold
  /// from the one in force upwards. Lower thresholds have the present demand; step 0 is what is
  /// drawn.
  void demandCurves(DemandCurves& curves) const override;

  /// FRONT-10, first pass: the number of levels that a node lies below the part of the front that
  /// the last update needed. 0: the update needed the node itself, which must stay. Nodes with
  /// larger numbers may be released first. Branches out of sight count from their last ancestor in
  /// sight; a hidden layer needs no node, not even its root. Does not wait for a paged table: a
  /// node nowhere near the front counts as far below it.
  std::uint32_t distanceUnderFront(NodeIndex node) const override;

  /// Back to the roots and the initial threshold.
  void reset() override;

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace pointfront
