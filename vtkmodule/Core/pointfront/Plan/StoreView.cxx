#include "pointfront/Plan/StoreView.h"

#include <utility>

namespace pointfront
{
namespace
{
/// A view that is being loaded rests this many frame times before its next frame.
constexpr double pauseOfFrames = 3.0;
} // namespace

void StoreView::open(std::unique_ptr<ViewFront> front)
{
  front_ = std::move(front);
  growth_.reset(); // in another store the same number means another node
  due_ = true;
}

const FrontDelta& StoreView::update(FrameRequest request)
{
  request_ = std::move(request);
  return front_->update(request_);
}

FramePlan StoreView::plan(const StoreDescription& description, PlanRequest request)
{
  request.keepsVisible = leavesOut(front_->last(), request_);
  request.growth = &growth_;
  request.moment.moving = request_.interacting;
  request.moment.duration = request_.complete ? 0.0 : request.moment.duration;
  FramePlan plan = planFrame(*front_, description, std::move(request));
  front_->fills(plan.fillPx(), double(plan.camera.width) * double(plan.camera.height));
  return plan;
}

void StoreView::drew(std::uint64_t keptPoints, Clock::time_point now)
{
  front_->drewBeside(keptPoints);
  drawnAt_ = now;
  ahead_ = false;
  due_ = false;
}

void StoreView::took(std::uint64_t points, std::uint32_t moves, double milliseconds)
{
  front_->recordFrame(points, moves, milliseconds);
  frameMs_ = milliseconds;
}

bool StoreView::needsFrame(bool begun, Clock::time_point now)
{
  if (due_)
  {
    return true;
  }
  const std::chrono::duration<double, std::milli> passed = now - drawnAt_;
  const bool pauses = !begun && !request_.interacting && !request_.complete &&
    passed.count() < pauseOfFrames * frameMs_;
  if (pauses && front_->wantsUpdate())
  {
    front_->update(request_);
    ahead_ = true;
  }
  due_ = hasNews() && !(pauses && front_->expectsMore());
  return due_;
}

} // namespace pointfront
