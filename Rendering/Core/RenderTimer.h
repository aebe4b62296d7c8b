#pragma once

#include <vtkRenderWindowInteractor.h>
#include <vtkWeakPointer.h>

#include <functional>

namespace pointfront
{

/// Renders an interactor's window from one of its timers, whenever a render is wanted. A program
/// without an event loop of its own needs this to see a view refine.
/// Threads  the interactor's.
class RenderTimer
{
public:
  /// `wanted` is called some thirty times a second; if it returns true, the window is rendered.
  explicit RenderTimer(std::function<bool()> wanted)
    : wanted_(std::move(wanted))
  {
  }
  ~RenderTimer() { stop(); }
  RenderTimer(const RenderTimer&) = delete;
  RenderTimer& operator=(const RenderTimer&) = delete;

  void start(vtkRenderWindowInteractor* interactor);
  void stop();

private:
  std::function<bool()> wanted_;
  vtkWeakPointer<vtkRenderWindowInteractor> interactor_;
  int timer_ = -1;
  unsigned long tag_ = 0;
};

} // namespace pointfront
