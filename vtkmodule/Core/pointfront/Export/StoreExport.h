#pragma once

#include "pointfront/Base/Bounds.h"
#include "pointfront/Base/Progress.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Points/PointSink.h"
#include "pointfront/Store/Hierarchy.h"
#include "pointfront/Store/NodeReader.h"
#include "pointfront/Store/StoredCloud.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace pointfront
{

/// Which points of a store to bring out. All by default.
struct ExportSelection
{
  /// Points inside or on this box, world units.
  std::optional<Bounds> box;
  /// Points whose `classification` is one of these; empty: of any class.
  std::vector<std::uint8_t> classes;
  /// World units between neighbouring points: a branch is followed down until its nodes are at
  /// least this dense and no further, so the result is as dense as asked or a little denser,
  /// never coarser (where the store has that much). 0: all points of the input.
  /// Of a store with mean representatives these come out where they are dense enough, with their
  /// enclosing radius, and nothing of what they stand for.
  double spacing = 0.0;
};

struct ExportReport
{
  std::uint64_t pointsRead = 0;    ///< decoded
  std::uint64_t pointsWritten = 0; ///< of those, selected
};

/// Brings the selected points of a store into a sink.
/// Order      by node, then as inside the node: the same for every run.
/// Exactness  coordinates come out on the store's grid; attributes as they are stored.
/// Memory     two nodes: one is decoded while the other is written.
/// Errors     of the reader and of the sink; BadArgument when classes are asked of a store without
///            `classification`, or when the sink would write over a file that the store reads;
///            Cancelled. The sink then never finishes, and leaves nothing.
/// Threads    called from one thread; decodes on one of its own.
Result<ExportReport> exportPoints(const StoreDescription& store, const Hierarchy& hierarchy,
  const NodeReader& reader, const ExportSelection& selection, PointSink& sink,
  const ProgressFunction& progress = {});

Result<ExportReport> exportStore(const StoredCloud& store, const ExportSelection& selection,
  PointSink& sink, const ProgressFunction& progress = {});

} // namespace pointfront
