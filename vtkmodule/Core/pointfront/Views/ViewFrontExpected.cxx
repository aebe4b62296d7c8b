// The nodes that a view at rest draws when it is complete.

#include "pointfront/Views/ViewFront.h"

namespace pointfront
{

/// Where a budget keeps the threshold up it stays where it is, and falls to its target elsewhere.
void ViewFront::expect(const FrameRequest& request)
{
  const bool rests = !request.interacting && !request.complete;
  const bool byView = method_ == DetailMethod::ViewSpecific;
  if (!rests || others_)
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
    expected_ = std::make_unique<ExpectedNodes>(piece_->hierarchy(),
      byView ? WholeFront::Selection::ViewSpecific : WholeFront::Selection::RenderingFront);
  }
  const bool limited =
    !byView && (delta_.limitedByBudget || delta_.limitedByGpu || delta_.limitedByMemory);
  expected_->update(request.view, limits_, limited ? delta_.thresholdPx : request.targetErrorPx);
}

} // namespace pointfront
