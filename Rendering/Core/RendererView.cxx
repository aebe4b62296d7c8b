#include "RendererView.h"

namespace pointfront
{
namespace
{

/// From one drawing to the next, in times of a drawing.
constexpr double pauseOfDrawings = 3.0;

} // namespace

RendererView::~RendererView()
{
  if (this->Renderer)
  {
    this->Renderer->RemoveObserver(this->StartTag);
  }
}

bool RendererView::NeedsRender()
{
  if (!this->Front || this->UploadsLeft || this->Due)
  {
    return true;
  }
  const std::chrono::duration<double, std::milli> passed = Clock::now() - this->DrawnAt;
  const bool paused = !this->NewFrame && !this->Demand.interacting && !this->Demand.complete &&
                      passed.count() < pauseOfDrawings * this->DrawingMs;
  if (paused && this->Front->wantsUpdate())
  {
    this->Front->update(this->Demand);
    this->Ahead = true;
  }
  this->Due =
    (this->Ahead || this->Front->wantsUpdate()) && !(paused && this->Front->expectsMore());
  return this->Due;
}

} // namespace pointfront
