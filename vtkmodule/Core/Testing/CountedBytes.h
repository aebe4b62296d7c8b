#pragma once

#include "pointfront/Disk/ByteOpeners.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace pointfront
{

/// Local files by the addresses "counted://ABSOLUTE/PATH", as a far source would give them: it
/// counts what is asked for. `add()` makes the scheme known to this process.
class CountedBytes final
  : public ByteOpener
  , public std::enable_shared_from_this<CountedBytes>
{
public:
  static std::shared_ptr<CountedBytes> add();
  static std::string addressOf(const std::string& path) { return "counted://" + path; }

  Result<std::shared_ptr<const ByteSource>> open(
    const std::string& address, const FirstBytes& first) const override;

  void reset() { opened = reads = ranges = bytes = 0; }

  mutable std::atomic<std::uint64_t> opened{ 0 };
  mutable std::atomic<std::uint64_t> reads{ 0 }; ///< calls, that is round trips
  mutable std::atomic<std::uint64_t> ranges{ 0 };
  mutable std::atomic<std::uint64_t> bytes{ 0 };
  ReadCost cost; ///< cost of all sources that are opened later
};

} // namespace pointfront
