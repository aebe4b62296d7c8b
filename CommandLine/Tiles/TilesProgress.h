#pragma once

#include "pointfront/Base/Progress.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <utility>

namespace pointfront
{

/// The progress of many operations, one after the other, as that of one. Work that is done already
/// when it begins is not part of it, so that the estimate is of what is left.
/// Threads  as ProgressFunction.
class TilesProgress
{
public:
  explicit TilesProgress(ProgressFunction shown)
    : shown_(std::move(shown))
    , begin_(std::chrono::steady_clock::now())
  {
  }

  /// Work in any unit, of all parts.
  void setTotal(double work) { total_ = work; }
  /// From here on what is left is of the tiles, of so many points.
  void beginTiles(double points)
  {
    base_ = fraction_;
    total_ = points;
    done_ = 0.0;
    work_ = 0.0;
  }
  /// The next part, of so much work; with some stages, whose fractions each go from 0 to 1.
  ProgressFunction part(std::string name, double work, unsigned stages)
  {
    done_ += work_;
    name_ = std::move(name);
    work_ = work;
    stages_ = stages;
    stage_ = 0;
    before_ = 0.0;
    return [this](const Progress& progress) { return show(progress); };
  }

private:
  bool show(Progress progress)
  {
    if (progress.fraction < before_ - 0.5)
    {
      stage_ = std::min(stage_ + 1, stages_ - 1);
    }
    before_ = progress.fraction;
    const std::string phase = name_ + ": " + progress.phase;
    if (phase != phase_)
    {
      phase_ = phase;
    }
    const double part = std::min(1.0, (stage_ + progress.fraction) / stages_);
    const double all = total_ > 0.0 ? (done_ + work_ * part) / total_ : 0.0;
    fraction_ = std::max(fraction_, std::min(1.0, base_ + (1.0 - base_) * all));
    progress.fraction = fraction_;
    progress.phase = phase_.c_str();
    const auto now = std::chrono::steady_clock::now();
    progress.secondsElapsed = std::chrono::duration<double>(now - begin_).count();
    return !shown_ || shown_(progress);
  }

  ProgressFunction shown_;
  std::chrono::steady_clock::time_point begin_;
  std::string name_;
  std::string phase_;
  double total_ = 0.0;
  double done_ = 0.0;
  double work_ = 0.0;
  double before_ = 0.0;
  double fraction_ = 0.0;
  double base_ = 0.0; ///< fraction before the tiles
  unsigned stages_ = 1;
  unsigned stage_ = 0;
};

} // namespace pointfront
