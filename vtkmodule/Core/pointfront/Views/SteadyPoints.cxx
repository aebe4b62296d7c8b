#include "pointfront/Views/SteadyPoints.h"

#include <algorithm>

namespace pointfront
{

std::uint64_t SteadyPoints::next(std::uint64_t affordable, bool still)
{
  frames_ = still ? frames_ : 0;
  if (frames_ >= learningFrames)
  {
    return follow(affordable);
  }
  answers_[frames_ % answers_.size()] = affordable;
  points_ = affordable;
  if (++frames_ == learningFrames)
  {
    auto sorted = answers_;
    const auto middle = sorted.begin() + sorted.size() / 2;
    std::nth_element(sorted.begin(), middle, sorted.end());
    points_ = *middle;
    more_ = fewer_ = 0;
  }
  return points_;
}

std::uint64_t SteadyPoints::follow(std::uint64_t affordable)
{
  more_ = affordable >= 2 * points_ ? more_ + 1 : 0;
  fewer_ = 2 * affordable <= points_ ? fewer_ + 1 : 0;
  const int inRow = std::max(more_, fewer_);
  if (inRow == 1)
  {
    leastChanged_ = affordable;
  }
  else if (inRow > 1)
  {
    leastChanged_ =
      more_ > 0 ? std::min(leastChanged_, affordable) : std::max(leastChanged_, affordable);
  }
  if (inRow >= changedFrames)
  {
    points_ = leastChanged_;
    more_ = fewer_ = 0;
  }
  return points_;
}

} // namespace pointfront
