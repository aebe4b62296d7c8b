#pragma once

#include <chrono>
#include <cstdint>

namespace pointfront
{

/// Tells how long a read may go on: without end while bytes come, and no longer than a time `limit`
/// in which fewer bytes a second came than a usable line has. So a large read over a slow line
/// ends well, and a server that sends a byte a minute holds nobody.
/// Threads  one.
class ReadPatience
{
public:
  using Clock = std::chrono::steady_clock;

  /// The mean over a `limit` below which nobody waits on: 1/120 of a line of 1 Mbit/s.
  static constexpr double leastBytesPerSecond = 1024.0;

  ReadPatience(std::chrono::milliseconds limit, Clock::time_point now)
    : limit_(limit)
    , least_(leastBytesPerSecond * std::chrono::duration<double>(limit).count())
    , since_(now)
  {
  }
  /// `sum` bytes have come so far.
  void note(std::uint64_t sum, Clock::time_point now)
  {
    bytes_ = sum;
    if (static_cast<double>(sum - counted_) >= least_)
    {
      restart(sum, now);
    }
  }
  void restart(std::uint64_t sum, Clock::time_point now)
  {
    bytes_ = counted_ = sum;
    since_ = now;
  }
  /// A time that does not count: the read waited for others.
  void extend(Clock::duration time) { since_ += time; }
  std::uint64_t bytes() const { return bytes_; }
  Clock::time_point deadline() const { return since_ + limit_; }
  bool over(Clock::time_point now) const { return now >= deadline(); }
  std::chrono::milliseconds limit() const { return limit_; }

private:
  std::chrono::milliseconds limit_;
  double least_;
  Clock::time_point since_;
  std::uint64_t bytes_ = 0;
  std::uint64_t counted_ = 0; ///< bytes at since_
};

} // namespace pointfront
