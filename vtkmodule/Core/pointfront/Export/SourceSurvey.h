#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Points/PointSink.h"
#include "pointfront/Points/PointSource.h"

#include <memory>
#include <optional>

namespace pointfront
{

/// Facts that a sink has to know of a source that says little of itself, as points in memory do:
/// the grid that chooseGrid() chooses for it alone, the box of its points and the largest value of
/// each column. Reads all points once.
/// Errors   of reading; of chooseGrid(); BadArgument for a coordinate that is not finite.
/// Threads  one thread.
Result<SinkDescription> surveyed(
  const std::shared_ptr<const PointSource>& source, const std::optional<double>& precision = {});

} // namespace pointfront
