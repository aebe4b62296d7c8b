#include "RendererFront.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>

#include <utility>

namespace pointfront
{
namespace
{

/// From one drawing to the next, in times of a drawing.
constexpr double pauseOfDrawings = 3.0;
/// VTK and ParaView set rates of 5 and more in motion, of 0.002 and less at rest.
constexpr double interactiveRate = 0.01;

} // namespace

bool isInteracting(vtkRenderer* renderer)
{
  vtkRenderWindow* const window = renderer->GetRenderWindow();
  return window && window->GetDesiredUpdateRate() > interactiveRate;
}

RendererFront::RendererFront(vtkRenderer* renderer, std::function<void()> unseen)
  : Renderer(renderer)
  , Unseen(std::move(unseen))
{
  vtkNew<vtkCallbackCommand> begin;
  begin->SetClientData(this);
  begin->SetCallback([](vtkObject*, unsigned long, void* data, void*)
    { static_cast<RendererFront*>(data)->NewFrame = true; });
  this->StartTag = renderer->AddObserver(vtkCommand::StartEvent, begin);
  vtkNew<vtkCallbackCommand> end;
  end->SetClientData(this);
  end->SetCallback([](vtkObject*, unsigned long, void* data, void*)
    { static_cast<RendererFront*>(data)->EndFrame(); });
  this->EndTag = renderer->AddObserver(vtkCommand::EndEvent, end);
}

RendererFront::~RendererFront()
{
  if (this->Renderer)
  {
    this->Renderer->RemoveObserver(this->StartTag);
    this->Renderer->RemoveObserver(this->EndTag);
  }
}

/// A frame that was broken off, or that is drawn for a selection, says nothing.
void RendererFront::EndFrame()
{
  this->Plan.reset();
  vtkRenderWindow* window = this->Renderer->GetRenderWindow();
  if (this->Renderer->GetSelector() || (window && window->GetAbortRender()))
  {
    return;
  }
  const bool before = this->Seen;
  this->Seen = !this->NewFrame;
  if (before && !this->Seen && this->Front)
  {
    this->Front->leave();
    this->Unseen();
  }
}

bool RendererFront::NeedsRender()
{
  if (this->Front && !this->Seen)
  {
    return false;
  }
  if (!this->Front || this->UploadsLeft || this->Due)
  {
    return true;
  }
  if (this->Demand.interacting && !this->Complete && !isInteracting(this->Renderer))
  {
    return true; // the time of a frame in motion limited the picture; at rest the view shows more
  }
  const std::chrono::duration<double, std::milli> passed = Clock::now() - this->DrawnAt;
  const bool paused = !this->NewFrame && !this->Demand.interacting && !this->Demand.complete &&
    passed.count() < pauseOfDrawings * this->DrawingMs;
  if (paused && this->Front->wantsUpdate())
  {
    this->Front->update(this->Demand);
    this->Ahead = true;
  }
  this->Due = (this->Ahead || this->Front->wantsUpdate() || this->Growth.growing()) &&
    !(paused && this->Front->expectsMore());
  return this->Due;
}

GrowthMoment RendererFront::MomentOf(double growthMilliseconds) const
{
  GrowthMoment moment;
  moment.seconds = std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
  moment.duration = this->Demand.complete ? 0.0 : 1e-3 * growthMilliseconds;
  moment.moving = this->Demand.interacting;
  return moment;
}

} // namespace pointfront
