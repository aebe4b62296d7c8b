#include "pointfront/Residency/MemoryBudget.h"

#include <cassert>

namespace pointfront
{

MemoryBudget::MemoryBudget(std::size_t limitBytes)
  : limit_(limitBytes)
{
}

bool MemoryBudget::fits(std::size_t bytes) const
{
  const std::size_t limit = limit_;
  const std::size_t used = used_;
  return used <= limit && bytes <= limit - used;
}

bool MemoryBudget::reserve(std::size_t bytes)
{
  std::size_t used = used_;
  do
  {
    const std::size_t limit = limit_;
    if (used > limit || bytes > limit - used)
    {
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
  announceChange();
}

void MemoryBudget::setLimit(std::size_t bytes)
{
  limit_ = bytes;
  announceChange();
}

std::uint64_t MemoryBudget::changes() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return changes_;
}

void MemoryBudget::announceChange()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++changes_;
  }
  changed_.notify_all();
}

void MemoryBudget::waitForChange(std::uint64_t seen) const
{
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [&] { return changes_ != seen; });
}

} // namespace pointfront
