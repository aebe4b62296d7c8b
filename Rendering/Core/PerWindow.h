#pragma once

#include <vtkWeakPointer.h>
#include <vtkWindow.h>

#include <iterator>
#include <map>
#include <memory>
#include <utility>

namespace pointfront
{

/// An object that all clouds of a window share: one for each type and window, made on the first
/// request. It lives as long as one cloud holds it. Clouds of a window that is gone may hold its:
/// the next window, often at the same address, gets another.
/// Threads  the renderer's only.
template <typename Shared>
std::shared_ptr<Shared> perWindow(vtkWindow* window)
{
  static std::map<vtkWindow*, std::pair<vtkWeakPointer<vtkWindow>, std::weak_ptr<Shared>>> windows;
  for (auto entry = windows.begin(); entry != windows.end();)
  {
    const auto& [alive, shared] = entry->second;
    entry = alive && !shared.expired() ? std::next(entry) : windows.erase(entry);
  }
  auto& [alive, known] = windows[window];
  auto shared = known.lock();
  if (!shared)
  {
    shared = std::make_shared<Shared>();
    alive = window;
    known = shared;
  }
  return shared;
}

} // namespace pointfront
