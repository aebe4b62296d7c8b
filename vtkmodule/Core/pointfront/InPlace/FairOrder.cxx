#include "pointfront/InPlace/FairOrder.h"

#include "pointfront/InPlace/SampleStream.h"
#include "pointfront/Trees/PrefixOrder.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <utility>

namespace pointfront
{
namespace
{
/// Ten bits of a number, two zeros between each and the next.
std::uint64_t spread(std::uint64_t bits)
{
  bits = (bits | bits << 16) & 0x30000ffull;
  bits = (bits | bits << 8) & 0x300f00full;
  bits = (bits | bits << 4) & 0x30c30c3ull;
  return (bits | bits << 2) & 0x9249249ull;
}

/// Numbers of the keys, by key, equal ones by number. Keys of 30 bits; three passes over the bits
/// are faster than comparing (the first picture waits for this).
std::vector<std::uint32_t> sortedByKey(const std::vector<std::uint32_t>& keys)
{
  constexpr unsigned digitBits = 10;
  constexpr std::uint32_t mask = (1u << digitBits) - 1;
  std::vector<std::uint32_t> order(keys.size());
  std::iota(order.begin(), order.end(), 0u);
  std::vector<std::uint32_t> next(keys.size());
  for (unsigned shift = 0; shift < 3 * digitBits; shift += digitBits)
  {
    std::array<std::uint32_t, mask + 2> begin{}; // first of each digit in `next`
    for (const std::uint32_t key : keys)
    {
      ++begin[(key >> shift & mask) + 1];
    }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    for (const std::uint32_t number : order)
    {
      next[begin[keys[number] >> shift & mask]++] = number;
    }
    order.swap(next);
  }
  return order;
}
} // namespace

std::vector<std::uint32_t> fairOrder(
  const std::vector<GridPosition>& steps, const GridPosition& low, const GridPosition& high)
{
  constexpr unsigned bits = 10;
  const GridPosition extent = high - low;
  unsigned shift = 0;
  while ((std::max({ extent.x, extent.y, extent.z }) >> shift) >= (1 << bits))
  {
    ++shift;
  }
  std::vector<std::uint32_t> along(steps.size()); // places on the curve
  std::transform(steps.begin(), steps.end(), along.begin(),
    [&](const GridPosition& step)
    {
      const GridPosition p = step - low;
      return static_cast<std::uint32_t>(spread(std::uint64_t(p.x) >> shift) |
        spread(std::uint64_t(p.y) >> shift) << 1 | spread(std::uint64_t(p.z) >> shift) << 2);
    });
  std::vector<NumberedHash> hashes;
  hashes.reserve(steps.size());
  for (const std::uint32_t point : sortedByKey(along))
  {
    hashes.push_back({ point, static_cast<std::uint32_t>(SampleStream::mixed(point) >> 32) });
  }
  return prefixBatches(std::move(hashes));
}

} // namespace pointfront
