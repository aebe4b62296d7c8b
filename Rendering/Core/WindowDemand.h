#pragma once

#include "pointfront/Front/SharedDemand.h"

#include <vtkWindow.h>

#include <iterator>
#include <map>
#include <memory>

namespace pointfront
{

/// What all clouds of a window draw, in points: their views settle at one error. It lives as long
/// as one of them holds it.
/// Threads  the renderer's only.
inline std::shared_ptr<SharedDemand> demandOf(vtkWindow* window)
{
  static std::map<vtkWindow*, std::weak_ptr<SharedDemand>> windows;
  for (auto entry = windows.begin(); entry != windows.end();)
  {
    entry = entry->second.expired() ? windows.erase(entry) : std::next(entry);
  }
  std::weak_ptr<SharedDemand>& known = windows[window];
  auto demand = known.lock();
  if (!demand)
  {
    demand = std::make_shared<SharedDemand>();
    known = demand;
  }
  return demand;
}

} // namespace pointfront
