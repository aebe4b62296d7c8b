#pragma once

#include <atomic>
#include <cstdint>

namespace pointfront
{

/// Counts the bytes that this process has had from far sources so far.
/// Threads  any.
struct ByteTraffic
{
  std::atomic<std::uint64_t> requests{ 0 }; ///< attempts: also those after a fault or a redirect
  std::atomic<std::uint64_t> bytes{ 0 }; ///< all bodies together
  std::atomic<std::uint64_t> retries{ 0 };
  std::atomic<std::uint64_t> cacheHits{ 0 }; ///< reads that the cache on the disk has answered
  std::atomic<std::uint64_t> cacheBytes{ 0 }; ///< all those reads together

  static ByteTraffic& ofProcess();
};

} // namespace pointfront
