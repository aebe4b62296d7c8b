#pragma once

#include "pointfront/Front/ActiveTree.h"
#include "pointfront/Front/FrontBudgets.h"
#include "pointfront/Front/FrontDemand.h"
#include "pointfront/Front/RenderFront.h"
#include "pointfront/Front/ThresholdLadder.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pointfront
{

/// The threshold of each layer of a front, from update to update (FRONT-7, LAYERS-11).
/// Common    one rung for all layers: the lowest whose demand fits the budgets, so the largest
///           errors win. It falls by a fifth an update while nothing holds it, and rises at once.
/// Own       a layer with a share of the budgets has a rung of its own beside it, the lowest that
///           fits that share, and works with the lower of the two. So it never gets less than its
///           share, nor leaves any of it unused: what it does not need lowers the common rung.
/// Steady    a rung that proved too low for a view (the tree below it grew beyond the budget) is
///           not tried again for that view. Decided from the table alone, whatever is loaded.
/// Threads   one. Allocates only when the number of layers changes.
class FrontThreshold
{
public:
  /// Begins an update. `mayFall`: the update before left no moves over.
  void begin(const FrontLimits& limits, const ActiveTree& tree, bool inputChanged, bool mayFall);
  /// The lowest threshold that choose() may give a layer: nodes above it must be evaluated first.
  double lowestPx(std::uint16_t layer) const;
  void choose(const ActiveTree& tree, const FrontDemand& demand);

  /// The threshold in force for a layer, in the (weighted) pixels of ActiveNode::errorPx.
  double px(std::uint16_t layer) const
  {
    return layer < layers_.size() ? layers_[layer].px : commonPx_;
  }
  /// The largest threshold of the visible layers.
  double largestPx(const ActiveTree& tree) const;

  /// Adds the demand of an expansion; false, and nothing added, if that breaks a budget.
  bool admit(const Demand& more);

  /// By any budget.
  bool limited() const;
  bool changed() const { return changed_; } ///< by the last choose()
  bool atTarget() const { return common_.rung == 0; }
  bool bound() const { return common_.bound; } ///< by a budget, which keeps the next lower rung out
  FrontBudget boundBy() const { return boundBy_; } ///< if bound()
  /// Whether the present demand of the others leaves the choice as it was: the shared limits do not
  /// bind it, and it still fits.
  bool unmoved() const;
  /// Whether the next update will try a lower threshold if nothing is missing.
  bool falling() const;

private:
  struct Rung
  {
    int rung = 0;
    int goal = 0; ///< goal of this update
    int lowest = 0; ///< proved too low for this view and these limits below it
    bool bound = false;
  };
  struct LayerRung
  {
    Rung own;
    double share = 0.0; ///< 0: none
    double px = 0.0; ///< in force
  };

  int rungOf(std::uint16_t layer) const;
  Demand totalAt(const ActiveTree& tree, const FrontDemand& demand, int common) const;
  void chooseFitting(const ActiveTree& tree, const FrontDemand& demand);
  template <typename FitsAt>
  void settle(Rung& state, int highest, FitsAt fitsAt);
  int highestOf(const ActiveTree& tree) const;
  Demand layerAt(
    const ActiveTree& tree, const FrontDemand& demand, std::size_t layer, int rung) const;
  void adoptLayers(const ActiveTree& tree);
  /// Rest of the shared limits, drawn, slots and held; 0 where there is none.
  using Left = std::array<std::uint64_t, 3>;
  Left sharedLeft(double px) const;
  bool moreLeft() const;

  ThresholdLadder ladder_;
  FrontLimits limits_;
  Rung common_;
  double commonPx_ = 0.0;
  std::vector<LayerRung> layers_;
  int floor_ = 0; ///< FRONT-7: of the motion
  bool first_ = true;
  bool mayFall_ = false;
  bool changed_ = false;
  FrontBudget boundBy_ = FrontBudget::Points;
  Left leftAtLowest_{}; ///< when common_.lowest was found
  std::uint64_t leastSlots_ = 0; ///< slotsBeyond() of all layers together
  Demand demand_; ///< the last one that fits: of the thresholds in force
};

} // namespace pointfront
