#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace pointfront
{

/// Where a long operation stands. Sent from one thread at a time, at most some ten times a second.
struct Progress
{
  const char* phase = ""; ///< "reading", "building", "writing", "verifying" ...
  std::uint64_t done = 0; ///< points of this phase handled so far
  std::uint64_t total = 0; ///< points of this phase, 0 if not known yet
  double fraction = 0.0; ///< part of the whole operation that is done, 0 to 1, never falls
  double secondsElapsed = 0.0; ///< since the operation began
  std::string notice = {}; ///< a sentence that cannot wait for the end; empty: none
};

/// Returns false to cancel: the operation then ends with Error::Kind::Cancelled and leaves nothing.
using ProgressFunction = std::function<bool(const Progress&)>;

} // namespace pointfront
