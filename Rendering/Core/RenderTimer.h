#pragma once

#include <vtkRenderWindowInteractor.h>
#include <vtkWeakPointer.h>

#include <functional>

namespace pointfront
{

/// Renders an interactor's window from a timer of it, whenever somebody wants it: what a program
/// without an event loop of its own needs to see a view refine.
/// Threads  the interactor's.
class RenderTimer
{
public:
  /// `wanted` is asked some thirty times a second; true: the window is rendered.
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
