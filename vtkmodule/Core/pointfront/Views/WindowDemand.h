#pragma once

#include "pointfront/Front/SharedDemand.h"
#include "pointfront/Views/RootWait.h"
#include "pointfront/Views/WindowCost.h"

#include <cstdint>
#include <memory>
#include <utility>

namespace pointfront
{

/// The demand of all clouds of a window; by it their views settle at one error.
struct WindowDemand
{
  std::shared_ptr<SharedDemand> points = std::make_shared<SharedDemand>(); ///< on screen
  std::shared_ptr<SharedDemand> slots = std::make_shared<SharedDemand>(); ///< slots of GPU memory
  std::shared_ptr<WindowCost> cost = std::make_shared<WindowCost>();
  std::shared_ptr<RootWait> roots = std::make_shared<RootWait>(); ///< for the roots of first frames
};

/// One view's part.
struct WindowClaims
{
  explicit WindowClaims(std::shared_ptr<const WindowDemand> demand)
    : window(std::move(demand))
    , points(window->points)
    , slots(window->slots)
  {
  }
  std::uint64_t revision() const { return points.revision() + slots.revision(); }

  std::shared_ptr<const WindowDemand> window; ///< lives as long as somebody claims
  SharedDemand::Claim points;
  SharedDemand::Claim slots;
};

} // namespace pointfront
