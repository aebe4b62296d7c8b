#include "pointfront/Residency/LoadSchedulerContent.h"

#include "pointfront/Threads/ThreadPriority.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <new>
#include <string>
#include <tuple>
#include <utility>

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

/// A batch of a source that does not say how much it should be has so many bytes.
constexpr std::size_t usualBatchBytes = std::size_t(1) << 20;

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

std::size_t LoadScheduler::Content::alive() const
{
  return static_cast<std::size_t>(
    std::count_if(workers.begin(), workers.end(), [](const Worker& w) { return !w.ended; }));
}

/// More threads than there should be, now that a read that hung has come back, or the last far
/// store is gone.
bool LoadScheduler::Content::surplus(Clock::time_point now) const
{
  const std::size_t far = farMembers > 0 ? FarLanes::mostOnAll : farLanes.count();
  return alive() > steadyThreads + lane.overdue(now) + far;
}

/// A thread that hangs in an overdue read is replaced, as far as spare ones go, and so is one that
/// waits for a far source; those that have ended are gathered in.
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
  const std::size_t wanted = steadyThreads + farLanes.count() +
    std::min<std::size_t>(lane.overdue(now), options.spareThreads);
  while (workers.size() < wanted && addWorker())
  {
  }
}

/// Whether the lane of this store takes a read now. A far one leaves a thread to the others.
bool LoadScheduler::Content::mayRead(const Member& member, Clock::time_point now) const
{
  const NodeReader& reader = member.store->reader();
  if (!member.far)
  {
    return !lane.busy(now) && !lane.barred(member.store.get(), reader.disk(), now);
  }
  const std::size_t threads = alive();
  return farLanes.open(reader.disk(), reader.readCost()) &&
    (threads <= 1 || farLanes.count() + 1 < threads);
}

/// Bytes in memory of the nodes that make a batch, by what nodes took so far.
std::size_t LoadScheduler::Content::batchBytes(const ReadCost& cost) const
{
  constexpr double usualGrowth = 3.0;
  const double growth = loaded.fetchedBytes > 0 && loaded.decodedBytes > loaded.fetchedBytes
    ? static_cast<double>(loaded.decodedBytes) / static_cast<double>(loaded.fetchedBytes)
    : usualGrowth;
  const std::size_t bytes = cost.bytesAtOnce > 0 ? cost.bytesAtOnce : usualBatchBytes;
  return static_cast<std::size_t>(growth * static_cast<double>(bytes));
}

/// The most urgent request of all stores that may be read now.
std::optional<LoadScheduler::Content::Read> LoadScheduler::Content::take(Clock::time_point now)
{
  if (farMembers == 0 && lane.busy(now))
  {
    return std::nullopt;
  }
  const Member* best = nullptr;
  StoreNodes::Urgency most;
  for (const Member& member : members)
  {
    if (!mayRead(member, now))
    {
      continue;
    }
    const std::optional<StoreNodes::Urgency> next = member.store->next();
    if (next &&
      (best == nullptr ||
        std::tie(next->turn, most.priority) < std::tie(most.turn, next->priority)))
    {
      best = &member;
      most = *next;
    }
  }
  return best != nullptr ? begin(*best, now) : std::nullopt;
}

/// None when nothing fits any more: that is a change that wakes us.
std::optional<LoadScheduler::Content::Read> LoadScheduler::Content::begin(
  const Member& member, Clock::time_point now)
{
  const NodeReader& reader = member.store->reader();
  Read read{ LoadJob(member.store, member.far, member.far ? batchBytes(reader.readCost()) : 0) };
  if (read.job.empty())
  {
    return std::nullopt;
  }
  try
  {
    StoreNodes* const store = member.store.get();
    read.ticket = member.far ? farLanes.enter(store, reader.disk(), read.job.stop())
                             : lane.enter(store, reader.disk(), now);
  }
  catch (...)
  {
    read.job.giveUp();
    throw;
  }
  return read;
}

void LoadScheduler::Content::freeLane(
  Worker& self, const Read& read, Clock::time_point begin, std::size_t bytesRead)
{
  {
    const std::lock_guard<std::mutex> lock(mutex);
    double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    if (read.job.stop())
    {
      seconds /= static_cast<double>(farLanes.count()); // the time is that of all of them
      farLanes.leave(read.ticket);
    }
    else
    {
      lane.leave(read.ticket);
    }
    self.fetching = false;
    loaded.fetchSeconds += seconds;
    loaded.fetchedBytes += bytesRead;
  }
  budget->announceChange();
}

/// Frees the lane of a read when it has ended, and adds up what was loaded.
class LoadScheduler::Content::ReadListener final : public LoadJob::Listener
{
public:
  ReadListener(Content& content, Worker& self, const Read& read)
    : content_(content)
    , self_(self)
    , read_(read)
  {
  }

  void fetched(std::size_t bytes) override { content_.freeLane(self_, read_, begin_, bytes); }
  void decoded(double seconds, std::size_t bytes) override
  {
    const std::lock_guard<std::mutex> lock(content_.mutex);
    content_.loaded.decodeSeconds += seconds;
    content_.loaded.lastLoaded = Clock::now();
    content_.loaded.decodedBytes += bytes;
  }
  void changed() override { content_.budget->announceChange(); }

private:
  Content& content_;
  Worker& self_;
  const Read& read_;
  const Clock::time_point begin_ = Clock::now();
};

void LoadScheduler::Content::perform(Worker& self, Read& read)
{
  ReadListener listener(*this, self, read);
  read.job.run(listener);
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
  std::optional<Read> read;
  std::optional<Clock::time_point> lookAgain;
  {
    const std::lock_guard<std::mutex> lock(mutex);
    if (stopped || surplus(now))
    {
      self.ended = true;
      return;
    }
    replaceHanging(now);
    read = take(now);
    self.fetching = read.has_value();
    self.far = read && read->job.stop();
    self.since = now;
    if (self.far)
    {
      replaceHanging(now);
    }
    lookAgain = lane.freeAt(now);
  }
  if (read)
  {
    perform(self, *read);
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
    std::optional<Read> read;
    {
      const std::lock_guard<std::mutex> lock(mutex);
      if (!workers.empty() || addWorker())
      {
        return;
      }
      read = take(Clock::now());
    }
    if (!read)
    {
      return;
    }
    perform(self, *read);
  }
}

LoadScheduler::Content::Member* LoadScheduler::Content::memberOf(const StoreNodes& store)
{
  const auto found = std::find_if(members.begin(), members.end(),
    [&](const Member& member) { return member.store.get() == &store; });
  return found != members.end() ? &*found : nullptr;
}

/// Bytes that must be freed for what waits; what is released but still held somewhere is on its
/// way already.
std::size_t LoadScheduler::Content::bytesWanted() const
{
  std::size_t sum = 0;
  for (const Member& member : members)
  {
    // Nodes that a store's own budget does not let in need no room here.
    const std::size_t staying = member.store->stayingBytes();
    const std::size_t own = std::max(member.store->budget().ownLimit(), staying);
    sum += std::min(member.store->waitingBytes() + staying, own);
  }
  const std::size_t limit = budget->limit();
  return sum > limit ? sum - limit : 0;
}

void LoadScheduler::Content::releaseFrom(
  ReleasePlan& plan, std::size_t bytes, StoreNodes::Gone& gone)
{
  for (const ReleasePlan::Candidate& candidate : plan.farthest(bytes))
  {
    members[candidate.store].store->release(candidate.node, gone);
  }
}

/// Whether a thread stays in its read. One that waits for a far source has been told to stop and
/// gets until `patience` for it.
bool LoadScheduler::Content::hangsAtTheEnd(const Worker& worker, Clock::time_point patience)
{
  while (true)
  {
    const std::uint64_t seen = budget->changes();
    {
      const std::lock_guard<std::mutex> lock(mutex);
      const Clock::time_point now = Clock::now();
      const bool late = worker.far ? now >= patience : now - worker.since >= options.overdueAfter;
      if (!worker.fetching || !worker.far || late)
      {
        return worker.fetching && late;
      }
    }
    budget->waitForChange(seen, patience);
  }
}

} // namespace pointfront
