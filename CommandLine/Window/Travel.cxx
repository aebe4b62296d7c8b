#include "Travel.h"

#include "ViewCamera.h"

#include <vtkRenderWindow.h>

#include <algorithm>

namespace pointfront
{

namespace
{
constexpr double stillRate = 0.0001; // frames a second: VTK's value for a view at rest
constexpr double interactiveRate = 15.0; // VTK's value for a view in motion
constexpr std::chrono::milliseconds rest{ 250 }; // after a step the camera is at rest
constexpr double longestStep = 0.2; // seconds: who waited for a slow frame is not carried far away
} // namespace

Travel::Travel(vtkRenderWindow* window, ViewCamera& camera)
  : window_(window)
  , camera_(camera)
{
  window_->SetDesiredUpdateRate(stillRate);
}

void Travel::step()
{
  window_->SetDesiredUpdateRate(interactiveRate);
  restDue_ = Clock::now() + rest;
}

bool Travel::hold(std::string_view keysym, bool down)
{
  const bool before = flight_.flying();
  const bool mine = flight_.hold(keysym, down);
  if (flight_.flying() && !before)
  {
    flown_ = Clock::now();
  }
  return mine;
}

bool Travel::advance()
{
  const Clock::time_point now = Clock::now();
  if (flight_.flying())
  {
    const std::chrono::duration<double> passed = now - flown_;
    flown_ = now;
    camera_.set(flight_.moved(camera_.camera(), std::min(passed.count(), longestStep)));
    step();
    return true;
  }
  if (restDue_ && now >= *restDue_)
  {
    restDue_.reset();
    window_->SetDesiredUpdateRate(stillRate);
    return true;
  }
  return false;
}

} // namespace pointfront
