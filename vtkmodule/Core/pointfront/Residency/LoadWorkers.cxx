#include "pointfront/Residency/LoadSchedulerContent.h"

#include "pointfront/Base/CpuClock.h"
#include "pointfront/Threads/ThreadPriority.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <new>
#include <string>
#include <tuple>

namespace pointfront
{
namespace
{

/// After a step that ran out of memory, unless something is given back before.
constexpr std::chrono::milliseconds waitForMemory{ 100 };

/// So many one after another, some seconds: no more memory is to be expected.
constexpr int failuresThatStarve = 30;

/// FRONT-9: loading must not disturb the drawing.
constexpr int niceness = 5;

/// Calls `step`; an exception becomes an Error that names the node.
template <typename Step>
auto guarded(NodeIndex node, const Step& step) -> decltype(step())
{
  const std::string name = "node " + std::to_string(node);
  try
  {
    return step();
  }
  catch (const std::bad_alloc&)
  {
    return makeError(Error::Kind::NoMemory, name + ": no memory to decode");
  }
  catch (const std::exception& exception)
  {
    return makeError(Error::Kind::Corrupt, name + ": " + exception.what());
  }
}

} // namespace

unsigned LoadScheduler::Content::loadThreads(const LoadSchedulerOptions& options)
{
  const unsigned processors = threadsOr(0);
  return options.threads > 0 ? options.threads
                             : std::clamp(processors > 1 ? processors - 1 : 1u, 2u, 16u);
}

/// False where the system gives no thread.
bool LoadScheduler::Content::addWorker()
{
  Worker& worker = workers.emplace_back();
  if (!worker.thread.start([self = shared_from_this(), &worker] { self->work(worker); }))
  {
    workers.pop_back();
    return false;
  }
  return true;
}

/// More threads than there should be, now that a read that hung has come back.
bool LoadScheduler::Content::surplus(Clock::time_point now) const
{
  const auto alive = static_cast<std::size_t>(
    std::count_if(workers.begin(), workers.end(), [](const Worker& w) { return !w.ended; }));
  return alive > steadyThreads + lane.overdue(now);
}

/// A thread that hangs in an overdue read is replaced, as far as spare ones go; those that have
/// ended are gathered in.
void LoadScheduler::Content::replaceHanging(Clock::time_point now)
{
  for (auto worker = workers.begin(); worker != workers.end();)
  {
    if (worker->ended)
    {
      worker->thread.join();
      worker = workers.erase(worker);
    }
    else
    {
      ++worker;
    }
  }
  const std::size_t wanted =
    steadyThreads + std::min<std::size_t>(lane.overdue(now), options.spareThreads);
  while (workers.size() < wanted && addWorker())
  {
  }
}

/// The most urgent request of all stores that may be read now.
std::optional<LoadScheduler::Content::Job> LoadScheduler::Content::take(Clock::time_point now)
{
  if (lane.busy(now))
  {
    return std::nullopt;
  }
  const Member* best = nullptr;
  StoreNodes::Urgency most;
  for (const Member& member : members)
  {
    if (lane.barred(member.store.get(), member.store->reader().disk(), now))
    {
      continue;
    }
    const std::optional<StoreNodes::Urgency> next = member.store->next();
    if (next &&
      (best == nullptr ||
        std::tie(next->rank, most.priority) < std::tie(most.rank, next->priority)))
    {
      best = &member;
      most = *next;
    }
  }
  std::optional<StoreNodes::Task> task = best != nullptr ? best->store->begin() : std::nullopt;
  if (!task)
  {
    return std::nullopt; // nothing fits; or not any more, and that is a change that wakes us
  }
  const DiskLane::Ticket ticket = lane.enter(best->store.get(), best->store->reader().disk(), now);
  return Job{ best->store, std::move(*task), ticket };
}

void LoadScheduler::Content::freeLane(
  Worker& self, const Job& job, Clock::time_point begin, std::size_t bytesRead)
{
  {
    const std::lock_guard<std::mutex> lock(mutex);
    lane.leave(job.ticket);
    self.fetching = false;
    loaded.fetchSeconds += std::chrono::duration<double>(Clock::now() - begin).count();
    loaded.fetchedBytes += bytesRead;
  }
  budget->announceChange();
}

/// The table keeps what was read, and tells who waits.
void LoadScheduler::Content::readRows(Worker& self, const Job& job)
{
  const Clock::time_point begin = Clock::now();
  const auto end = [&](std::size_t bytesRead)
  {
    freeLane(self, job, begin, bytesRead);
    job.store->leave(job.task);
    budget->announceChange();
  };
  try
  {
    end(job.store->reader().missingRows()->readNext());
  }
  catch (...)
  {
    end(0); // the rows are still missing
    throw;
  }
}

void LoadScheduler::Content::perform(Worker& self, const Job& job)
{
  if (job.task.node == noNode)
  {
    readRows(self, job);
    return;
  }
  bool fetching = true, kept = false;
  const Clock::time_point begin = Clock::now();
  // Whatever runs out of memory here, be it the words of an Error: who waits for the end of the
  // loading must not wait for ever.
  try
  {
    load(self, job, begin, fetching, kept);
  }
  catch (...)
  {
    if (fetching)
    {
      freeLane(self, job, begin, 0);
    }
    if (!kept)
    {
      job.store->abandon(job.task);
    }
    job.store->leave(job.task);
    budget->announceChange();
    throw;
  }
  // Only now: who waits until nothing is loading may count on all having been told.
  job.store->leave(job.task);
  budget->announceChange();
}

/// `fetching`: the lane is not free yet. `kept`: the store has the node, or knows why not.
void LoadScheduler::Content::load(
  Worker& self, const Job& job, Clock::time_point begin, bool& fetching, bool& kept)
{
  const NodeReader& reader = job.store->reader();
  const StoreNodes::Task& task = job.task;
  Result<FetchedNode> fetched =
    guarded(task.node, [&] { return reader.fetch(task.node, task.columns); });
  const std::size_t bytesRead = fetched ? fetched->bytesRead : 0;
  fetching = false;
  freeLane(self, job, begin, bytesRead);
  double decodeSeconds = -threadSeconds();
  Result<NodeColumns> result = fetched ? guarded(task.node, [&] { return reader.decode(*fetched); })
                                       : Result<NodeColumns>(fetched.error());
  decodeSeconds += threadSeconds();
  fetched = makeError(Error::Kind::Cancelled, "decoded"); // its bytes go before anyone is told
  {
    const std::lock_guard<std::mutex> lock(mutex);
    loaded.decodeSeconds += decodeSeconds;
    loaded.lastLoaded = Clock::now();
    loaded.decodedBytes += result ? result->bytes() : 0;
  }
  kept = true;
  const bool news = job.store->finish(task, std::move(result), bytesRead);
  budget->announceChange();
  if (news)
  {
    job.store->tell();
  }
}

void LoadScheduler::Content::work(Worker& self)
{
  lowerThreadPriority(niceness);
  int failures = 0; // one after another
  while (!self.ended)
  {
    const std::uint64_t seen = budget->changes();
    try
    {
      takeTurn(self, seen);
      failures = 0;
      starving = false;
    }
    catch (const std::bad_alloc&)
    {
      starving = starving || ++failures >= failuresThatStarve;
      budget->waitForChange(seen, Clock::now() + waitForMemory);
    }
  }
}

/// Does what is most urgent, or waits for a change after `seen`.
void LoadScheduler::Content::takeTurn(Worker& self, std::uint64_t seen)
{
  const Clock::time_point now = Clock::now();
  std::optional<Job> job;
  std::optional<Clock::time_point> lookAgain;
  {
    const std::lock_guard<std::mutex> lock(mutex);
    if (stopped || surplus(now))
    {
      self.ended = true;
      return;
    }
    replaceHanging(now);
    job = take(now);
    self.fetching = job.has_value();
    self.since = now;
    lookAgain = lane.freeAt(now);
  }
  if (job)
  {
    perform(self, *job);
  }
  else if (lookAgain)
  {
    budget->waitForChange(seen, *lookAgain);
  }
  else
  {
    budget->waitForChange(seen);
  }
}

/// On the caller's thread.
void LoadScheduler::Content::loadHere()
{
  while (true)
  {
    Worker self;
    std::optional<Job> job;
    {
      const std::lock_guard<std::mutex> lock(mutex);
      if (!workers.empty() || addWorker())
      {
        return;
      }
      job = take(Clock::now());
    }
    if (!job)
    {
      return;
    }
    perform(self, *job);
  }
}

} // namespace pointfront
