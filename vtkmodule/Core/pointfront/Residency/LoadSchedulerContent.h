#pragma once

#include "pointfront/Residency/DiskLane.h"
#include "pointfront/Residency/FarLanes.h"
#include "pointfront/Residency/LoadJob.h"
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

/// The stores of a scheduler, and the threads that load them. It lives as long as any of these
/// threads, and the scheduler may end before.
struct LoadScheduler::Content : std::enable_shared_from_this<LoadScheduler::Content>
{
  using Clock = DiskLane::Clock;

  struct Member
  {
    std::shared_ptr<StoreNodes> store;
    std::uint64_t points = 0;
    NodeCache::Distance distance; ///< null until its first release()
    bool far = false; ///< read on a lane of its server
  };
  struct Read
  {
    LoadJob job;
    DiskLane::Ticket ticket = 0; ///< or of FarLanes
  };
  struct Worker
  {
    WorkerThread thread;
    bool fetching = false;
    bool far = false; ///< its fetch is that of a far source
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
  FarLanes farLanes;
  std::size_t farMembers = 0;
  const unsigned steadyThreads;
  std::list<Worker> workers;
  bool stopped = false;
  std::atomic<bool> starving{ false };
  LoadSchedulerStatistics loaded; ///< its sums over all loads

  std::size_t alive() const;
  bool addWorker();
  bool surplus(Clock::time_point now) const;
  void replaceHanging(Clock::time_point now);
  bool mayRead(const Member& member, Clock::time_point now) const;
  std::size_t batchBytes(const ReadCost& cost) const;
  std::optional<Read> take(Clock::time_point now);
  std::optional<Read> begin(const Member& member, Clock::time_point now);
  void work(Worker& self);
  void takeTurn(Worker& self, std::uint64_t seen);
  void loadHere();
  class ReadListener;
  void perform(Worker& self, Read& read);
  void freeLane(Worker& self, const Read& read, Clock::time_point begin, std::size_t bytesRead);
  bool hangsAtTheEnd(const Worker& worker, Clock::time_point patience);
  Member* memberOf(const StoreNodes& store);
  std::size_t bytesWanted() const;
  void releaseFrom(ReleasePlan& plan, std::size_t bytes, StoreNodes::Gone& gone);
};

} // namespace pointfront
