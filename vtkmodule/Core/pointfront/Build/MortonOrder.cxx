#include "pointfront/Build/MortonOrder.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace pointfront
{
namespace
{
constexpr unsigned keyBits = 21; // of one axis; 3 * 21 fit a 64-bit key
constexpr unsigned digitBits = 11;
constexpr std::size_t digits = std::size_t(1) << digitBits;

struct KeyedIndex
{
  std::uint64_t key;
  std::uint32_t index;
};

/// Two zero bits before each of the low 21 bits.
std::uint64_t spread(std::uint64_t v)
{
  v &= 0x1fffff;
  v = (v | (v << 32)) & 0x001f00000000ffffull;
  v = (v | (v << 16)) & 0x001f0000ff0000ffull;
  v = (v | (v << 8)) & 0x100f00f00f00f00full;
  v = (v | (v << 4)) & 0x10c30c30c30c30c3ull;
  v = (v | (v << 2)) & 0x1249249249249249ull;
  return v;
}

std::uint64_t keyOf(const TreePosition& p, unsigned shift)
{
  return spread(p.x >> shift) | (spread(p.y >> shift) << 1) | (spread(p.z >> shift) << 2);
}

/// Smallest n such that all records lie in one cell of 2^n steps.
unsigned commonBits(const RecordView& records, std::size_t count)
{
  const TreePosition first = records.position(0);
  TreePosition differ{0};
  for (std::size_t i = 1; i < count; ++i)
  {
    differ |= records.position(i) ^ first;
  }
  return differingBits(differ, TreePosition{0});
}

/// Stable, least significant digit first; digits that all keys share are skipped.
void radixSort(std::vector<KeyedIndex>& items, unsigned bits)
{
  std::vector<KeyedIndex> other(items.size());
  for (unsigned shift = 0; shift < bits; shift += digitBits)
  {
    std::array<std::uint32_t, digits> start{};
    for (const KeyedIndex& item : items)
    {
      ++start[(item.key >> shift) & (digits - 1)];
    }
    if (start[(items.front().key >> shift) & (digits - 1)] == items.size())
    {
      continue;
    }
    std::exclusive_scan(start.begin(), start.end(), start.begin(), std::uint32_t(0));
    for (const KeyedIndex& item : items)
    {
      other[start[(item.key >> shift) & (digits - 1)]++] = item;
    }
    items.swap(other);
  }
}

/// Keys were cut off below their 21st bit: finish runs of equal keys by the whole position.
void sortWithinKeys(std::vector<KeyedIndex>& items, const RecordView& records)
{
  for (auto begin = items.begin(); begin != items.end();)
  {
    const auto end = std::find_if(
      begin + 1, items.end(), [&](const KeyedIndex& item) { return item.key != begin->key; });
    if (end - begin > 1)
    {
      std::stable_sort(begin, end,
        [&](const KeyedIndex& a, const KeyedIndex& b)
        { return mortonLess(records.position(a.index), records.position(b.index)); });
    }
    begin = end;
  }
}
} // namespace

OctreeCell commonCell(const TreePosition& a, const TreePosition& b)
{
  OctreeCell cell;
  cell.log2Side = differingBits(a, b);
  const std::uint32_t mask = cell.log2Side >= 32 ? 0u : ~std::uint32_t(0) << cell.log2Side;
  cell.origin = a & TreePosition(mask);
  return cell;
}

bool mortonLess(const TreePosition& a, const TreePosition& b)
{
  // m ^ n > m & n and so on: the usual test for "the highest bit of m is below that of n".
  const auto lowerTop = [](std::uint32_t m, std::uint32_t n) { return m < n && m < (m ^ n); };
  int axis = 2;
  std::uint32_t differ = a.z ^ b.z;
  if (lowerTop(differ, a.y ^ b.y))
  {
    axis = 1;
    differ = a.y ^ b.y;
  }
  if (lowerTop(differ, a.x ^ b.x))
  {
    axis = 0;
  }
  return a[axis] < b[axis];
}

std::vector<std::uint32_t> mortonOrder(const RecordView& records, std::size_t count)
{
  std::vector<std::uint32_t> order(count);
  if (count == 0)
  {
    return order;
  }
  const unsigned bits = commonBits(records, count);
  const unsigned shift = bits > keyBits ? bits - keyBits : 0;
  std::vector<KeyedIndex> items(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    items[i] = {keyOf(records.position(i), shift), static_cast<std::uint32_t>(i)};
  }
  radixSort(items, 3 * std::min(bits, keyBits));
  if (shift > 0)
  {
    sortWithinKeys(items, records);
  }
  std::transform(
    items.begin(), items.end(), order.begin(), [](const KeyedIndex& item) { return item.index; });
  return order;
}

} // namespace pointfront
