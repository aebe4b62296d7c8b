#pragma once

#include "pointfront/Disk/ByteOpeners.h"

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace pointfront
{

/// Local files by the addresses "counted://ABSOLUTE/PATH", as a far source would give them: it
/// counts what is asked for, and takes the time that a line would. `add()` makes the scheme known
/// to this process.
/// First bytes  come with the answer that opens a file and cost no round trip later; a file that is
///              open already is the same source for the next who opens it.
/// Requests     ranges of one read that lie side by side are one, and so are ranges with a gap that
///              takes less time than a request: `mergeGapBytes`, which comes over the line, too.
class CountedBytes final
  : public ByteOpener
  , public std::enable_shared_from_this<CountedBytes>
{
public:
  using Clock = std::chrono::steady_clock;

  static std::shared_ptr<CountedBytes> add();
  static std::string addressOf(const std::string& path) { return "counted://" + path; }

  Result<std::shared_ptr<const ByteSource>> open(
    const std::string& address, const FirstBytes& first) const override;

  void reset() { opened = reads = ranges = requests = bytes = readsAtOnceMost = 0; }
  /// Opens and reads: each is a round trip, if none goes beside another.
  std::uint64_t rounds() const { return opened + reads; }

  mutable std::atomic<std::uint64_t> opened{ 0 }; ///< files
  mutable std::atomic<std::uint64_t> reads{ 0 }; ///< calls that the first bytes did not answer
  mutable std::atomic<std::uint64_t> ranges{ 0 };
  mutable std::atomic<std::uint64_t> requests{ 0 };
  mutable std::atomic<std::uint64_t> bytes{ 0 }; ///< that come over the line
  mutable std::atomic<std::uint64_t> readsAtOnceMost{ 0 };
  bool firstBytes = true; ///< false: they cost a read when they are asked for
  ReadCost cost; ///< cost of all sources that are opened later

  // The line; 0: takes no time.
  std::chrono::duration<double> roundTrip{ 0.0 };
  double bytesPerSecond = 0.0; ///< all reads share it
  std::size_t mergeGapBytes = 0;
  /// Reads that touch this byte of a file wait until their stop is set; none: no byte.
  std::atomic<std::uint64_t> hangAt{ UINT64_MAX };

  /// Takes the time that a request for so many bytes takes.
  void transfer(std::size_t size) const;

private:
  mutable std::mutex mutex_; ///< guards all below
  mutable Clock::time_point lineFree_;
  mutable std::map<std::string, std::weak_ptr<const ByteSource>> open_;
};

} // namespace pointfront
