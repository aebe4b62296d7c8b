#pragma once

#include "pointfront/Base/Bounds.h"
#include "pointfront/Base/Progress.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Points/PointSink.h"
#include "pointfront/Query/PointQuery.h"
#include "pointfront/Query/QueryBatch.h"
#include "pointfront/Store/Hierarchy.h"
#include "pointfront/Store/NodeReader.h"
#include "pointfront/Store/StoredCloud.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pointfront
{

/// The points of a store that an export writes, and their attributes. All by default.
struct ExportSelection : PointQuery
{
  /// Besides the query's regions: points inside or on this box, world units.
  std::optional<Bounds> box;
  /// Most memory of what is read and not yet written; more only where one node needs more.
  std::size_t memoryBytes = QueryOptions::usualMemoryBytes;
};

struct ExportReport
{
  std::uint64_t pointsRead = 0; ///< decoded
  std::uint64_t pointsWritten = 0; ///< number of those that were selected
};

/// Brings the selected points of a store into a sink.
/// Order      by node, then as inside the node: the same for every run.
/// Exactness  coordinates come out on the store's grid; attributes as they are stored.
/// Memory     ExportSelection::memoryBytes, and the sink's.
/// Errors     of the reader and of the sink; BadArgument of the query, or when the sink would write
///            over a file that the store reads, or when points are missing
///            (StoreDescription::missingPoints); Cancelled. The sink then never finishes, and
///            leaves nothing.
/// Threads    called from one thread, which writes; the process's crew reads meanwhile.
Result<ExportReport> exportPoints(const StoreDescription& store, const Hierarchy& hierarchy,
  const NodeReader& reader, const ExportSelection& selection, PointSink& sink,
  const ProgressFunction& progress = {});

Result<ExportReport> exportStore(const StoredCloud& store, const ExportSelection& selection,
  PointSink& sink, const ProgressFunction& progress = {});

/// The memory that an export takes for reading where memoryBytes is less.
Result<std::size_t> leastExportBytes(const StoredCloud& store, const ExportSelection& selection);

} // namespace pointfront
