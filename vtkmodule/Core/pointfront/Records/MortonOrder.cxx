#include "pointfront/Records/MortonOrder.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>

namespace pointfront
{
namespace
{
constexpr unsigned mostAxisBits = 21; // 3 * 21 fit a 64-bit key
constexpr unsigned mostDigitBits = 11;
constexpr std::size_t mostDigits = std::size_t(1) << mostDigitBits;

/// Two zero bits before each bit of a byte.
constexpr std::array<std::uint32_t, 256> makeSpreadBytes()
{
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < table.size(); ++byte)
  {
    for (unsigned bit = 0; bit < 8; ++bit)
    {
      table[byte] |= ((byte >> bit) & 1u) << (3 * bit);
    }
  }
  return table;
}
constexpr std::array<std::uint32_t, 256> spreadBytes = makeSpreadBytes();

/// Two zero bits before each of the low 21 bits.
std::uint64_t spread(std::uint32_t v)
{
  return spreadBytes[v & 0xffu] | std::uint64_t(spreadBytes[(v >> 8) & 0xffu]) << 24 |
    std::uint64_t(spreadBytes[(v >> 16) & 0x1fu]) << 48;
}

std::uint64_t keyOf(const TreePosition& p, unsigned shift)
{
  return spread(p.x >> shift) | (spread(p.y >> shift) << 1) | (spread(p.z >> shift) << 2);
}

/// Smallest n such that all records lie in one cell of 2^n steps.
unsigned commonBits(const RecordSpan& records, std::size_t count)
{
  const TreePosition first = records.position(0);
  TreePosition differ{ 0 };
  for (std::size_t i = 1; i < count; ++i)
  {
    differ |= records.position(i) ^ first;
  }
  return differingBits(differ, TreePosition{ 0 });
}

unsigned bitsFor(std::uint64_t largest)
{
  return largest == 0 ? 0u : 64u - static_cast<unsigned>(__builtin_clzll(largest));
}

/// Keys and indices share one word: the highest bits of the key that fit above the index. Half the
/// bytes to move, and equal keys stay in the order of their indices.
struct WordLayout
{
  unsigned axisShift = 0; ///< bits of an axis below its key
  unsigned keyShift = 0; ///< bits of the key that do not fit
  unsigned keyBits = 0; ///< that do
  unsigned indexBits = 0;

  WordLayout(unsigned axisBits, std::size_t count)
    : axisShift(axisBits > mostAxisBits ? axisBits - mostAxisBits : 0)
    , indexBits(bitsFor(count - 1))
  {
    const unsigned all = 3 * (axisBits - axisShift);
    keyBits = std::min(all, 64 - indexBits);
    keyShift = all - keyBits;
  }
  bool whole() const { return axisShift == 0 && keyShift == 0; }
  std::uint64_t word(const TreePosition& p, std::size_t i) const
  {
    return (keyOf(p, axisShift) >> keyShift) << indexBits | i;
  }
  std::uint32_t index(std::uint64_t word) const
  {
    return static_cast<std::uint32_t>(word & ((std::uint64_t(1) << indexBits) - 1));
  }
};

/// Stable, by `bits` bits from `lowest` up, least significant digit first.
void radixSort(std::vector<std::uint64_t>& words, unsigned lowest, unsigned bits)
{
  const unsigned passes = (bits + mostDigitBits - 1) / mostDigitBits;
  if (passes == 0)
  {
    return;
  }
  const unsigned digitBits = (bits + passes - 1) / passes;
  const std::uint64_t mask = (std::uint64_t(1) << digitBits) - 1;
  // Starts of all digits in one pass over the words; the highest may reach above the key: zeros.
  std::vector<std::array<std::uint32_t, mostDigits>> starts(passes);
  for (const std::uint64_t word : words)
  {
    std::uint64_t key = word >> lowest;
    for (unsigned pass = 0; pass < passes; ++pass, key >>= digitBits)
    {
      ++starts[pass][key & mask];
    }
  }
  std::vector<std::uint64_t> other(words.size());
  for (unsigned pass = 0; pass < passes; ++pass)
  {
    const unsigned shift = lowest + pass * digitBits;
    std::array<std::uint32_t, mostDigits>& start = starts[pass];
    if (start[(words.front() >> shift) & mask] == words.size())
    {
      continue; // all share it
    }
    std::exclusive_scan(start.begin(), start.end(), start.begin(), std::uint32_t(0));
    for (const std::uint64_t word : words)
    {
      other[start[(word >> shift) & mask]++] = word;
    }
    words.swap(other);
  }
}

/// Finishes runs that are equal from `lowest` up: few and short, unless points are equal.
template <typename Less>
void sortRuns(std::vector<std::uint64_t>& words, unsigned lowest, const Less& less)
{
  for (auto begin = words.begin(); begin != words.end();)
  {
    auto end = begin + 1;
    while (end != words.end() && ((*begin ^ *end) >> lowest) == 0)
    {
      ++end;
    }
    if (end - begin > 1)
    {
      std::sort(begin, end, less);
    }
    begin = end;
  }
}

/// Bits of the key that tell most neighbours of a surface apart: an octree level for each factor of
/// four, and two more. The rest is for sortRuns(), and so is a level that would take a digit more.
unsigned tellingBits(std::size_t count)
{
  constexpr unsigned level = 3;
  const unsigned bits = level * ((bitsFor(count) + 1) / 2) + 2 * level;
  const unsigned beyond = bits % mostDigitBits;
  return beyond <= level ? bits - beyond : bits;
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

std::vector<std::uint32_t> mortonOrder(const RecordSpan& records, std::size_t count)
{
  std::vector<std::uint32_t> order(count);
  if (count == 0)
  {
    return order;
  }
  const WordLayout layout(commonBits(records, count), count);
  std::vector<std::uint64_t> words(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    words[i] = layout.word(records.position(i), i);
  }
  const unsigned sorted = std::min(layout.keyBits, tellingBits(count));
  const unsigned lowest = layout.indexBits + layout.keyBits - sorted;
  radixSort(words, lowest, sorted);
  if (layout.whole())
  {
    sortRuns(words, lowest, std::less<>());
  }
  else
  {
    const auto less = [&](std::uint64_t a, std::uint64_t b)
    {
      if ((a ^ b) >> layout.indexBits != 0)
      {
        return a < b;
      }
      const TreePosition p = records.position(layout.index(a));
      const TreePosition q = records.position(layout.index(b));
      return p == q ? a < b : mortonLess(p, q);
    };
    sortRuns(words, lowest, less);
  }
  std::transform(words.begin(), words.end(), order.begin(),
    [&](std::uint64_t word) { return layout.index(word); });
  return order;
}

} // namespace pointfront
