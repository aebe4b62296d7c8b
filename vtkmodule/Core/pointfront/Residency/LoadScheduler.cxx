#include "pointfront/Residency/LoadScheduler.h"

#include "pointfront/Base/CpuClock.h"
#include "pointfront/Residency/DiskLane.h"
#include "pointfront/Residency/StoreNodes.h"
#include "pointfront/Threads/WorkerThread.h"

#include <algorithm>
#include <exception>
#include <list>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <tuple>
#include <thread>
#include <utility>
#include <vector>

#if defined(__linux__)
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace pointfront
{
namespace
{

using Clock = DiskLane::Clock;

/// After a step that ran out of memory, unless something is given back before.
constexpr std::chrono::milliseconds waitForMemory{ 100 };

/// FRONT-9: loading must not disturb the drawing. A hint: where it is refused nothing is lost.
void lowerThreadPriority()
{
#if defined(__linux__)
  constexpr int niceness = 5;
  static_cast<void>(setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), niceness));
#endif
}

unsigned threadsOf(const LoadSchedulerOptions& options)
{
  const unsigned processors = threadsOr(0);
  return options.threads > 0 ? options.threads
                             : std::clamp(processors > 1 ? processors - 1 : 1u, 2u, 16u);
}

/// What `step` gives; what it throws becomes an Error that names the node.
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

/// The process's: bytes stay on it while anyone holds points, whatever schedulers come and go.
const std::shared_ptr<MemoryBudget>& processBudget()
{
  static const auto* const budget = // never deleted: points may outlive static objects
    new std::shared_ptr<MemoryBudget>(
      std::make_shared<MemoryBudget>(LoadSchedulerOptions().budgetBytes));
  return *budget;
}

struct ProcessScheduler
{
  std::mutex mutex;
  std::weak_ptr<LoadScheduler> running;
};

ProcessScheduler& processScheduler()
{
  static auto* const instance = new ProcessScheduler;
  return *instance;
}

} // namespace

struct LoadScheduler::Content : std::enable_shared_from_this<LoadScheduler::Content>
{
  struct Member
  {
    std::shared_ptr<StoreNodes> store;
    std::uint64_t points = 0;
    NodeCache::Distance distance; ///< null until its first release()
  };
  struct Job
  {
    std::shared_ptr<StoreNodes> store;
    StoreNodes::Task task;
    DiskLane::Ticket ticket = 0;
  };
  struct Worker
  {
    WorkerThread thread;
    bool fetching = false;
    Clock::time_point since; ///< of its read
    bool ended = false;
  };

  Content(const LoadSchedulerOptions& o, std::shared_ptr<MemoryBudget> b)
    : options(o)
    , budget(std::move(b))
    , lane(o.overdueAfter)
    , steadyThreads(threadsOf(o))
  {
  }

  const LoadSchedulerOptions options;
  const std::shared_ptr<MemoryBudget> budget;

  mutable std::mutex mutex; ///< of all below; taken before a store's own
  std::vector<Member> members;
  DiskLane lane;
  const unsigned steadyThreads;
  std::list<Worker> workers;
  bool stopped = false;
  LoadSchedulerStatistics loaded; ///< its sums over all loads

  bool addWorker();
  bool surplus(Clock::time_point now) const;
  void replaceHanging(Clock::time_point now);
  std::optional<Job> take(Clock::time_point now);
  void work(Worker& self);
  void takeTurn(Worker& self, std::uint64_t seen);
  void loadHere();
  void perform(Worker& self, const Job& job);
  void readRows(Worker& self, const Job& job);
  void freeLane(Worker& self, const Job& job, Clock::time_point begin, std::size_t bytesRead);
  Member* memberOf(const StoreNodes& store);
  std::size_t bytesWanted() const;
  void releaseFrom(ReleasePlan& plan, std::size_t bytes, StoreNodes::Gone& gone);
};

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
  catch (const std::bad_alloc&)
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
  const NodeReader& reader = job.store->reader();
  const StoreNodes::Task& task = job.task;
  const Clock::time_point begin = Clock::now();
  Result<FetchedNode> fetched =
    guarded(task.node, [&] { return reader.fetch(task.node, task.columns); });
  const std::size_t bytesRead = fetched ? fetched->bytesRead : 0;
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
  const bool news = job.store->finish(task, std::move(result), bytesRead);
  budget->announceChange();
  if (news)
  {
    job.store->tell();
  }
  // Only now: who waits until nothing is loading may count on all having been told.
  job.store->leave(task);
  budget->announceChange();
}

void LoadScheduler::Content::work(Worker& self)
{
  lowerThreadPriority();
  while (!self.ended)
  {
    const std::uint64_t seen = budget->changes();
    try
    {
      takeTurn(self, seen);
    }
    catch (const std::bad_alloc&)
    {
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
    // What a store's own budget does not let in needs no room here.
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

LoadScheduler::LoadScheduler(const LoadSchedulerOptions& options)
  : LoadScheduler(options, std::make_shared<MemoryBudget>(options.budgetBytes))
{
}

LoadScheduler::LoadScheduler(
  const LoadSchedulerOptions& options, std::shared_ptr<MemoryBudget> budget)
  : content_(std::make_shared<Content>(options, std::move(budget)))
{
  const std::lock_guard<std::mutex> lock(content_->mutex);
  unsigned threads = 0;
  while (threads < content_->steadyThreads && content_->addWorker())
  {
    ++threads;
  }
}

LoadScheduler::~LoadScheduler()
{
  Content& c = *content_;
  {
    const std::lock_guard<std::mutex> lock(c.mutex);
    c.stopped = true;
  }
  c.budget->announceChange();
  // A worker's address is known to its thread: the list keeps its elements until they have ended.
  for (Content::Worker& worker : c.workers)
  {
    bool hangs = false;
    {
      const std::lock_guard<std::mutex> lock(c.mutex);
      hangs = worker.fetching && Clock::now() - worker.since >= c.options.overdueAfter;
    }
    if (hangs)
    {
      worker.thread.detach(); // it holds all it needs, and ends when its disk answers
    }
    else
    {
      worker.thread.join();
    }
  }
}

std::shared_ptr<LoadScheduler> LoadScheduler::ofProcess()
{
  ProcessScheduler& process = processScheduler();
  const std::lock_guard<std::mutex> lock(process.mutex);
  std::shared_ptr<LoadScheduler> scheduler = process.running.lock();
  if (!scheduler)
  {
    scheduler.reset(new LoadScheduler(LoadSchedulerOptions(), processBudget()));
    process.running = scheduler;
  }
  return scheduler;
}

void LoadScheduler::setProcessBudgetBytes(std::size_t bytes)
{
  std::shared_ptr<LoadScheduler> running; // let go after the lock
  {
    ProcessScheduler& process = processScheduler();
    const std::lock_guard<std::mutex> lock(process.mutex);
    running = process.running.lock();
    processBudget()->setLimit(bytes);
  }
  if (running)
  {
    running->setBudgetBytes(bytes);
  }
}

std::size_t LoadScheduler::processBudgetBytes()
{
  return processBudget()->ownLimit();
}

const std::shared_ptr<MemoryBudget>& LoadScheduler::budget() const
{
  return content_->budget;
}

void LoadScheduler::setBudgetBytes(std::size_t bytes)
{
  content_->budget->setLimit(bytes);
  {
    const std::lock_guard<std::mutex> lock(content_->mutex);
    for (const Content::Member& member : content_->members)
    {
      member.store->reconsider();
    }
  }
  content_->budget->announceChange();
}

LoadSchedulerStatistics LoadScheduler::statistics() const
{
  const std::lock_guard<std::mutex> lock(content_->mutex);
  LoadSchedulerStatistics s = content_->loaded;
  s.stores = static_cast<std::uint32_t>(content_->members.size());
  s.threads = static_cast<std::uint32_t>(std::count_if(content_->workers.begin(),
    content_->workers.end(), [](const Content::Worker& w) { return !w.ended; }));
  s.overdueReads = static_cast<std::uint32_t>(content_->lane.overdue(Clock::now()));
  s.residentBytes = content_->budget->used();
  s.residentBytesMax = content_->budget->usedMax();
  return s;
}

void LoadScheduler::loadWithoutThreads()
{
  content_->loadHere();
}

void LoadScheduler::join(const std::shared_ptr<StoreNodes>& store, std::uint64_t points)
{
  const std::lock_guard<std::mutex> lock(content_->mutex);
  content_->members.push_back({ store, points, {} });
}

void LoadScheduler::leave(const std::shared_ptr<StoreNodes>& store)
{
  {
    const std::lock_guard<std::mutex> lock(content_->mutex);
    Content::Member* member = content_->memberOf(*store);
    content_->members.erase(content_->members.begin() + (member - content_->members.data()));
  }
  while (true)
  {
    const std::uint64_t seen = content_->budget->changes();
    std::optional<Clock::time_point> overdueAt;
    {
      const std::lock_guard<std::mutex> lock(content_->mutex);
      const Clock::time_point now = Clock::now();
      if (!store->loading() || content_->lane.overdue(store.get(), now))
      {
        break;
      }
      overdueAt = content_->lane.freeAt(now);
    }
    if (overdueAt)
    {
      content_->budget->waitForChange(seen, *overdueAt);
    }
    else
    {
      content_->budget->waitForChange(seen);
    }
  }
  store->close();
  content_->budget->announceChange();
}

double LoadScheduler::shareOf(const StoreNodes& store) const
{
  const std::lock_guard<std::mutex> lock(content_->mutex);
  std::uint64_t own = 0;
  std::uint64_t all = 0;
  for (const Content::Member& member : content_->members)
  {
    all += member.points;
    own = member.store.get() == &store ? member.points : own;
  }
  return all > 0 ? static_cast<double>(own) / static_cast<double>(all) : 1.0;
}

void LoadScheduler::release(StoreNodes& store, const NodeCache::Distance& distance)
{
  StoreNodes::Gone gone; // dropped after the locks
  bool changed = false;
  {
    const std::lock_guard<std::mutex> lock(content_->mutex);
    Content& c = *content_;
    Content::Member* const own = c.memberOf(store);
    own->distance = distance;
    const std::size_t ownLimit = store.budget().ownLimit();
    const std::size_t ownWanted = store.waitingBytes() + store.stayingBytes();
    if (ownWanted > ownLimit)
    {
      ReleasePlan plan;
      store.offer(static_cast<std::uint32_t>(own - c.members.data()), distance, plan);
      c.releaseFrom(plan, ownWanted - ownLimit, gone);
    }
    const std::size_t wanted = c.bytesWanted();
    if (wanted > 0)
    {
      ReleasePlan plan;
      for (std::uint32_t m = 0; m < c.members.size(); ++m)
      {
        if (c.members[m].distance)
        {
          c.members[m].store->offer(m, c.members[m].distance, plan);
        }
      }
      c.releaseFrom(plan, wanted, gone);
    }
    const bool nothingFound = (ownWanted > ownLimit || wanted > 0) && gone.empty();
    changed = !gone.empty() || store.noteRelease(nothingFound);
  }
  if (changed)
  {
    gone.clear();
    content_->budget->announceChange();
  }
}

} // namespace pointfront
