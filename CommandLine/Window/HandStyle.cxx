#include "HandStyle.h"

#include "CameraMotion.h"
#include "ViewCamera.h"

#include <vtkObjectFactory.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkStringArray.h>

#include <glm/common.hpp>
#include <glm/gtc/constants.hpp>

#include <cmath>
#include <string>

namespace pointfront
{

namespace
{
constexpr double wheelStep = 1.2; // factor of the distance
constexpr int stillPx = 3; // a hand that clicks moves the mouse that far
} // namespace

vtkStandardNewMacro(HandStyle);

void HandStyle::connect(ViewCamera* camera, HandTarget* target)
{
  camera_ = camera;
  target_ = target;
}

glm::ivec2 HandStyle::mouse() const
{
  const int* const at = this->Interactor->GetEventPosition();
  return { at[0], at[1] };
}

void HandStyle::press(void (HandStyle::*start)())
{
  if (this->State != VTKIS_NONE)
  {
    return; // another button is down
  }
  pressed_ = last_ = this->mouse();
  anchor_ = camera_->anchorAt(pressed_);
  dragged_ = false;
  (this->*start)();
}

void HandStyle::release()
{
  if (this->State != VTKIS_NONE)
  {
    this->StopState(); // which renders the view at rest
  }
}

void HandStyle::OnLeftButtonDown()
{
  this->press(this->Interactor->GetShiftKey() ? &HandStyle::StartPan : &HandStyle::StartRotate);
}

void HandStyle::OnLeftButtonUp()
{
  const bool click = this->State != VTKIS_NONE && !dragged_;
  this->release();
  if (click)
  {
    target_->click(pressed_);
  }
}

void HandStyle::OnMiddleButtonDown()
{
  this->press(&HandStyle::StartPan);
}

void HandStyle::OnRightButtonDown()
{
  this->press(&HandStyle::StartSpin);
}

void HandStyle::OnMouseMove()
{
  const glm::ivec2 now = this->mouse();
  const glm::dvec2 by(now - last_);
  const glm::ivec2 whole = glm::abs(now - pressed_);
  dragged_ = dragged_ || glm::max(whole.x, whole.y) > stillPx;
  if (this->State == VTKIS_NONE || !dragged_)
  {
    return;
  }
  last_ = now;
  const Camera& camera = camera_->camera();
  const double halfTurn = glm::pi<double>() / camera_->size().y; // for the height of the window
  const glm::dvec2 angles = halfTurn * by;
  switch (this->State)
  {
    case VTKIS_ROTATE:
      camera_->set(orbited(camera, anchor_, -angles.x, -angles.y));
      break;
    case VTKIS_PAN:
      camera_->set(panned(camera, anchor_, by, camera_->size().y));
      break;
    default: // the head turns a third as fast: what is seen moves across the whole picture
      camera_->set(turned(camera, -angles.x / 3.0, angles.y / 3.0));
  }
  this->Interactor->Render();
}

void HandStyle::wheel(double steps)
{
  camera_->zoom(camera_->anchorAt(this->mouse()), std::pow(wheelStep, steps));
  target_->step();
}

void HandStyle::OnKeyPress()
{
  const char* const keysym = this->Interactor->GetKeySym();
  if (keysym == nullptr || target_->hold(keysym, true))
  {
    return;
  }
  // VTK 9.2 names a key as if Shift was not held.
  std::string typed = keysym;
  if (typed.size() == 1 && typed[0] >= 'a' && typed[0] <= 'z' && this->Interactor->GetShiftKey())
  {
    typed[0] = static_cast<char>(typed[0] - 'a' + 'A');
  }
  if (const KeyAction action = keyActionOf(typed); action != KeyAction::None)
  {
    target_->obey(action, this->mouse());
  }
}

void HandStyle::OnKeyRelease()
{
  if (const char* const keysym = this->Interactor->GetKeySym())
  {
    target_->hold(keysym, false);
  }
}

void HandStyle::OnConfigure()
{
  this->Interactor->Render();
}

void HandStyle::OnDropFiles(vtkStringArray* files)
{
  std::vector<std::string> names;
  for (vtkIdType i = 0; files != nullptr && i < files->GetNumberOfValues(); ++i)
  {
    names.push_back(files->GetValue(i));
  }
  if (!names.empty())
  {
    target_->drop(names);
  }
}

} // namespace pointfront
