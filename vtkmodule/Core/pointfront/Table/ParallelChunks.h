#pragma once

#include "pointfront/Base/Result.h"

#include <cstdint>
#include <functional>

namespace pointfront
{

/// The resources for reading through a file when it is opened.
struct SurveyOptions
{
  unsigned threads = 0; ///< 0: one a core
  std::function<bool()> cancelled; ///< asked from any thread; may be empty
};

/// Calls `work` with every number from 0 to `count` - 1, each once, from several threads, lowest
/// first. Ends early with the first Error, or with Cancelled.
Result<void> forEachChunk(std::uint64_t count, const SurveyOptions& options,
  const std::function<Result<void>(std::uint64_t)>& work);

} // namespace pointfront
