#pragma once

#include "pointfront/Detail/DetailWalk.h"

#include <cstdint>
#include <vector>

namespace pointfront
{

/// How deep each layer of a view is shown (SMOOTH-2, -3, LAYERS-11). Levels are as in
/// DetailLevel.h.
/// Wanted   the level of the overview; or, if the frustum has fewer points of the overview than the
///          image has pixels, the level that fills the pixels. Pixels are counted at targetErrorPx:
///          a third of the error wants nine times the points. Hidden layers have no points.
/// Common   one level for all layers: the highest up to the wanted that fits the budgets, in
///          eighths from the overview's; if even that does not, the overview is made smaller.
/// Own      a layer with a share of the budgets also has a level of its own, the highest that fits
///          the share, and is shown at the higher one of the two. So it never gets less than its
///          share allows, and an unused part of the share raises the common level (as in
///          FrontThreshold).
/// Steady   from the view and the table alone, whatever is loaded and came before.
/// Threads  one. Allocates only when the number of layers changes.
class DetailLevels
{
public:
  /// `walk` has begun with this view and these limits.
  void choose(
    DetailWalk& walk, const Hierarchy& hierarchy, const View& view, const FrontLimits& limits);

  /// By layer.
  const std::vector<DetailWalk::Shown>& shown() const { return shown_; }
  /// The lowest of the visible layers, and what the view would have without budgets.
  double lowest() const { return lowest_; }
  double wanted() const { return wanted_; }
  /// A level as a threshold: four times fewer points than the pixels ask for are twice the error.
  double errorAt(double level) const;
  bool bound() const { return lowest_ < wanted_; } ///< by a budget
  FrontBudget boundBy() const { return boundBy_; } ///< if bound()

private:
  struct LayerLevel
  {
    double own = 0.0; ///< below any level without a share, or if not even the overview fits it
    Demand demand; ///< at its own level
  };

  DetailWalk::Shown leastShown() const;
  DetailWalk::Shown shownAt(double level) const;
  template <typename FitsAt>
  bool highestFitting(FitsAt fitsAt, double& level) const;
  void chooseOwn(DetailWalk& walk, const FrontLimits& limits);
  void chooseCommon(DetailWalk& walk, const FrontLimits& limits);
  bool fitsAt(DetailWalk& walk, const FrontLimits& limits, double level);
  void adopt(const DetailWalk& walk, double common);

  std::vector<LayerLevel> layers_;
  std::vector<DetailWalk::Shown> shown_;
  double all_ = 1.0; ///< points of the store
  double overview_ = 0.0; ///< level
  double wanted_ = 0.0;
  double lowest_ = 0.0;
  double targetErrorPx_ = 1.0;
  FrontBudget boundBy_ = FrontBudget::Points;
  std::uint64_t leastSlots_ = 0; ///< slotsBeyond() of all layers together
};

} // namespace pointfront
