#pragma once

#include "pointfront/Front/DetailSelection.h"

#include <memory>

namespace pointfront
{

/// View-specific detail, the alternative to a rendering front: an overview of the whole cloud that
/// never leaves memory, and for the view one detail level, chosen so that its frustum holds about
/// as many points as the image has pixels.
/// Level       chosen by DetailLevels, the list made by DetailWalk. Layers can be hidden, have
///             factors and shares of the budgets, with the meaning that they have for a front
///             (LayerLimits.h): a layer with a share may be shown deeper than the others.
/// Budgets     hard. Levels fall by eighths until what they draw and hold fits; if even the
///             overview does not, that is made smaller.
/// Guarantees  those of DetailSelection. A point on screen goes only when the level or the frustum
///             leaves it, not while other nodes load. With Add the ancestors of what is drawn are
///             drawn too, whole.
/// Cost        of an update in which something changed: a walk over the nodes that it shows; of a
///             new view one more to check the budgets, and some eight more where they hold the
///             level down. No memory is taken in the steady state. FrontLimits::movesPerFrame and
///             initialErrorPx mean nothing here.
/// Source      Futterlieb, Teutsch & Berndt 2016, section 3.1 (SMOOTH-2, SMOOTH-3); Richter,
///             Discher & Doellner 2015, section 4.2 (LAYERS-11).
class ViewDetail final : public DetailSelection
{
public:
  explicit ViewDetail(std::shared_ptr<const Hierarchy> hierarchy);
  ~ViewDetail() override;

  const FrontDelta& update(
    const View& view, const ResidencySnapshot& residency, const FrontLimits& limits) override;
  /// Above the threshold in force estimated, without another walk: a quarter of the points for
  /// twice the error.
  void demandCurves(DemandCurves& curves) const override;
  std::uint32_t distanceUnderFront(NodeIndex node) const override;
  void reset() override;

  /// The level of the last update, the lowest of its layers', as log2 of the points that the whole
  /// store would show.
  double level() const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace pointfront
