#pragma once

#include <vtkNew.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkWeakPointer.h>

#include <chrono>
#include <functional>
#include <optional>

class vtkCallbackCommand;

namespace pointfront
{

/// Looks after a window from its own event loop: calls a function again and again as long as the
/// function asks for it, and lets the program sleep when it does not.
/// Threads  the interactor's.
class Redraw
{
public:
  using Pause = std::optional<std::chrono::milliseconds>;
  /// `look` tells when it wants to be called again; nothing: after the next wake().
  Redraw(vtkRenderWindowInteractor* interactor, std::function<Pause()> look);
  ~Redraw();
  Redraw(const Redraw&) = delete;
  Redraw& operator=(const Redraw&) = delete;

  /// Calls within that time, or earlier if that was arranged before.
  void wake(std::chrono::milliseconds within = std::chrono::milliseconds(0));

private:
  using Clock = std::chrono::steady_clock;
  void fire(int timer);

  vtkWeakPointer<vtkRenderWindowInteractor> interactor_;
  vtkNew<vtkCallbackCommand> command_;
  std::function<Pause()> look_;
  int timer_ = -1; ///< -1: the program sleeps
  Clock::time_point due_;
};

} // namespace pointfront
