#include "BuildThread.h"

#include "pointfront/Threads/WorkerThread.h"

#include <chrono>
#include <new>
#include <utility>

namespace pointfront
{

bool BuildThread::report(const Progress& progress)
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    news_.progress = progress;
  }
  changed_.notify_one();
  return !cancelled_;
}

Result<BuildReport> BuildThread::build(BuildOrder order)
{
  order.preview.shown = [this](const std::string&)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    news_.preview = true;
  };
  return carryOut(order, [this](const Progress& state) { return report(state); });
}

Result<BuildReport> BuildThread::run(const BuildOrder& order, const Watch& watch)
{
  const auto work = [&]
  {
    Result<BuildReport> done = makeError(Error::Kind::NoMemory,
      "the system gave no more memory to the build; use a lower memory limit");
    try
    {
      done = build(order);
    }
    catch (const std::bad_alloc&)
    {
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    outcome_ = std::move(done);
    changed_.notify_one();
  };
  WorkerThread worker;
  if (!worker.start(work))
  {
    work(); // the system gives no thread: nobody watches
  }
  constexpr std::chrono::milliseconds betweenLooks{ 100 }; // an abort is seen without news too
  std::unique_lock<std::mutex> lock(mutex_);
  while (!outcome_)
  {
    changed_.wait_for(lock, betweenLooks);
    const News last = news_;
    news_.preview = false;
    lock.unlock();
    if (!cancelled_ && !watch(last))
    {
      cancelled_ = true;
    }
    lock.lock();
  }
  lock.unlock();
  worker.join();
  return std::move(*outcome_);
}

} // namespace pointfront
