#pragma once

#include "vtkWeakPointer.h"

class vtkPVRenderView;

namespace pointfront
{

/// Switches a view's FXAA, which takes single points for noise, off for one frame.
/// Threads  main thread.
class FXAAPause
{
public:
  FXAAPause() = default;
  FXAAPause(const FXAAPause&) = delete;
  void operator=(const FXAAPause&) = delete;
  ~FXAAPause() { end(); }

  /// Before the view renders the frame. The end of that frame ends the pause.
  void begin(vtkPVRenderView* view);
  void end();

private:
  vtkWeakPointer<vtkPVRenderView> view_; ///< null: no pause
  unsigned long observer_ = 0;
};

} // namespace pointfront
