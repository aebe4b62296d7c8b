#pragma once

#include "pointfront/Base/Result.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace pointfront
{

/// How a COPC export shares its memory out. Points are read and kept, then sorted, then written;
/// what one of the three has needed is free for the next one.
struct COPCMemory
{
  std::uint64_t recordBytes = 0; ///< records that are kept, with their order while they are sorted
  std::uint64_t mergeBytes = 0; ///< buffers of sorted runs
  std::size_t nodeBytes = 0; ///< records of a node before it is compressed while they come
  unsigned threads = 1; ///< nodes that are compressed beside the writing

  /// `memoryBytes`  for all of it
  /// `readBytes`    of the query that brings the points, at least
  /// `width`        bytes of a record
  /// Errors   BadArgument, with the least amount that works.
  static Result<COPCMemory> share(std::uint64_t memoryBytes, std::uint64_t readBytes,
    std::size_t width, unsigned threads, const std::string& path);

  /// The query's part of the memory, unless the query needs more.
  static std::uint64_t ofReading(std::uint64_t memoryBytes) { return memoryBytes / 4; }

  /// Hands memory that is free to the system, which the next step needs in other sizes.
  static void giveBack();
};

} // namespace pointfront
