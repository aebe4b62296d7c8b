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

/// VTK and ParaView set rates of 5 and more in motion, of 0.002 and less at rest.
constexpr double interactiveRate = 0.01;

} // namespace

bool isInteracting(vtkRenderer* renderer)
{
  vtkRenderWindow* const window = renderer->GetRenderWindow();
  return window && window->GetDesiredUpdateRate() > interactiveRate;
}

RendererFront::RendererFront(vtkRenderer* renderer, vtkActor* actor, std::function<void()> unseen)
  : Renderer(renderer)
  , Actor(actor)
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
  if (before && !this->Seen && this->View.front())
  {
    this->View.front()->leave();
    this->Unseen();
  }
}

bool RendererFront::NeedsRender()
{
  if (this->View.front() && !this->Seen)
  {
    return false;
  }
  if (!this->View.front() || this->UploadsLeft)
  {
    return true;
  }
  if (this->View.request().interacting && !this->Complete && !isInteracting(this->Renderer))
  {
    return true; // the time of a frame in motion limited the picture; at rest the view shows more
  }
  const bool again = this->LeftOut && !this->LeftOutBefore && !this->View.request().interacting;
  return this->View.needsFrame(this->NewFrame) || again; // asked anyway: it moves the front
}

} // namespace pointfront
