#pragma once

#include "pointfront/Base/Error.h"
#include "pointfront/Front/RenderFront.h"
#include "pointfront/Store/LayerColumns.h"
#include "pointfront/Store/NodeReader.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace pointfront
{

class LoadScheduler;
class StoreNodes;

/// Options of a residency with a scheduler of its own.
struct ResidencyOptions
{
  std::size_t budgetBytes = std::size_t(1) << 30; ///< hard: decoded nodes never hold more
  unsigned loaderThreads = 2;
};

struct ResidencyStatistics
{
  std::size_t residentBytes = 0; ///< decoded nodes in memory, those being decoded included
  std::size_t residentBytesMax = 0; ///< the most there ever was; <= budgetBytes
  std::uint32_t residentNodes = 0;
  std::uint32_t pending = 0; ///< asked for and not yet begun, re-reads included
  std::uint32_t loading = 0; ///< being read or decoded now
  std::uint64_t requested = 0; ///< ever
  std::uint64_t cancelled = 0; ///< asked for and withdrawn before they were read
  std::uint64_t failed = 0;
  std::uint64_t released = 0;
  std::uint64_t bytesRead = 0; ///< from the disk
};

/// Decoded nodes of one store in host memory, under two hard budgets: the store's own and that of
/// its scheduler. The scheduler loads requested nodes (FRONT-9), and releases first the nodes
/// farthest under the fronts of all its stores (FRONT-10).
/// Order       needed requests by priority, then re-reads for new columns, then optional requests;
///             a request that does not fit waits, smaller ones behind it go on. Nodes that are
///             drawn (found) with old columns are read again before everything else.
/// Threads     request(), release(), find(), ... are called by one thread (the renderer's), the
///             same for all residencies of a scheduler. Destruction withdraws what waits, waits for
///             a running read (not for one that hangs) and gives the memory back.
/// Guarantees  residentBytes <= the budgets always: room is made, or reserved by its
///             decodedBytes(), before a read begins. find() never blocks on the disk. A node that
///             was released while somebody holds its points stays on the account until they
///             are dropped. After setBudgetBytes() to less than is held nothing is loaded
///             until release() has come down to it.
/// Errors      a node that cannot be read is Failed for good (for these columns); one that is
///             larger than the whole budget is Failed until the budget grows. Each is
///             reported once by takeErrors(); a file that cannot be read once for all its nodes.
class Residency final : public ResidencySnapshot
{
public:
  /// One of several stores of a scheduler. Its own budget is without limit until setBudgetBytes().
  Residency(std::shared_ptr<const NodeReader> reader, NodeIndex nodeCount,
    std::shared_ptr<LoadScheduler> scheduler, std::uint64_t points = 0);
  /// With a scheduler of its own.
  Residency(
    std::shared_ptr<const NodeReader> reader, NodeIndex nodeCount, ResidencyOptions options);
  ~Residency() override;
  Residency(const Residency&) = delete;
  Residency& operator=(const Residency&) = delete;

  /// Columns that every node must have from now on. Nodes that lack one are read again; they stay
  /// until their replacement is there, unless the budget has room for one of the two only.
  void setColumns(const ColumnSelection& columns) { setLayerColumns(columns); }
  /// The same for each layer: nodes of one are read with its columns only.
  void setLayerColumns(const LayerColumns& columns);
  LayerColumns layerColumns() const;
  ColumnSelection columns() const { return layerColumns().any(); }

  /// Replaces the wish list: requests that are not in it and not yet begun are cancelled.
  void request(const std::vector<LoadRequest>& requests);

  /// Frees memory for requests that do not fit (not for optional ones). It releases nodes by
  /// distance under the front, farthest first, in two passes (count, release); nodes of distance 0
  /// stay. `distance` is called for resident nodes only and must not call this object; it is kept
  /// until the next call, and called again when other stores of the scheduler want room. Costs
  /// nothing while everything fits; call it after each request().
  void release(const std::function<std::uint32_t(NodeIndex)>& distance);

  /// The node's points, or null. The pointer keeps them alive after a release (and within the
  /// budget's account).
  std::shared_ptr<const NodeColumns> find(NodeIndex node) const;
  State state(NodeIndex node) const override;
  /// Grows with every arrival, failure and release; never 0.
  std::uint64_t revision() const override;
  /// True when nothing is loading, no needed request that waits fits, and the last release()
  /// found nothing that it could have freed.
  bool exhausted() const override;

  /// Called from a loader thread after a node arrived or failed. Keep it short; it must not call
  /// this function nor destroy this object. Null to unset: it is not running any more then.
  void setArrivalFunction(std::function<void()> arrived);
  /// Grows with every arrival or failure: a cheap "is there something new".
  std::uint64_t arrivals() const;

  /// Blocks until nothing is loading and no waiting request fits (complete renders, tests).
  void waitUntilIdle() const;
  /// Blocks until arrivals() differs from `seen`, or as waitUntilIdle().
  void waitForArrival(std::uint64_t seen) const;
  /// The same, at most that long.
  void waitForArrival(std::uint64_t seen, std::chrono::milliseconds most) const;

  /// Nothing is loading and nothing that waits fits.
  bool idle() const;

  std::vector<Error> takeErrors();
  ResidencyStatistics statistics() const;
  /// Sets the store's own budget; that of the scheduler holds too.
  void setBudgetBytes(std::size_t bytes);
  /// The lower one of the store's budget and the scheduler's.
  std::size_t budgetBytes() const;
  /// This store's points as a share of the points of all stores of the scheduler, for budgets that
  /// are shared in proportion to size (SMOOTH-2).
  double shareOfAll() const;
  LoadScheduler& scheduler() const { return *scheduler_; }

private:
  std::shared_ptr<LoadScheduler> scheduler_;
  std::shared_ptr<StoreNodes> nodes_;
};

} // namespace pointfront
