#pragma once

#include "pointfront/Front/DetailSelection.h"

#include <memory>

namespace pointfront
{

/// View-specific detail, the alternative to a rendering front: an overview of the whole cloud that
/// never leaves memory, and for the view one detail level, chosen so that its frustum holds about
/// as many points as the image has pixels.
/// Level       every subtree shows the same share of its points: by detailLevel() from the overview
///             points in the frustum, counted from the table. Where a frustum cuts a node, the part
///             inside is measured at 64 places of its box. The image's pixels are counted at
///             targetErrorPx: a third of the error wants nine times the points.
/// Chunks      our nodes hold thousands of points. With Refinement::Add a node draws a prefix of
///             its points (a fair subset) and leaves the rest of its subtree's share to its
///             children; with Replace it is drawn until its share is more than its own
///             representatives.
/// Order       requests near to far by slices of the frustum; the overview before all, in sight
///             or not. A subtree whose sphere falls on one pixel is not descended.
/// Budgets     hard. The level falls by eighths until what it draws and holds fits; if even the
///             overview does not, that is made smaller. Layers can be hidden and have factors;
///             shares of layers are not kept (all are drawn at one level).
/// Guarantees  those of DetailSelection. What was on screen goes only when the level or the
///             frustum leaves it, not while something else loads. With Add the ancestors of what is
///             drawn are drawn too, whole.
/// Cost        of an update in which something changed: a walk over the nodes that it shows; of a
///             new view one more to check the budgets, and some eight more where they hold the
///             level down. No memory is taken in the steady state. FrontLimits::movesPerFrame and
///             initialErrorPx mean nothing here.
/// Source      Futterlieb, Teutsch & Berndt 2016, section 3.1 (SMOOTH-2, SMOOTH-3).
class ViewDetail final : public DetailSelection
{
public:
  explicit ViewDetail(std::shared_ptr<const Hierarchy> hierarchy);
  ~ViewDetail() override;

  const FrontDelta& update(
    const View& view, const ResidencyView& residency, const FrontLimits& limits) override;
  /// Above the threshold in force estimated, without another walk: a quarter of the points for
  /// twice the error.
  void demandCurves(DemandCurve& drawn, DemandCurve& held) const override;
  std::uint32_t distanceUnderFront(NodeIndex node) const override;
  void reset() override;

  /// Of the last update, as log2 of the points that the whole store would show.
  double level() const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace pointfront
