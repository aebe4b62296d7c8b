#pragma once

#include "pointfront/Base/Progress.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Points/PointBatch.h"
#include "pointfront/Store/Hierarchy.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace pointfront
{

class ThreadCrew;

/// Chosen points of one node, in the node's order.
/// Shapes  ids[n] are numbers in the store: (node, position in the node), as picking and the
/// reader's
///         overview give them; positions[n] world coordinates; columns as QueryPlan::schema().
struct QueryBatch
{
  NodeIndex node = noNode;
  std::vector<std::uint64_t> ids;
  PointBatch points;

  std::size_t size() const { return ids.size(); }
  /// Host memory held.
  std::size_t bytes() const;
};

/// Takes a batch; it may move its content away. An Error ends the query, which gives it.
using QueryConsumer = std::function<Result<void>(QueryBatch&)>;

struct QueryOptions
{
  static constexpr std::size_t usualMemoryBytes = std::size_t(256) << 20;
  /// Most host memory of nodes and results that are not yet handed over.
  std::size_t memoryBytes = usualMemoryBytes;
  ThreadCrew* crew = nullptr; ///< null: the process's
  /// Called on the caller's thread; `total` counts points that are decoded.
  ProgressFunction progress;
  const char* phase = "reading";
};

/// The cost of a query.
struct QueryReport
{
  std::uint64_t nodesRead = 0;
  std::uint64_t bytesRead = 0; ///< from the disk
  std::uint64_t pointsRead = 0; ///< decoded
  std::uint64_t pointsChosen = 0; ///< number of these points that were handed over
  std::size_t peakBytes = 0; ///< most memory that was set aside at once
};

} // namespace pointfront
