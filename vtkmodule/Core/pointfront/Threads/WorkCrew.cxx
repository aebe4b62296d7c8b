#include "pointfront/Threads/WorkCrew.h"

#include "pointfront/Threads/ThreadCrew.h"

#include <algorithm>
#include <new>

namespace pointfront
{
namespace
{
constexpr double secondsBetweenReports = 0.1;
} // namespace

WorkCrew::WorkCrew(unsigned threads, ProgressFunction progress)
  : threads_(threads)
  , progress_(std::move(progress))
  , start_(std::chrono::steady_clock::now())
{
}

Result<void> WorkCrew::run(const std::function<Result<void>()>& work)
{
  const auto guarded = [&]
  {
    try
    {
      if (const Result<void> done = work(); !done)
      {
        fail(done.error());
      }
    }
    catch (const std::bad_alloc&)
    {
      fail(makeError(Error::Kind::NoMemory,
        "the system gave no more memory to the build; use a lower memory limit or fewer threads"));
    }
  };
  ThreadCrew crew(threads_);
  crew.run(crew.threads(), [&](std::size_t, unsigned) { guarded(); });
  return outcome();
}

void WorkCrew::fail(const Error& error)
{
  stop_ = true; // first: what follows may need memory
  const std::lock_guard<std::mutex> lock(errorMutex_);
  if (!error_)
  {
    error_ = error;
  }
}

Result<void> WorkCrew::outcome() const
{
  const std::lock_guard<std::mutex> lock(errorMutex_);
  if (error_)
  {
    return *error_;
  }
  return {};
}

double WorkCrew::secondsElapsed() const
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void WorkCrew::beginPhase(const char* name, std::uint64_t total, double weight)
{
  {
    const std::lock_guard<std::mutex> lock(reportMutex_);
    phase_ = name;
    total_ = total;
    fractionBefore_ = std::min(1.0, fractionBefore_ + weight_);
    weight_ = weight;
    done_ = 0;
  }
  report(true);
}

void WorkCrew::tell(const std::string& notice)
{
  report(true, notice);
}

void WorkCrew::advance(std::uint64_t points)
{
  done_ += points;
  report(false);
}

void WorkCrew::report(bool always, const std::string& notice)
{
  if (!progress_)
  {
    return;
  }
  std::unique_lock<std::mutex> lock(reportMutex_, std::defer_lock);
  if (always)
  {
    lock.lock();
  }
  else if (!lock.try_lock())
  {
    return; // another thread is reporting
  }
  Progress state;
  state.secondsElapsed = secondsElapsed();
  if (!always && state.secondsElapsed - lastReport_ < secondsBetweenReports)
  {
    return;
  }
  lastReport_ = state.secondsElapsed;
  state.phase = phase_;
  state.notice = notice;
  state.total = total_;
  state.done = std::min<std::uint64_t>(done_, total_);
  const double share = total_ == 0 ? 0.0 : static_cast<double>(state.done) / double(total_);
  state.fraction = std::min(1.0, fractionBefore_ + weight_ * share);
  if (!progress_(state))
  {
    fail(makeError(Error::Kind::Cancelled, "the build was cancelled; nothing was written"));
  }
}

} // namespace pointfront
