#pragma once

#include "pointfront/Front/SharedDemand.h"
#include "pointfront/Residency/MemoryBudget.h"
#include "pointfront/Residency/NodeCache.h"
#include "pointfront/Threads/OfProcess.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace pointfront
{

class StoreNodes;

struct LoadSchedulerOptions
{
  /// Bytes of decoded nodes in host memory, over all stores. Hard.
  std::size_t budgetBytes = std::size_t(1) << 30;
  /// That fetch and decode; 0: one less than there are processors, 2 to 16.
  unsigned threads = 0;
  /// A read that takes longer holds up no other store (see DiskLane).
  std::chrono::milliseconds overdueAfter{ 250 };
  /// Threads more, at most, in the place of those that hang in overdue reads.
  unsigned spareThreads = 8;
};

struct LoadSchedulerStatistics
{
  std::uint32_t stores = 0;
  std::uint32_t threads = 0; ///< spare ones included
  std::uint32_t overdueReads = 0;
  std::size_t residentBytes = 0;
  std::size_t residentBytesMax = 0;
  // Sums over all that was loaded so far:
  std::uint64_t fetchedBytes = 0;
  std::uint64_t decodedBytes = 0; ///< in memory
  double fetchSeconds = 0.0; ///< time of all lanes; a far one's reads beside each other count once
  double decodeSeconds = 0.0; ///< CPU time of all threads together
  std::chrono::steady_clock::time_point lastLoaded; ///< when the last of it was there
};

/// Loads the nodes of any number of stores. The stores share its threads, its host memory and one
/// order of requests, so a hundred stores cost as much as one. Stores come and go at run time: each
/// Residency is one store.
/// Order       most urgent first over all stores: nodes drawn with old columns, then needed ones by
///             projected error, then re-reads, then optional ones; ties by the order of joining.
/// Disk        one read at a time over all stores, decoding beside it on the other threads; a read
///             that hangs is passed by others (DiskLane). Bytes fetched and not yet decoded, at
///             most one node a thread, are not on the account.
/// Far         stores whose reader says so (NodeReader::readCost) have a lane for each server
///             beside that of the disks (FarLanes): several batches of nodes at a time, each in the
///             order of requests, each with a thread of its own that is made when it is needed. A
///             batch of which no node is wanted any more is told to stop (FRONT-9).
/// Memory      release() frees by distance under the fronts of all stores together (FRONT-10).
/// Threads     its own for loading, at a lower priority. release() and the distance functions that
///             were given to it: one thread (the renderer's) for all residencies of a scheduler.
///             The rest from any thread. The last residency to go ends the scheduler: running reads
///             are waited for, except overdue ones, which end by themselves.
/// Source      Futterlieb, Teutsch & Berndt 2016, section 3.3 (SMOOTH-8); docs/adr.
class LoadScheduler
{
public:
  explicit LoadScheduler(const LoadSchedulerOptions& options);
  ~LoadScheduler();
  LoadScheduler(const LoadScheduler&) = delete;
  LoadScheduler& operator=(const LoadScheduler&) = delete;

  /// The scheduler of this process: it begins with its first user and ends with the last. A child
  /// of fork() has one of its own; stores that its parent opened load nothing there.
  static std::shared_ptr<LoadScheduler> ofProcess();
  /// Its budget, whether it runs or not.
  static void setProcessBudgetBytes(std::size_t bytes);
  static std::size_t processBudgetBytes();

  const std::shared_ptr<MemoryBudget>& budget() const;
  void setBudgetBytes(std::size_t bytes);
  LoadSchedulerStatistics statistics() const;

  /// The memory demand of the views of all stores, in bytes; by it they settle at one error.
  const std::shared_ptr<SharedDemand>& sharedDemand() const { return demand_; }

  // For residencies.

  /// Adds a store, which takes its turn from now on. `points`: its size, for shareOf().
  void join(const std::shared_ptr<StoreNodes>& store, std::uint64_t points);
  /// Removes a store. Returns when none of its nodes is being read, but does not wait for an
  /// overdue read.
  void leave(const std::shared_ptr<StoreNodes>& store);
  /// After each new request: where the system gave no thread to load with, the caller's loads all
  /// that fits. Does nothing otherwise.
  void loadWithoutThreads();
  /// A thread has found no memory for seconds: what is asked for will not come.
  bool starving() const;
  /// The store's points as a share of those of all stores here (SMOOTH-2: sections of the overview
  /// are in proportion to size).
  double shareOf(const StoreNodes& store) const;
  /// Frees the memory that the waiting requests of all stores need, and the memory that this
  /// store's own budget demands. `distance` is kept, and asked again when other stores want room.
  void release(StoreNodes& store, const NodeCache::Distance& distance);

private:
  LoadScheduler(const LoadSchedulerOptions& options, std::shared_ptr<MemoryBudget> budget);
  struct Content;
  const ProcessMark mark_; ///< in a child of fork() there are no threads to tell or to wait for
  const std::shared_ptr<SharedDemand> demand_ = std::make_shared<SharedDemand>();
  std::shared_ptr<Content> content_; ///< shared with threads that hang in a read at the end
};

} // namespace pointfront
