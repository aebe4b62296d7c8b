#pragma once

#include <atomic>
#include <cstdint>

namespace pointfront
{

/// The traffic with far sources in a span of time, as ByteTraffic counts it.
struct TrafficCounts
{
  std::uint64_t requests = 0;
  std::uint64_t bytes = 0;
  std::uint64_t retries = 0;
  std::uint64_t cacheHits = 0;
  std::uint64_t cacheBytes = 0;

  /// Whether a server or the cache was asked at all.
  bool any() const { return requests > 0 || cacheHits > 0; }
  TrafficCounts since(const TrafficCounts& earlier) const
  {
    return { requests - earlier.requests, bytes - earlier.bytes, retries - earlier.retries,
      cacheHits - earlier.cacheHits, cacheBytes - earlier.cacheBytes };
  }
};

/// Counts the bytes that this process has had from far sources so far.
/// Threads  any.
struct ByteTraffic
{
  std::atomic<std::uint64_t> requests{ 0 }; ///< attempts: also those after a fault or a redirect
  std::atomic<std::uint64_t> bytes{ 0 }; ///< all bodies together
  std::atomic<std::uint64_t> retries{ 0 };
  std::atomic<std::uint64_t> cacheHits{ 0 }; ///< reads that the cache on the disk has answered
  std::atomic<std::uint64_t> cacheBytes{ 0 }; ///< all those reads together

  TrafficCounts counts() const { return { requests, bytes, retries, cacheHits, cacheBytes }; }
  static ByteTraffic& ofProcess();
};

} // namespace pointfront
