#include "pointfront/Residency/DiskLane.h"

#include <algorithm>
#include <cassert>

namespace pointfront
{

DiskLane::Ticket DiskLane::enter(const void* store, std::uint64_t disk, Clock::time_point now)
{
  assert(!busy(now) && !barred(store, disk, now));
  reads_.push_back({ next_, store, disk, now });
  return next_++;
}

void DiskLane::leave(Ticket ticket)
{
  const auto read =
    std::find_if(reads_.begin(), reads_.end(), [=](const Read& r) { return r.ticket == ticket; });
  assert(read != reads_.end());
  reads_.erase(read);
}

bool DiskLane::busy(Clock::time_point now) const
{
  return freeAt(now).has_value();
}

bool DiskLane::barred(const void* store, std::uint64_t disk, Clock::time_point now) const
{
  std::size_t onDisk = 0;
  for (const Read& read : reads_)
  {
    if (late(read, now))
    {
      onDisk += read.disk == disk ? 1 : 0;
      if (read.store == store || onDisk >= overdueOnADisk)
      {
        return true;
      }
    }
  }
  return false;
}

std::optional<DiskLane::Clock::time_point> DiskLane::freeAt(Clock::time_point now) const
{
  for (const Read& read : reads_)
  {
    if (!late(read, now))
    {
      return read.since + overdueAfter_; // there is only one
    }
  }
  return std::nullopt;
}

std::size_t DiskLane::overdue(Clock::time_point now) const
{
  return static_cast<std::size_t>(
    std::count_if(reads_.begin(), reads_.end(), [&](const Read& read) { return late(read, now); }));
}

bool DiskLane::overdue(const void* store, Clock::time_point now) const
{
  return std::any_of(reads_.begin(), reads_.end(),
    [&](const Read& read) { return read.store == store && late(read, now); });
}

} // namespace pointfront
