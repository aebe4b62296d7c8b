#include "pointfront/Residency/MemoryBudget.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace pointfront
{

MemoryBudget::MemoryBudget(std::size_t limitBytes, std::shared_ptr<MemoryBudget> whole)
  : whole_(std::move(whole))
  , limit_(limitBytes)
{
}

std::size_t MemoryBudget::limit() const
{
  const std::size_t own = limit_;
  return whole_ ? std::min(own, whole_->limit()) : own;
}

bool MemoryBudget::fits(std::size_t bytes, std::size_t returned) const
{
  const std::size_t limit = limit_;
  const std::size_t used = used_;
  const std::size_t left = used - std::min(used, returned);
  return left <= limit && bytes <= limit - left && (!whole_ || whole_->fits(bytes, returned));
}

bool MemoryBudget::reserve(std::size_t bytes)
{
  if (whole_ && !whole_->reserve(bytes))
  {
    return false;
  }
  std::size_t used = used_;
  do
  {
    const std::size_t limit = limit_;
    if (used > limit || bytes > limit - used)
    {
      if (whole_)
      {
        whole_->giveBack(bytes);
      }
      return false;
    }
  } while (!used_.compare_exchange_weak(used, used + bytes));
  std::size_t most = usedMax_;
  while (most < used + bytes && !usedMax_.compare_exchange_weak(most, used + bytes))
  {
  }
  return true;
}

void MemoryBudget::giveBack(std::size_t bytes)
{
  const std::size_t before = used_.fetch_sub(bytes);
  assert(before >= bytes);
  static_cast<void>(before);
  if (whole_)
  {
    whole_->giveBack(bytes);
    return;
  }
  announceChange();
}

void MemoryBudget::setLimit(std::size_t bytes)
{
  limit_ = bytes;
  announceChange();
}

std::uint64_t MemoryBudget::changes() const
{
  if (whole_)
  {
    return whole_->changes();
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  return changes_;
}

void MemoryBudget::announceChange()
{
  if (whole_)
  {
    whole_->announceChange();
    return;
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++changes_;
  }
  changed_.notify_all();
}

void MemoryBudget::waitForChange(std::uint64_t seen) const
{
  if (whole_)
  {
    whole_->waitForChange(seen);
    return;
  }
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [&] { return changes_ != seen; });
}

void MemoryBudget::waitForChange(
  std::uint64_t seen, std::chrono::steady_clock::time_point end) const
{
  if (whole_)
  {
    whole_->waitForChange(seen, end);
    return;
  }
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_until(lock, end, [&] { return changes_ != seen; });
}

} // namespace pointfront
