#pragma once

#include "pointfront/Front/FrontDelta.h"
#include "pointfront/Front/GpuSlots.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace pointfront
{

/// The resources that a selection of detail would take.
struct Demand
{
  std::uint64_t drawn = 0; ///< points on screen
  std::uint64_t slots = 0; ///< slots of GPU memory for them
  std::uint64_t held = 0; ///< points of the nodes that must be in memory for that, whole nodes

  Demand& operator+=(const Demand& more)
  {
    drawn += more.drawn;
    slots += more.slots;
    held += more.held;
    return *this;
  }
};

// Whether a demand fits the budgets of FrontLimits: the budgets of the store alone, and the shared
// limits less what others take of them; for the whole store or for the share of one layer
// (LAYERS-11). Every selection of detail uses these functions.
// Units    points; `px` is the threshold that the demand is of: what others take depends on it.

enum class FrontBudget
{
  Points,
  GpuMemory,
  HostMemory
};

/// By any budget.
inline bool limited(const FrontLimits& limits)
{
  return limits.pointBudget > 0 || limits.heldPointBudget > 0 || limits.sharedDrawn.most > 0 ||
    limits.sharedSlots.most > 0 || limits.sharedHeld.most > 0;
}

/// Share of a layer, 0 to 1; shares of the visible layers that come to more than 1 are cut down.
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

inline bool fitsBudget(
  std::uint64_t points, std::uint64_t budget, const SharedLimit& shared, double share, double px)
{
  const auto part = [&](std::uint64_t whole)
  { return share < 1.0 ? static_cast<std::uint64_t>(share * static_cast<double>(whole)) : whole; };
  return (budget == 0 || points <= part(budget)) &&
    (shared.most == 0 || points <= part(shared.leftAt(px)));
}

/// Where not even the least demand fits into the GPU's memory, the slots of it; 0 where it fits.
inline std::uint64_t slotsBeyond(
  const FrontLimits& limits, const Demand& least, double share, double px)
{
  return fitsBudget(least.slots, 0, limits.sharedSlots, share, px) ? 0 : least.slots;
}

/// The first budget that the demand breaks, if it breaks one. `leastSlots` are slotsBeyond(): a
/// coarser selection would not free any, but leave those that can be had nearly empty, so they do
/// not count. The plan then fills as many as there are.
inline std::optional<FrontBudget> brokenBudget(const FrontLimits& limits, const Demand& wanted,
  double share, double px, std::uint64_t leastSlots = 0)
{
  if (!fitsBudget(wanted.drawn, limits.pointBudget, limits.sharedDrawn, share, px))
  {
    return FrontBudget::Points;
  }
  const std::uint64_t slots = wanted.slots <= leastSlots ? 0 : wanted.slots;
  if (!fitsBudget(slots, 0, limits.sharedSlots, share, px))
  {
    return FrontBudget::GpuMemory;
  }
  if (!fitsBudget(wanted.held, limits.heldPointBudget, limits.sharedHeld, share, px))
  {
    return FrontBudget::HostMemory;
  }
  return std::nullopt;
}

/// How many points may be drawn when a list is made, at any threshold: the budget less what the
/// other clouds have on screen at this moment.
class DrawAllowance
{
public:
  void begin(const FrontLimits& limits)
  {
    points_ = limits.pointBudget > 0 ? limits.pointBudget : UINT64_MAX;
    if (limits.sharedDrawn.most > 0)
    {
      points_ = std::min(points_, limits.sharedDrawn.leftAt(0.0));
    }
    slots_ = limits.sharedSlots.most > 0 ? limits.sharedSlots.leftAt(0.0) : UINT64_MAX;
    cutByPoints_ = cutBySlots_ = false;
    std::fill(shown_.begin(), shown_.end(), Shown::Unwanted);
  }
  /// Takes the points that a node of a layer draws, as many as the budget allows.
  std::uint32_t take(std::uint32_t points, std::uint16_t layer)
  {
    const std::uint64_t inSlots = slots_ < UINT32_MAX ? slots_ * gpuSlotPoints : UINT64_MAX;
    const std::uint64_t most = std::min(points_, inSlots);
    const auto taken = static_cast<std::uint32_t>(std::min<std::uint64_t>(points, most));
    cutByPoints_ = cutByPoints_ || (taken < points && points_ <= inSlots);
    cutBySlots_ = cutBySlots_ || (taken < points && inSlots < points_);
    points_ -= taken;
    slots_ -= gpuSlotsOf(taken);
    shown_.resize(std::max<std::size_t>(shown_.size(), layer + std::size_t(1)), Shown::Unwanted);
    shown_[layer] = std::max(
      shown_[layer], taken > 0 ? Shown::Some : (points > 0 ? Shown::Nothing : Shown::Unwanted));
    return taken;
  }
  std::uint64_t slots() const { return slots_; } ///< that are left
  bool cutByPoints() const { return cutByPoints_; }
  bool cutBySlots() const { return cutBySlots_; }
  /// FrontDelta::layersLeftOut.
  void listLeftOut(std::vector<std::uint16_t>& layers) const
  {
    layers.clear();
    for (std::size_t layer = 0; layer < shown_.size(); ++layer)
    {
      shown_[layer] == Shown::Nothing ? layers.push_back(static_cast<std::uint16_t>(layer))
                                      : void();
    }
  }

private:
  enum class Shown : std::uint8_t
  {
    Unwanted,
    Nothing, ///< though points were wanted
    Some
  };
  std::uint64_t points_ = UINT64_MAX;
  std::uint64_t slots_ = UINT64_MAX;
  bool cutByPoints_ = false; ///< a node drew fewer points than it should, by the budget of points
  bool cutBySlots_ = false; ///< likewise, by the GPU's memory
  std::vector<Shown> shown_; ///< by layer
};

} // namespace pointfront
