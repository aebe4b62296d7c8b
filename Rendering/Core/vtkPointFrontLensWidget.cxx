#include "vtkPointFrontLensWidget.h"

#include "vtkPointFrontStyle.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkIndent.h>
#include <vtkObjectFactory.h>
#include <vtkRenderer.h>
#include <vtkRenderWindowInteractor.h>

#include <algorithm>

vtkStandardNewMacro(vtkPointFrontLensWidget);

namespace
{

constexpr double factorOfWheel = 1.15;
/// Before the interactor's style, so that the wheel with Ctrl does not zoom.
constexpr float beforeStyle = 0.5f;

} // namespace

vtkPointFrontLensWidget::vtkPointFrontLensWidget()
{
  this->EventCallbackCommand->SetCallback(vtkPointFrontLensWidget::ProcessEvents);
  this->KeyPressActivationValue = 'l';
  this->Priority = beforeStyle;
}

vtkPointFrontLensWidget::~vtkPointFrontLensWidget() = default;

void vtkPointFrontLensWidget::SetStyle(vtkPointFrontStyle* style)
{
  if (this->Style != style)
  {
    this->Style = style;
    this->Modified();
  }
}

vtkPointFrontStyle* vtkPointFrontLensWidget::GetStyle() const
{
  return this->Style;
}

void vtkPointFrontLensWidget::SetEnabled(int enabling)
{
  if (!this->Interactor)
  {
    vtkErrorMacro("the interactor must be set before the lens follows the mouse");
    return;
  }
  if ((enabling != 0) == (this->Enabled != 0))
  {
    return;
  }
  if (enabling && !this->HasLens())
  {
    vtkErrorMacro(
      "there is no lens " << this->Lens << ": set a style, and add a lens to it (AddCircleLens)");
    return;
  }
  this->Enabled = enabling ? 1 : 0;
  if (enabling)
  {
    for (const unsigned long event : { vtkCommand::MouseMoveEvent,
           vtkCommand::MouseWheelForwardEvent, vtkCommand::MouseWheelBackwardEvent })
    {
      this->Interactor->AddObserver(event, this->EventCallbackCommand, this->Priority);
    }
    this->InvokeEvent(vtkCommand::EnableEvent, nullptr);
  }
  else
  {
    this->Interactor->RemoveObserver(this->EventCallbackCommand);
    this->SetCurrentRenderer(nullptr);
    this->InvokeEvent(vtkCommand::DisableEvent, nullptr);
  }
}

bool vtkPointFrontLensWidget::HasLens() const
{
  return this->Style && this->Lens >= 0 && this->Lens < this->Style->GetNumberOfLenses();
}

void vtkPointFrontLensWidget::ProcessEvents(vtkObject*, unsigned long event, void* client, void*)
{
  auto* const self = static_cast<vtkPointFrontLensWidget*>(client);
  if (!self->HasLens())
  {
    return;
  }
  if (event == vtkCommand::MouseMoveEvent)
  {
    self->FollowMouse();
  }
  else if (self->Interactor->GetControlKey())
  {
    self->Resize(event == vtkCommand::MouseWheelForwardEvent ? factorOfWheel : 1.0 / factorOfWheel);
    self->EventCallbackCommand->SetAbortFlag(1);
  }
}

/// The lens counts pixels from the corner of the viewport that the mouse is in.
void vtkPointFrontLensWidget::FollowMouse()
{
  const int* const at = this->Interactor->GetEventPosition();
  vtkRenderer* const renderer = this->Interactor->FindPokedRenderer(at[0], at[1]);
  const int* const corner = renderer ? renderer->GetOrigin() : nullptr;
  const double x = at[0] - (corner ? corner[0] : 0);
  const double y = at[1] - (corner ? corner[1] : 0);
  if (x != this->Style->GetLensCenterX(this->Lens) || y != this->Style->GetLensCenterY(this->Lens))
  {
    this->Style->SetLensCenter(this->Lens, x, y);
    this->Show();
  }
}

void vtkPointFrontLensWidget::Resize(double factor)
{
  const double radius = this->Style->GetLensRadius(this->Lens);
  if (radius > 0.0)
  {
    const double most = std::max(this->MinimumRadius, this->MaximumRadius);
    this->Style->SetLensRadius(this->Lens, std::clamp(factor * radius, this->MinimumRadius, most));
    this->Show();
  }
}

void vtkPointFrontLensWidget::Show()
{
  this->InvokeEvent(vtkCommand::InteractionEvent, nullptr);
  this->Interactor->Render();
}

void vtkPointFrontLensWidget::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Style: " << this->Style.GetPointer() << "\n";
  os << indent << "Lens: " << this->Lens << "\n";
  os << indent << "MinimumRadius: " << this->MinimumRadius << "\n";
  os << indent << "MaximumRadius: " << this->MaximumRadius << "\n";
}
