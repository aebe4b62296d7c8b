#pragma once

#include "pointfront/Base/Result.h"

#include <cstddef>
#include <cstdint>

namespace pointfront
{

/// The sizes by which a build divides its memory.
struct BuildSize
{
  std::uint64_t points = 0; ///< at most
  std::uint64_t largestChunk = 0; ///< points of the largest chunk of any source
  std::size_t recordBytes = 0;
  std::size_t partBytes = 0; ///< for each point of a part, beyond what every tree needs
  std::size_t blockBytes = 0; ///< for each point of a block, beyond what every tree needs
  std::uint64_t tableBytes = 0; ///< for each thread that reads, to count the points of cells
  std::uint64_t wholePart = 0; ///< points of parts that cannot be cut smaller; 0: there are none
  std::size_t sourceBytes = 0; ///< largest size of a point in a source's batch
  std::uint32_t nodePoints = 0;
  unsigned threads = 1; ///< wanted
  std::uint64_t memoryBytes = 0; ///< allowed
};

/// How the memory is divided. Only speed depends on it, never a byte of the store.
struct MemoryPlan
{
  bool spill = false; ///< records go to disk
  unsigned threads = 1; ///< those wanted, or fewer when memory is short
  std::uint64_t blockPoints = 0; ///< records read and sorted by cells at a time, by each thread
  std::uint64_t partPoints = 0; ///< largest part built at a time, by each thread
  /// Parts read from the disk before a thread wants them, by all threads; 0 without a spill.
  std::uint64_t partsAhead = 0;
};

/// Error NoMemory, with the least that would do, when even one thread has too little.
Result<MemoryPlan> planMemory(const BuildSize& size);

} // namespace pointfront
