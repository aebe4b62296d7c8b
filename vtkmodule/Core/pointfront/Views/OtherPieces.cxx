#include "pointfront/Views/OtherPieces.h"

#include <utility>

namespace pointfront
{

OtherPieces::OtherPieces(std::shared_ptr<const HierarchyPiece> piece)
  : piece_(std::move(piece))
  , front_(piece_->whole())
{
}

OtherPieces::~OtherPieces() = default;

void OtherPieces::update(const View& view, const FrontLimits& limits, double thresholdPx,
  const std::function<bool()>& waits)
{
  const FrontDelta& delta = front_.update(view, limits, thresholdPx, waits);
  if (delta.number != seen_)
  {
    seen_ = delta.number;
    drawn_ = front_.drawn([this](NodeIndex node) { return !piece_->has(node); });
  }
}

} // namespace pointfront
