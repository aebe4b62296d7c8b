#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pointfront
{

/// One lane for all reads from disks: at most one is under way at a time, since several at once are
/// slower in total (Futterlieb, Teutsch & Berndt 2016, section 3.3: SMOOTH-8).
/// Overdue   a read that takes longer than `overdueAfter` (a disk that hangs, spins up or is gone)
///           holds up nobody else: the lane is free again for other stores. A store with an overdue
///           read gets no second one; a disk with two gets no third from any store. So a disk that
///           is gone costs two threads, whatever the number of stores on it.
/// Threads   none of its own: the owner locks.
class DiskLane
{
public:
  using Clock = std::chrono::steady_clock;
  using Ticket = std::uint64_t;

  explicit DiskLane(Clock::duration overdueAfter)
    : overdueAfter_(overdueAfter)
  {
  }

  /// `store`: any pointer that identifies the store.
  Ticket enter(const void* store, std::uint64_t disk, Clock::time_point now);
  void leave(Ticket ticket);

  /// Whether a read is under way that is not overdue.
  bool busy(Clock::time_point now) const;
  /// Whether this store must not read now although the lane is free.
  bool barred(const void* store, std::uint64_t disk, Clock::time_point now) const;
  /// When the read under way becomes overdue; none when the lane is free.
  std::optional<Clock::time_point> freeAt(Clock::time_point now) const;
  std::size_t overdue(Clock::time_point now) const;
  bool overdue(const void* store, Clock::time_point now) const;

  static constexpr std::size_t overdueOnADisk = 2;

private:
  struct Read
  {
    Ticket ticket;
    const void* store;
    std::uint64_t disk;
    Clock::time_point since;
  };
  bool late(const Read& read, Clock::time_point now) const
  {
    return now - read.since >= overdueAfter_;
  }

  const Clock::duration overdueAfter_;
  std::vector<Read> reads_;
  Ticket next_ = 0;
};

} // namespace pointfront
