#include "pointfront/Residency/LoadSchedulerContent.h"

#include "pointfront/Base/CpuClock.h"
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

/// Nodes of one batch at most.
constexpr std::size_t mostOfABatch = 64;

/// A batch of a source that does not say how much it should be has so many bytes.
constexpr std::size_t usualBatchBytes = std::size_t(1) << 20;

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
std::optional<LoadScheduler::Content::Job> LoadScheduler::Content::take(Clock::time_point now)
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
        std::tie(next->rank, most.priority) < std::tie(most.rank, next->priority)))
    {
      best = &member;
      most = *next;
    }
  }
  return best != nullptr ? begin(*best, now) : std::nullopt;
}

/// None when nothing fits any more: that is a change that wakes us.
std::optional<LoadScheduler::Content::Job> LoadScheduler::Content::begin(
  const Member& member, Clock::time_point now)
{
  StoreNodes& store = *member.store;
  const NodeReader& reader = store.reader();
  Job job;
  job.store = member.store;
  // A node counts as loading from here on. So nothing may run out of memory before somebody sees
  // to it that this ends.
  job.tasks.reserve(member.far ? mostOfABatch : 1);
  try
  {
    if (member.far)
    {
      job.stop = std::make_shared<ReadStop>(false);
      store.beginBatch(batchBytes(reader.readCost()), mostOfABatch, job.stop, job.tasks);
    }
    else if (std::optional<StoreNodes::Task> task = store.begin())
    {
      job.tasks.push_back(std::move(*task));
    }
    if (job.tasks.empty())
    {
      return std::nullopt;
    }
    job.ticket = member.far ? farLanes.enter(&store, reader.disk(), job.stop)
                            : lane.enter(&store, reader.disk(), now);
  }
  catch (...)
  {
    for (const StoreNodes::Task& task : job.tasks)
    {
      if (task.node != noNode)
      {
        store.abandon(task);
      }
      store.leave(task);
    }
    throw;
  }
  return job;
}

void LoadScheduler::Content::freeLane(
  Worker& self, const Job& job, Clock::time_point begin, std::size_t bytesRead)
{
  {
    const std::lock_guard<std::mutex> lock(mutex);
    double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    if (job.stop)
    {
      seconds /= static_cast<double>(farLanes.count()); // the time is that of all of them
      farLanes.leave(job.ticket);
    }
    else
    {
      lane.leave(job.ticket);
    }
    self.fetching = false;
    loaded.fetchSeconds += seconds;
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
    job.store->leave(job.tasks.front());
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
  if (job.tasks.front().node == noNode)
  {
    readRows(self, job);
    return;
  }
  Progress progress;
  progress.begin = Clock::now();
  // Whatever runs out of memory here, be it the words of an Error: who waits for the end of the
  // loading must not wait for ever.
  try
  {
    load(self, job, progress);
  }
  catch (...)
  {
    if (progress.fetching)
    {
      freeLane(self, job, progress.begin, 0);
    }
    for (; progress.kept < job.tasks.size(); ++progress.kept)
    {
      job.store->abandon(job.tasks[progress.kept]);
    }
    for (; progress.left < job.tasks.size(); ++progress.left)
    {
      job.store->leave(job.tasks[progress.left]);
    }
    budget->announceChange();
    throw;
  }
}

void LoadScheduler::Content::load(Worker& self, const Job& job, Progress& progress)
{
  const NodeReader& reader = job.store->reader();
  const StoreNodes::Task& first = job.tasks.front();
  std::vector<Result<FetchedNode>> fetched;
  if (job.stop)
  {
    std::vector<WantedNode> wanted;
    for (const StoreNodes::Task& task : job.tasks)
    {
      wanted.push_back({ task.node, task.columns });
    }
    using All = Result<std::vector<Result<FetchedNode>>>;
    All all = guarded(first.node, [&] { return All(reader.fetchAll(wanted, *job.stop)); });
    if (all)
    {
      fetched = std::move(*all);
    }
    while (fetched.size() < job.tasks.size())
    {
      fetched.emplace_back(all.error());
    }
  }
  else
  {
    fetched.push_back(guarded(first.node, [&] { return reader.fetch(first.node, first.columns); }));
  }
  std::size_t bytesRead = 0;
  for (const Result<FetchedNode>& node : fetched)
  {
    bytesRead += node ? node->bytesRead : 0;
  }
  progress.fetching = false;
  freeLane(self, job, progress.begin, bytesRead);
  for (Result<FetchedNode>& node : fetched)
  {
    finish(job, std::exchange(node, makeError(Error::Kind::Cancelled, "decoded")), progress);
  }
}

/// Decodes the next node of a job.
void LoadScheduler::Content::finish(const Job& job, Result<FetchedNode> fetched, Progress& progress)
{
  const NodeReader& reader = job.store->reader();
  const StoreNodes::Task& task = job.tasks[progress.kept];
  const std::size_t bytesRead = fetched ? fetched->bytesRead : 0;
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
  ++progress.kept;
  const bool news = job.store->finish(task, std::move(result), bytesRead);
  budget->announceChange();
  if (news)
  {
    job.store->tell();
  }
  // Only now: who waits until nothing is loading may count on all having been told.
  job.store->leave(task);
  ++progress.left;
  budget->announceChange();
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
    self.far = job && job->stop;
    self.since = now;
    if (self.far)
    {
      replaceHanging(now);
    }
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
