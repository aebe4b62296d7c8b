#pragma once

#include <vtkWindow.h>

#include <iterator>
#include <map>
#include <memory>

namespace pointfront
{

/// An object that all clouds of a window share: one for each type and window, made on the first
/// request. It lives as long as one cloud holds it.
/// Threads  the renderer's only.
template <typename Shared>
std::shared_ptr<Shared> perWindow(vtkWindow* window)
{
  static std::map<vtkWindow*, std::weak_ptr<Shared>> windows;
  for (auto entry = windows.begin(); entry != windows.end();)
  {
    entry = entry->second.expired() ? windows.erase(entry) : std::next(entry);
  }
  std::weak_ptr<Shared>& known = windows[window];
  auto shared = known.lock();
  if (!shared)
  {
    shared = std::make_shared<Shared>();
    known = shared;
  }
  return shared;
}

} // namespace pointfront
