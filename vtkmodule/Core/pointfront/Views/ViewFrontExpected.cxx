// The nodes that a view at rest draws when it is complete.

#include "pointfront/Views/ViewFront.h"

namespace pointfront
{

/// Where a budget keeps the threshold up it stays where it is, and falls to its target elsewhere.
void ViewFront::expect(const FrameRequest& demand)
{
  const bool rests = !demand.interacting && !demand.complete;
  if (!rests || others_ || method_ != DetailMethod::RenderingFront)
  {
    expected_.reset();
    return;
  }
  if (delta_.complete)
  {
    expected_ ? expected_->finish() : void();
    return;
  }
  if (!expected_)
  {
    expected_ = std::make_unique<ExpectedNodes>(piece_->hierarchy());
  }
  const bool limited = delta_.limitedByBudget || delta_.limitedByGpu || delta_.limitedByMemory;
  expected_->update(demand.view, limits_, limited ? delta_.thresholdPx : demand.targetErrorPx);
}

} // namespace pointfront
