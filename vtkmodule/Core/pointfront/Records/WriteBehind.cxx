#include "pointfront/Records/WriteBehind.h"

#include "pointfront/Base/CpuClock.h"

#include <algorithm>
#include <new>

namespace pointfront
{

WriteBehind::WriteBehind(RecordPool& pool, std::size_t buffers)
  : pool_(pool)
  , idle_(buffers)
{
  // Without a thread of its own who hands over writes.
  static_cast<void>(thread_.start([this] { work(); }));
}

WriteBehind::~WriteBehind()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    over_ = true;
  }
  handed_.notify_all();
  thread_.join();
}

Result<WriteBehind::Buffer> WriteBehind::buffer(std::size_t bytes)
{
  Buffer buffer;
  {
    std::unique_lock<std::mutex> lock(mutex_);
    written_.wait(lock, [this] { return !idle_.empty() || error_; });
    if (error_)
    {
      return *error_;
    }
    buffer = std::move(idle_.back());
    idle_.pop_back();
  }
  buffer.resize(std::max(buffer.size(), bytes));
  return buffer;
}

void WriteBehind::write(std::uint64_t first, std::uint64_t count, Buffer records)
{
  std::unique_lock<std::mutex> lock(mutex_);
  blocks_.push_back({ first, count, std::move(records) });
  ++underWay_;
  if (thread_.started())
  {
    handed_.notify_one();
    return;
  }
  writeNext(lock);
}

Result<void> WriteBehind::finish()
{
  std::unique_lock<std::mutex> lock(mutex_);
  written_.wait(lock, [this] { return underWay_ == 0; });
  return outcome();
}

double WriteBehind::seconds() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return seconds_;
}

Result<void> WriteBehind::outcome() const
{
  return error_ ? Result<void>(*error_) : Result<void>();
}

void WriteBehind::work()
{
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;)
  {
    handed_.wait(lock, [this] { return over_ || !blocks_.empty(); });
    if (blocks_.empty())
    {
      return;
    }
    writeNext(lock);
  }
}

/// The lock is given up while the disk works.
void WriteBehind::writeNext(std::unique_lock<std::mutex>& lock)
{
  Block block = std::move(blocks_.front());
  blocks_.pop_front();
  Result<void> done = outcome();
  lock.unlock();
  double seconds = 0.0;
  if (done)
  {
    const CpuStopwatch watch(seconds);
    try
    {
      done = pool_.write(block.first, block.count, block.records.data());
    }
    catch (const std::bad_alloc&)
    {
      done = makeError(Error::Kind::NoMemory, "the system gave no more memory to the build");
    }
  }
  lock.lock();
  seconds_ += seconds;
  if (!done && !error_)
  {
    error_ = done.error();
  }
  idle_.push_back(std::move(block.records));
  --underWay_;
  written_.notify_all();
}

} // namespace pointfront
