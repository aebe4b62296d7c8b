#include "RenderTimer.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkNew.h>

namespace pointfront
{
namespace
{

constexpr unsigned long milliseconds = 30;

} // namespace

void RenderTimer::start(vtkRenderWindowInteractor* interactor)
{
  stop();
  interactor_ = interactor;
  vtkNew<vtkCallbackCommand> tick;
  tick->SetClientData(this);
  tick->SetCallback(
    [](vtkObject* caller, unsigned long, void* data, void*)
    {
      if (static_cast<RenderTimer*>(data)->wanted_())
      {
        static_cast<vtkRenderWindowInteractor*>(caller)->Render();
      }
    });
  tag_ = interactor->AddObserver(vtkCommand::TimerEvent, tick);
  timer_ = interactor->CreateRepeatingTimer(milliseconds);
}

void RenderTimer::stop()
{
  if (interactor_)
  {
    interactor_->RemoveObserver(tag_);
    interactor_->DestroyTimer(timer_);
  }
  interactor_ = nullptr;
}

} // namespace pointfront
