#pragma once

#include "pointfront/Points/PointSource.h"

#include <cstddef>
#include <functional>

namespace pointfront
{

class ThreadCrew;

struct ScanOptions
{
  static constexpr std::size_t usualMemoryBytes = std::size_t(256) << 20;
  /// Memory for batches that are held at once: fewer threads read if all threads would need more.
  /// One batch is always read.
  std::size_t memoryBytes = usualMemoryBytes;
  ThreadCrew* crew = nullptr; ///< null: the process's
};

ThreadCrew& crewOf(const ScanOptions& options);

/// Reads every chunk of a source once and gives it to `work`, with the number of the thread that
/// does it: below crewOf(options).threads(). The order is not fixed: the results must not depend on
/// it.
/// Errors  of the source: that of the first chunk that has one.
Result<void> scanBatches(const PointSource& source, const ScanOptions& options,
  const std::function<void(const PointBatch& batch, unsigned thread)>& work);

} // namespace pointfront
