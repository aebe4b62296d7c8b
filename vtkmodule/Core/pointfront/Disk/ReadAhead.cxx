#include "pointfront/Disk/ReadAhead.h"

#include "pointfront/Base/CpuClock.h"

#include <new>

namespace pointfront
{
namespace
{
Error noMemory()
{
  return makeError(Error::Kind::NoMemory,
    "the system gave no more memory to the build; use a lower memory limit or fewer threads");
}
} // namespace

ReadAhead::ReadAhead(std::vector<std::uint32_t> order, Load load, const ReadAheadPlan& plan)
  : order_(std::move(order))
  , load_(std::move(load))
  , parts_(plan.parts)
{
  // Without any thread, parts are read when they are taken.
  for (unsigned i = 0; parts_ > 0 && i < plan.threads; ++i)
  {
    if (!threads_.emplace_back().start([this] { work(); }))
    {
      threads_.pop_back();
      return;
    }
  }
}

ReadAhead::~ReadAhead()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    over_ = true;
  }
  wanted_.notify_all();
  threads_.clear();
}

ReadAhead::Records ReadAhead::take(std::uint32_t part)
{
  if (threads_.empty())
  {
    return loaded(part);
  }
  std::unique_lock<std::mutex> lock(mutex_);
  ++taken_;
  wanted_.notify_one();
  auto found = held_.find(part);
  while (found == held_.end())
  {
    if (noMemory_)
    {
      return noMemory();
    }
    ready_.wait(lock);
    found = held_.find(part);
  }
  Records records = std::move(found->second);
  held_.erase(found);
  return records;
}

double ReadAhead::seconds() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return seconds_;
}

void ReadAhead::work()
{
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;)
  {
    // Those being taken are not held any more, or are what is waited for.
    wanted_.wait(
      lock, [this] { return over_ || next_ == order_.size() || next_ < taken_ + parts_; });
    if (over_ || next_ == order_.size())
    {
      return;
    }
    const std::uint32_t part = order_[next_++];
    lock.unlock();
    Records records = loaded(part);
    lock.lock();
    try
    {
      held_.emplace(part, std::move(records));
    }
    catch (const std::bad_alloc&)
    {
      noMemory_ = true; // who takes parts is told, and does not wait for this one
    }
    ready_.notify_all();
  }
}

ReadAhead::Records ReadAhead::loaded(std::uint32_t part)
{
  double seconds = 0.0;
  Records records = [&]() -> Records
  {
    const CpuStopwatch watch(seconds);
    try
    {
      return load_(part);
    }
    catch (const std::bad_alloc&)
    {
      return noMemory();
    }
  }();
  const std::lock_guard<std::mutex> lock(mutex_);
  seconds_ += seconds;
  return records;
}

} // namespace pointfront
