// The nodes that a view loads ahead: ViewFront::addMargin().

#include "pointfront/Views/ViewFront.h"

#include <algorithm>

namespace pointfront
{
namespace
{

/// Frames that a moving view is looked ahead: about what a disk and a decoder take, and half a
/// second at the rates of interactors.
constexpr double framesAhead = 8.0;
/// Share of the viewport's width and height that a view at rest has in memory beyond each of its
/// sides: so far a hand moves it in the first eight frames.
constexpr double marginAtRest = 0.125;
/// Walks of one view: each goes on where rows of the table were missing.
constexpr std::uint32_t mostMarginWalks = 16;

} // namespace

/// Behind all that the view needs itself: what it will need if it goes on as it moves, and of a
/// view that rests and is complete what lies around it. Still pictures have no next frame.
void ViewFront::addMargin(const FrameRequest& request)
{
  const auto asked = static_cast<std::uint32_t>(delta_.requests.size());
  const std::uint32_t most = mostRequests - std::min(mostRequests, asked);
  if (!request.interacting && (!delta_.complete || request.complete))
  {
    margin_.rest(request.view);
    return;
  }
  marginWalks_ += request.interacting ? 0 : 1;
  const std::vector<LoadRequest>& margin = request.interacting
    ? margin_.ahead(
        request.view, delta_.thresholdPx, share_.residency(), framesAhead, most, request.layers)
    : margin_.around(
        request.view, delta_.thresholdPx, share_.residency(), marginAtRest, most, request.layers);
  delta_.requests.insert(delta_.requests.end(), margin.begin(), margin.end());
}

/// Rows of the table came that the margin of a view at rest has missed.
bool ViewFront::marginGoesOn() const
{
  const MissingRows* const rows = piece_->hierarchy()->missingRows();
  return margin_.rowsComing() && marginWalks_ < mostMarginWalks && rows != nullptr &&
    !rows->waiting();
}

} // namespace pointfront
