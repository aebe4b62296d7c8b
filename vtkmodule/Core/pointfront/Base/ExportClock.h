#pragma once

#include "pointfront/Base/Progress.h"

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace pointfront
{

/// Sends the progress of points on their way out, some ten reports a second. One thread.
class ExportClock
{
public:
  /// `function` must outlive this object; `total` in points.
  ExportClock(
    const ProgressFunction& function, std::uint64_t total, const char* phase = "exporting")
    : function_(function)
  {
    progress_.phase = phase;
    progress_.total = total;
  }

  /// `done` points are handled. False to cancel.
  bool report(std::uint64_t done)
  {
    using Seconds = std::chrono::duration<double>;
    const double now = Seconds(std::chrono::steady_clock::now() - begin_).count();
    if (!function_ || now - progress_.secondsElapsed < 0.1)
    {
      return true;
    }
    progress_.secondsElapsed = now;
    progress_.done = done;
    progress_.fraction =
      static_cast<double>(done) / static_cast<double>(std::max<std::uint64_t>(progress_.total, 1));
    return function_(progress_);
  }

private:
  const ProgressFunction& function_;
  Progress progress_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

} // namespace pointfront
