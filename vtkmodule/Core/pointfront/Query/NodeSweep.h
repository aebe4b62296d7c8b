#pragma once

#include "pointfront/Query/QueryBatch.h"
#include "pointfront/Store/NodeReader.h"

#include <functional>

namespace pointfront
{

/// Nodes that are read one after the other, and the function that chooses the result of each.
struct NodeSweep
{
  std::size_t count = 0;
  ColumnSelection columns; ///< to read
  std::size_t resultBytes = 0; ///< at most, of one point of a result
  std::function<NodeIndex(std::size_t)> node;
  std::function<std::uint32_t(std::size_t)> points; ///< the node's points, as its row says
  /// Chooses. From any thread of the crew, several at once.
  std::function<QueryBatch(std::size_t, NodeColumns&&)> choose;
};

/// Reads the nodes on a crew of threads and hands the results over in their order; empty ones are
/// left out. While some are handed over, the next ones are read.
/// Order    the same calls of `consume` with the same batches for any number of threads.
/// Memory   at most options.memoryBytes; as many nodes at once as that allows.
/// Errors   of the reader (the first node's in order), of `consume`; NoMemory where one node alone
///          needs more than the budget; Cancelled. What came before was handed over.
/// Threads  `consume` and options.progress on the caller's thread.
Result<QueryReport> sweepNodes(const NodeReader& reader, const NodeSweep& sweep,
  const QueryOptions& options, const QueryConsumer& consume);

/// The budget below which some node alone is NoMemory.
std::size_t leastSweepBytes(const NodeReader& reader, const NodeSweep& sweep);

} // namespace pointfront
