#pragma once

#include <algorithm>
#include <cstdint>

namespace pointfront
{

/// The number of values, and the smallest and largest of them, as keys (ValueKey.h).
/// Order  the same for any order and any grouping of the values.
struct ValueSpan
{
  std::uint64_t count = 0; ///< finite ones
  std::uint64_t notANumber = 0;
  std::uint64_t infinite = 0;
  std::uint64_t low = UINT64_MAX; ///< lowest of the finite ones
  std::uint64_t high = 0;

  void add(std::uint64_t key)
  {
    ++count;
    low = std::min(low, key);
    high = std::max(high, key);
  }
  void add(const ValueSpan& other)
  {
    count += other.count;
    notANumber += other.notANumber;
    infinite += other.infinite;
    low = std::min(low, other.low);
    high = std::max(high, other.high);
  }
};

} // namespace pointfront
