#pragma once

#include "pointfront/Base/Progress.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Points/PointSink.h"
#include "pointfront/Points/PointSource.h"

#include <cstdint>

namespace pointfront
{

/// Writes all points of a source to a sink, chunk by chunk in the source's order: a made-up survey
/// to a file, for example. Returns the number of points.
/// Errors   of both; BadArgument for a source without a grid of integers; Cancelled. The sink then
///          never finishes, and leaves nothing.
/// Threads  called from one thread; makes the next chunk on one of its own.
Result<std::uint64_t> exportSource(
  const PointSource& source, PointSink& sink, const ProgressFunction& progress = {});
/// The same for a source of which the caller knows more than it says: `told` is what the sink is
/// told (SourceSurvey.h). Its schema is the source's.
Result<std::uint64_t> exportSource(const PointSource& source, const SinkDescription& told,
  PointSink& sink, const ProgressFunction& progress = {});

} // namespace pointfront
