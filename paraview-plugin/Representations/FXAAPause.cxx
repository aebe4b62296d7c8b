#include "FXAAPause.h"

#include "vtkCommand.h"
#include "vtkPVRenderView.h"
#include "vtkRenderer.h"

namespace pointfront
{

void FXAAPause::begin(vtkPVRenderView* view)
{
  end(); // a frame may not have been rendered here
  if (view->GetUseFXAA())
  {
    view->SetUseFXAA(false);
    view_ = view;
    observer_ = view->GetRenderer()->AddObserver(vtkCommand::EndEvent, this, &FXAAPause::end);
  }
}

void FXAAPause::end()
{
  if (view_)
  {
    view_->GetRenderer()->RemoveObserver(observer_);
    view_->SetUseFXAA(true);
    view_ = nullptr;
  }
}

} // namespace pointfront
