#include "pointfront/Residency/LoadScheduler.h"

#include "pointfront/Residency/LoadSchedulerContent.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>
#include <utility>

namespace pointfront
{
namespace
{

/// The size that the process's budget was set to: a child of fork() begins with that.
std::atomic<std::size_t>& processBudgetLimit()
{
  static std::atomic<std::size_t> bytes{ LoadSchedulerOptions().budgetBytes };
  return bytes;
}

/// The process's: bytes stay on it while anyone holds points, whatever schedulers come and go.
const std::shared_ptr<MemoryBudget>& processBudget()
{
  using Shared = std::shared_ptr<MemoryBudget>;
  static auto* const budget = new OfProcess<Shared>; // never deleted: points may outlive statics
  return budget->get(
    [] { return std::make_unique<Shared>(std::make_shared<MemoryBudget>(processBudgetLimit())); });
}

struct ProcessScheduler
{
  std::mutex mutex;
  std::weak_ptr<LoadScheduler> running;
};

ProcessScheduler& processScheduler()
{
  // Never deleted, as the budget.
  static auto* const instance = new OfProcess<ProcessScheduler>;
  return instance->get([] { return std::make_unique<ProcessScheduler>(); });
}

} // namespace

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
  if (mark_.left())
  {
    static_cast<void>(new std::shared_ptr<Content>(content_)); // its threads will not let go of it
    return;
  }
  Content& c = *content_;
  {
    const std::lock_guard<std::mutex> lock(c.mutex);
    c.stopped = true;
    c.farLanes.stopAll();
  }
  c.budget->announceChange();
  const DiskLane::Clock::time_point patience = DiskLane::Clock::now() + c.options.overdueAfter;
  // A worker's address is known to its thread: the list keeps its elements until they have ended.
  for (Content::Worker& worker : c.workers)
  {
    if (c.hangsAtTheEnd(worker, patience))
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
    processBudgetLimit() = bytes;
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
  s.overdueReads = static_cast<std::uint32_t>(content_->lane.overdue(DiskLane::Clock::now()));
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
  const bool far = store->reader().readCost().far();
  content_->farMembers += far ? 1 : 0;
  content_->members.push_back({ store, points, {}, far });
}

void LoadScheduler::leave(const std::shared_ptr<StoreNodes>& store)
{
  if (mark_.left())
  {
    return;
  }
  {
    const std::lock_guard<std::mutex> lock(content_->mutex);
    Content::Member* member = content_->memberOf(*store);
    content_->farMembers -= member->far ? 1 : 0;
    content_->farLanes.stop(store.get());
    content_->members.erase(content_->members.begin() + (member - content_->members.data()));
  }
  const DiskLane::Clock::time_point patience =
    DiskLane::Clock::now() + content_->options.overdueAfter;
  while (true)
  {
    const std::uint64_t seen = content_->budget->changes();
    std::optional<DiskLane::Clock::time_point> overdueAt;
    {
      const std::lock_guard<std::mutex> lock(content_->mutex);
      const DiskLane::Clock::time_point now = DiskLane::Clock::now();
      const bool far = content_->farLanes.count(store.get()) > 0;
      if (!store->loading() || content_->lane.overdue(store.get(), now) || (far && now >= patience))
      {
        break;
      }
      overdueAt = far ? patience : content_->lane.freeAt(now);
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

bool LoadScheduler::starving() const
{
  return content_->starving;
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
    const bool other = store.noteRelease(nothingFound); // always: it keeps the answer
    changed = !gone.empty() || other;
  }
  if (changed)
  {
    gone.clear();
    content_->budget->announceChange();
  }
}

} // namespace pointfront
