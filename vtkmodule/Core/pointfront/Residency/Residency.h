#pragma once

#include "pointfront/Base/Error.h"
#include "pointfront/Front/RenderFront.h"
#include "pointfront/Store/NodeReader.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

struct ResidencyOptions
{
  std::size_t budgetBytes = std::size_t(1) << 30; ///< hard: decoded nodes never hold more
  unsigned loaderThreads = 2;
};

struct ResidencyStatistics
{
  std::size_t residentBytes = 0;    ///< decoded nodes in memory, those being decoded included
  std::size_t residentBytesMax = 0; ///< the most there ever was; <= budgetBytes
  std::uint32_t residentNodes = 0;
  std::uint32_t pending = 0;        ///< asked for and not yet begun
  std::uint32_t loading = 0;        ///< being read or decoded now
  std::uint64_t requested = 0;      ///< ever
  std::uint64_t cancelled = 0;      ///< asked for and withdrawn before they were read
  std::uint64_t failed = 0;
  std::uint64_t released = 0;
  std::uint64_t bytesRead = 0;      ///< from the disk
};

/// Decoded nodes of one store in host memory, under one hard budget; loader threads bring in
/// what is asked for (FRONT-9) and what is farthest under the front is released first (FRONT-10).
/// Threads     request(), find(), ... are called by one thread (the renderer's); loader threads are
///             its own. Destruction joins them; a running read is waited for, a waiting one
///             dropped.
/// Guarantees  residentBytes <= budgetBytes always: room is made, or reserved by its
///             decodedBytes(), before a read begins. find() never blocks on the disk.
/// Errors      a node that cannot be read is Failed for good; its Error is reported once by
///             takeErrors().
class Residency
{
public:
  Residency(
    std::shared_ptr<const NodeReader> reader, NodeIndex nodeCount, ResidencyOptions options);
  ~Residency();
  Residency(const Residency&) = delete;
  Residency& operator=(const Residency&) = delete;

  /// Columns that every node must have from now on. Nodes with other columns are read again
  /// (they stay until their replacement is there).
  void setColumns(const ColumnSelection& columns);
  ColumnSelection columns() const;

  /// Replaces the wish list: what is not in it and not yet begun is cancelled.
  void request(const std::vector<LoadRequest>& requests);

  /// Frees memory for what is requested: nodes by distance under the front, farthest first, two
  /// passes (count, release). Nodes of distance 0 stay. `distance` is asked for resident nodes
  /// only.
  void release(const std::function<std::uint32_t(NodeIndex)>& distance);

  /// The node's points, or null. The pointer keeps them alive after a release (and within the
  /// budget's account).
  std::shared_ptr<const NodeColumns> find(NodeIndex node) const;
  ResidencyView::State state(NodeIndex node) const;

  /// Called from a loader thread after a node arrived or failed. Keep it short. Null to unset.
  void setArrivalFunction(std::function<void()> arrived);
  /// Grows with every arrival or failure: a cheap "is there something new".
  std::uint64_t arrivals() const;

  /// Blocks until nothing is pending or loading (complete renders, tests).
  void waitUntilIdle() const;
  /// Blocks until arrivals() differs from `seen`, or nothing is pending or loading.
  void waitForArrival(std::uint64_t seen) const;

  std::vector<Error> takeErrors();
  ResidencyStatistics statistics() const;
  void setBudgetBytes(std::size_t bytes);

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace pointfront
