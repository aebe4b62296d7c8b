#pragma once

#include "pointfront/Base/Error.h"
#include "pointfront/Residency/MemoryBudget.h"
#include "pointfront/Residency/NodeCache.h"
#include "pointfront/Residency/ReleasePlan.h"
#include "pointfront/Residency/Residency.h"
#include "pointfront/Residency/WaitingReads.h"
#include "pointfront/Store/NodeReader.h"

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace pointfront
{

/// One store's part of a LoadScheduler: its nodes in memory, its requests, and the next request.
/// Residency is its interface and documents its guarantees.
/// Rows      of the node table that its front waits for (MissingRows) take turns with nodes, before
///           them: without rows nothing further is asked for, and they are small.
/// Order     that of WaitingReads.
/// Threads   all functions from any thread; its lock is never held while a node is read.
class StoreNodes
{
public:
  struct Task
  {
    NodeIndex node = noNode; ///< none: rows of the node table
    ColumnSelection columns;
    std::size_t bytes = 0; ///< reserved for it
    bool reread = false; ///< the node is or was in memory with other columns
  };
  /// The urgency by which waiting nodes are compared across stores: lower turns first, then larger
  /// priorities (projected errors).
  struct Urgency
  {
    int turn = 0;
    double priority = 0.0;
  };

  /// `budget` is the store's own, a part of the scheduler's.
  StoreNodes(std::shared_ptr<const NodeReader> reader, NodeIndex nodeCount,
    std::shared_ptr<MemoryBudget> budget);
  ~StoreNodes();
  StoreNodes(const StoreNodes&) = delete;
  StoreNodes& operator=(const StoreNodes&) = delete;

  const NodeReader& reader() const { return *reader_; }
  MemoryBudget& budget() const { return *budget_; }

  // The functions that Residency calls.
  bool setColumns(const LayerColumns& columns); ///< false: no change
  LayerColumns columns() const;
  bool request(const std::vector<LoadRequest>& requests); ///< false: no change
  std::shared_ptr<const NodeColumns> find(NodeIndex node);
  ResidencySnapshot::State state(NodeIndex node) const;
  std::uint64_t revision() const { return revision_; }
  std::uint64_t arrivals() const { return arrivals_; }
  bool exhausted() const;
  bool idle() const; ///< nothing is loading, nothing that waits fits
  void setArrivalFunction(std::function<void()> arrived);
  std::vector<Error> takeErrors();
  ResidencyStatistics statistics() const;
  /// The budget has changed: what was too large for it may be no more.
  void reconsider();

  // The functions that the scheduler calls.
  std::optional<Urgency> next() const; ///< urgency of the first that waits and fits
  std::optional<Task> begin(); ///< takes that; none when it does not fit any more
  /// Takes what begin() takes and what lies near it in the file, or else comes behind it, for a
  /// source that is better read so: nodes up to `bytes` in memory or `most` of them, or one page of
  /// rows. `stop` is set when nobody wants any of them any more.
  /// They are added to `tasks`, which has room for `most`; what was added counts as begun even if
  /// this runs out of memory.
  void beginBatch(std::size_t bytes, std::size_t most, const std::shared_ptr<ReadStop>& stop,
    std::vector<Task>& tasks);
  /// A read has ended. True when there is something new: then tell() is called. A node whose read
  /// was Cancelled is as if it had never been asked for.
  bool finish(const Task& task, Result<NodeColumns> result, std::size_t bytesRead);
  /// A read that ended in an exception: the node has failed for lack of memory.
  void abandon(const Task& task);
  void tell();
  void leave(const Task& task); ///< after all: it is no longer loading
  /// Its requests are withdrawn and its nodes leave; nobody is told of anything any more.
  void close();

  std::size_t waitingBytes() const; ///< bytes of requests that do not wait for free memory
  std::size_t stayingBytes() const; ///< in memory or on its way
  void offer(std::uint32_t number, const NodeCache::Distance& distance, ReleasePlan& plan) const;
  using Gone = std::vector<std::shared_ptr<const NodeColumns>>;
  /// Takes a node out; who calls drops the points after all locks.
  void release(NodeIndex node, Gone& gone);
  /// Notes the outcome of the last release; true when that is a change.
  bool noteRelease(bool nothingFound);
  bool loading() const; ///< rows included

private:
  /// Nodes that are read together, and are wanted as long as one of them is.
  struct Batch
  {
    std::vector<NodeIndex> nodes;
    std::weak_ptr<ReadStop> stop;
  };

  std::optional<WaitingReads::Choice> choose() const;
  std::optional<Task> beginNode(const WaitingReads::Choice& choice);
  void stopUnwanted(const std::vector<LoadRequest>& requests);
  void forgetCancelled(const Task& task);
  bool rowsNext(const std::optional<WaitingReads::Choice>& choice) const;
  void countFailed(CachedNode& cached);
  void markFailed(CachedNode& cached, Error error);
  void markLacking(CachedNode& cached);
  void report(Error error);
  void markTooLarge(NodeIndex node, std::size_t bytes, std::size_t limit);
  bool store(const Task& task, NodeColumns points);
  static LoadRequest again(NodeIndex node, const NodeColumns& points, double priority);

  const std::shared_ptr<const NodeReader> reader_;
  MissingRows* const rows_; ///< the reader's, or null
  const NodeIndex nodeCount_;
  /// Shared with the points that are out: they may be dropped after this object is gone.
  const std::shared_ptr<MemoryBudget> budget_;

  mutable std::mutex mutex_; ///< guards all below
  NodeCache cache_;
  WaitingReads waiting_;
  std::vector<Batch> batches_; ///< that may be under way
  std::vector<Error> errors_;
  std::size_t loadingBytes_ = 0;
  std::uint32_t loading_ = 0; ///< nodes
  std::uint32_t loadingRows_ = 0; ///< pages
  bool rowsLast_ = false; ///< the last read that began was for rows
  bool nothingToRelease_ = false; ///< found by the last release that room was wanted from
  bool fileFailed_ = false; ///< told already that the file cannot be read
  std::uint64_t requested_ = 0;
  std::uint64_t cancelled_ = 0;
  std::uint64_t failed_ = 0;
  std::uint64_t released_ = 0;
  std::uint64_t bytesRead_ = 0;

  std::atomic<std::uint64_t> arrivals_{ 0 };
  std::atomic<std::uint64_t> revision_{ 1 };
  std::mutex arrivedMutex_; ///< held while `arrived_` runs
  std::function<void()> arrived_;
};

} // namespace pointfront
