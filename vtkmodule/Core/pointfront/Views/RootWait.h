#pragma once

#include <algorithm>
#include <chrono>

namespace pointfront
{

/// How long the first frame of a cloud may wait for its roots. A disk that hangs must not hold up
/// the other clouds of a window: each new cloud may wait for half of what is left of a second, and
/// what was waited comes back at a tenth of the time that passes.
/// Threads   one thread, that which draws.
class RootWait
{
public:
  using Clock = std::chrono::steady_clock;

  std::chrono::milliseconds allowance(Clock::time_point now) const
  {
    return std::chrono::duration_cast<std::chrono::milliseconds>(left(now) / 2);
  }
  void spend(Clock::time_point begin, Clock::time_point end)
  {
    const Clock::duration before = left(begin);
    left_ = std::max(Clock::duration(0), before - (end - begin));
    since_ = end;
  }

private:
  static constexpr std::chrono::seconds whole{ 1 };
  static constexpr int slowness = 10;

  Clock::duration left(Clock::time_point now) const
  {
    return std::min<Clock::duration>(whole, left_ + (now - since_) / slowness);
  }

  Clock::duration left_ = whole;
  Clock::time_point since_ = Clock::now();
};

} // namespace pointfront
