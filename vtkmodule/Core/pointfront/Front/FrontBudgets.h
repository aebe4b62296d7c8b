#pragma once

#include "pointfront/Front/FrontDelta.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace pointfront
{

/// What a selection of detail would take.
struct Demand
{
  std::uint64_t drawn = 0; ///< points on screen
  std::uint64_t held = 0;  ///< points of the nodes that must be in memory for that, whole nodes

  Demand& operator+=(const Demand& more)
  {
    drawn += more.drawn;
    held += more.held;
    return *this;
  }
};

// Whether a demand fits the budgets of FrontLimits: of a store alone and beside what others take
// of the limits shared with them, all of it or the share of one layer (LAYERS-11). The same for
// every selection of detail.
// Units    points; `px` is the threshold that the demand is of: what others take depends on it.

/// By any budget.
inline bool limited(const FrontLimits& limits)
{
  return limits.pointBudget > 0 || limits.heldPointBudget > 0 || limits.sharedDrawn.points > 0 ||
    limits.sharedHeld.points > 0;
}

/// Of a layer, 0 to 1; shares of the visible layers that come to more than 1 are cut down.
inline double shareOf(const std::vector<LayerLimits>& layers, std::size_t layer)
{
  double sum = 0.0;
  for (const LayerLimits& each : layers)
  {
    sum += each.visible ? each.share : 0.0;
  }
  const bool given = layer < layers.size() && layers[layer].visible;
  return given ? layers[layer].share / std::max(1.0, sum) : 0.0;
}

inline bool fitsBudget(std::uint64_t points, std::uint64_t budget, const SharedLimit& shared,
  double share, double px)
{
  const auto part = [&](std::uint64_t whole)
  {
    return share < 1.0 ? static_cast<std::uint64_t>(share * static_cast<double>(whole)) : whole;
  };
  return (budget == 0 || points <= part(budget)) &&
    (shared.points == 0 || points <= part(shared.leftAt(px)));
}

inline bool drawnFits(const FrontLimits& limits, std::uint64_t points, double share, double px)
{
  return fitsBudget(points, limits.pointBudget, limits.sharedDrawn, share, px);
}

inline bool fitsBudgets(const FrontLimits& limits, const Demand& wanted, double share, double px)
{
  return drawnFits(limits, wanted.drawn, share, px) &&
    fitsBudget(wanted.held, limits.heldPointBudget, limits.sharedHeld, share, px);
}

} // namespace pointfront
