#pragma once

#include "pointfront/Residency/DiskLane.h"
#include "pointfront/Residency/LoadScheduler.h"
#include "pointfront/Residency/StoreNodes.h"
#include "pointfront/Threads/WorkerThread.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace pointfront
{

/// The stores of a scheduler, and the threads that load them. Who belongs to it and what they give
/// back is in LoadScheduler.cxx, what the threads do in LoadWorkers.cxx.
struct LoadScheduler::Content : std::enable_shared_from_this<LoadScheduler::Content>
{
  using Clock = DiskLane::Clock;

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
    Clock::time_point since; ///< when its read began
    bool ended = false;
  };

  Content(const LoadSchedulerOptions& o, std::shared_ptr<MemoryBudget> b)
    : options(o)
    , budget(std::move(b))
    , lane(o.overdueAfter)
    , steadyThreads(loadThreads(o))
  {
  }

  static unsigned loadThreads(const LoadSchedulerOptions& options);

  const LoadSchedulerOptions options;
  const std::shared_ptr<MemoryBudget> budget;

  mutable std::mutex mutex; ///< guards all below; taken before a store's own
  std::vector<Member> members;
  DiskLane lane;
  const unsigned steadyThreads;
  std::list<Worker> workers;
  bool stopped = false;
  std::atomic<bool> starving{ false };
  LoadSchedulerStatistics loaded; ///< its sums over all loads

  bool addWorker();
  bool surplus(Clock::time_point now) const;
  void replaceHanging(Clock::time_point now);
  std::optional<Job> take(Clock::time_point now);
  void work(Worker& self);
  void takeTurn(Worker& self, std::uint64_t seen);
  void loadHere();
  void perform(Worker& self, const Job& job);
  void load(Worker& self, const Job& job, Clock::time_point begin, bool& fetching, bool& kept);
  void readRows(Worker& self, const Job& job);
  void freeLane(Worker& self, const Job& job, Clock::time_point begin, std::size_t bytesRead);
  Member* memberOf(const StoreNodes& store);
  std::size_t bytesWanted() const;
  void releaseFrom(ReleasePlan& plan, std::size_t bytes, StoreNodes::Gone& gone);
};

} // namespace pointfront
