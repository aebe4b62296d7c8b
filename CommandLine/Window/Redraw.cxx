#include "Redraw.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>

#include <algorithm>

namespace pointfront
{

Redraw::Redraw(vtkRenderWindowInteractor* interactor, std::function<Pause()> look)
  : interactor_(interactor)
  , look_(std::move(look))
{
  command_->SetClientData(this);
  command_->SetCallback([](vtkObject*, unsigned long, void* self, void* timer)
    { static_cast<Redraw*>(self)->fire(timer != nullptr ? *static_cast<int*>(timer) : -1); });
  interactor->AddObserver(vtkCommand::TimerEvent, command_);
}

Redraw::~Redraw()
{
  if (interactor_)
  {
    interactor_->RemoveObserver(command_);
  }
}

void Redraw::wake(std::chrono::milliseconds within)
{
  const Clock::time_point due = Clock::now() + within;
  if (!interactor_ || (timer_ >= 0 && due_ <= due))
  {
    return;
  }
  if (timer_ >= 0)
  {
    interactor_->DestroyTimer(timer_);
  }
  const auto pause = std::max<std::chrono::milliseconds::rep>(within.count(), 1);
  timer_ = interactor_->CreateOneShotTimer(static_cast<unsigned long>(pause));
  due_ = due;
}

void Redraw::fire(int timer)
{
  if (timer != timer_)
  {
    return; // another's, or one that was replaced
  }
  timer_ = -1;
  if (const Pause pause = look_())
  {
    wake(*pause);
  }
}

} // namespace pointfront
