#include "pointfront/Front/ThresholdLadder.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace pointfront
{
namespace
{

constexpr double rungsPerOctave = 64.0;
constexpr double farPx = 1e31;

} // namespace

ThresholdLadder::ThresholdLadder(double targetPx, double initialPx)
  : target_(targetPx)
  , initial_(std::max(initialPx, targetPx))
{
  assert(targetPx > 0.0);
  const double octaves = std::log2(initial_ / target_);
  initialRung_ = static_cast<int>(std::ceil(octaves * rungsPerOctave));
  if (initialRung_ > 0)
  {
    octavesPerRung_ = octaves / initialRung_;
  }
}

double ThresholdLadder::at(int rung) const
{
  return rung == initialRung_ ? initial_ : target_ * std::exp2(rung * octavesPerRung_);
}

int ThresholdLadder::rungFor(double px) const
{
  if (!(px > target_))
  {
    return 0;
  }
  const double rungs = std::log2(std::min(px, farPx) / target_) / octavesPerRung_;
  // A threshold that came from this ladder finds its own rung again.
  return static_cast<int>(std::ceil(rungs - 1e-6));
}

int ThresholdLadder::highest() const
{
  return rungFor(farPx);
}

} // namespace pointfront
