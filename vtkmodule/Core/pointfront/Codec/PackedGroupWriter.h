#pragma once

#include "pointfront/Codec/PackedGroup.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace pointfront
{
namespace packed
{

/// Bytes that a group takes at most.
template <typename T>
constexpr std::size_t mostGroupBytes = 2 + rowBytes* bitsOf<T>;
/// Bytes behind a group that writing it may change: upper parts are written as whole words.
constexpr std::size_t writtenBeyond = 8;

template <typename T>
unsigned bitLength(T code)
{
  return code == 0 ? 0u : 64u - static_cast<unsigned>(__builtin_clzll(code));
}

using GroupLengths = std::array<std::uint8_t, codesPerGroup>;

/// Bits of each code of more than a byte. Loops that the compiler turns into vectors: the exponent
/// of a float for 16 and 32 bits.
template <typename T>
void bitLengths(const CodeGroup<T>& codes, GroupLengths& lengths)
{
  static_assert(sizeof(T) > 1, "bytes are compared as they are");
  if constexpr (sizeof(T) == 8)
  {
    for (std::size_t i = 0; i < codesPerGroup; ++i)
    {
      lengths[i] = static_cast<std::uint8_t>(bitLength(codes[i]));
    }
  }
  else
  {
    std::array<std::int32_t, codesPerGroup> wide; // NOLINT: filled below
    for (std::size_t i = 0; i < codesPerGroup; ++i)
    {
      const std::uint32_t code = codes[i];
      // Without the bit below its highest, a code is not rounded up to the next power of two;
      // one of 32 bits becomes -2^31.
      const auto top = static_cast<std::uint32_t>(static_cast<std::int32_t>(code) >> 31);
      const std::uint32_t cut = code & ~(code >> 1);
      const auto whole = static_cast<std::int32_t>((cut & ~top) | (top & 0x80000000u));
      const auto rounded = static_cast<float>(whole);
      std::uint32_t bits;
      std::memcpy(&bits, &rounded, sizeof(bits));
      const auto length = static_cast<std::int32_t>((bits >> 23) & 0xffu) - 126;
      wide[i] = length < 0 ? 0 : length; // zero has the exponent 0
    }
    for (std::size_t i = 0; i < codesPerGroup; ++i)
    {
      lengths[i] = static_cast<std::uint8_t>(wide[i]);
    }
  }
}

// --- the width of a group: the one that takes the fewest bytes, exceptions counted.

struct GroupPlan
{
  unsigned width = 0;
  unsigned exceptions = 0; ///< codes of more than `width` bits
  unsigned exceptionBytes = 0; ///< size of the upper part of each
  std::size_t bytes = 0;
};

/// How many codes need more than n bits, for each n.
using LongerThan = std::array<std::uint16_t, 65>;

/// In four tables: the same counter twice in a row would wait for itself.
inline void countLonger(const GroupLengths& lengths, unsigned longest, LongerThan& longer)
{
  std::array<std::array<std::uint8_t, 72>, 4> counts{};
  for (std::size_t i = 0; i < codesPerGroup; i += 4)
  {
    ++counts[0][lengths[i]];
    ++counts[1][lengths[i + 1]];
    ++counts[2][lengths[i + 2]];
    ++counts[3][lengths[i + 3]];
  }
  unsigned sum = 0;
  for (unsigned length = longest; length > 0; --length)
  {
    sum += counts[0][length] + counts[1][length] + counts[2][length] + counts[3][length];
    longer[length - 1] = static_cast<std::uint16_t>(sum);
  }
}

/// Counts bytes by eight comparisons of each: the fewest operations in vectors.
inline void countLonger(const CodeGroup<std::uint8_t>& codes, LongerThan& longer)
{
  for (unsigned bit = 0; bit < 8; ++bit)
  {
    std::array<std::uint8_t, 16> sums{};
    const auto least = static_cast<std::uint8_t>(1u << bit);
    for (std::size_t i = 0; i < codesPerGroup; i += sums.size())
    {
      for (std::size_t lane = 0; lane < sums.size(); ++lane)
      {
        sums[lane] = static_cast<std::uint8_t>(sums[lane] + (codes[i + lane] >= least ? 1 : 0));
      }
    }
    unsigned sum = 0;
    for (const std::uint8_t lane : sums)
    {
      sum += lane;
    }
    longer[bit] = static_cast<std::uint16_t>(sum);
  }
}

/// `longer` is filled below `longest`.
inline GroupPlan planOf(unsigned longest, const LongerThan& longer)
{
  GroupPlan best{ longest, 0, 0, 2 + rowBytes * longest };
  for (unsigned width = longest; width-- > 0;)
  {
    const unsigned upperBytes = (longest - width + 7) / 8;
    const std::size_t exceptionBytes = 3 + longer[width] * std::size_t(1 + upperBytes);
    if (exceptionBytes >= best.bytes)
    {
      break; // and those of smaller widths are no fewer
    }
    if (exceptionBytes + rowBytes * width < best.bytes)
    {
      best = { width, longer[width], upperBytes, exceptionBytes + rowBytes * width };
    }
  }
  return best;
}

template <typename T>
unsigned longestOf(const CodeGroup<T>& codes)
{
  T any = 0;
  for (const T code : codes)
  {
    any = static_cast<T>(any | code);
  }
  return bitLength(any);
}

/// `lengths` is filled unless the codes are bytes.
template <typename T>
GroupPlan planOf(const CodeGroup<T>& codes, GroupLengths& lengths)
{
  const unsigned longest = longestOf<T>(codes);
  if (longest == 0)
  {
    return { 0, 0, 0, 2 }; // flags and classes are the same for long runs
  }
  LongerThan longer; // NOLINT: filled as far as it is read
  if constexpr (sizeof(T) == 1)
  {
    countLonger(codes, longer);
  }
  else
  {
    bitLengths<T>(codes, lengths);
    countLonger(lengths, longest, longer);
  }
  return planOf(longest, longer);
}

/// As unpackRows() reads them, for any width: the 16 bytes of a row are two words of 64 bits, each
/// shifted as a whole and masked in every lane.
template <typename T>
void packRows(const CodeGroup<T>& codes, unsigned width, std::byte* rows)
{
  constexpr std::size_t lanes = rowBytes / sizeof(T);
  constexpr std::uint64_t ones = ~std::uint64_t(0) / maskOf<T>(bitsOf<T>); // 1 in each lane
  const std::uint64_t mask = ones * maskOf<T>(width);
  std::array<std::uint64_t, 2 * bitsOf<T> + 2> words{};
  for (unsigned i = 0; i < bitsOf<T>; ++i)
  {
    const unsigned word = i * width / bitsOf<T>;
    const unsigned shift = i * width % bitsOf<T>;
    const std::uint64_t kept = ones * static_cast<T>(maskOf<T>(bitsOf<T>) << shift);
    const unsigned rest = bitsOf<T> - shift; // bits of a lane from `shift` up
    const std::uint64_t carried = rest < width ? ones * maskOf<T>(width - rest) : 0;
    for (std::size_t half = 0; half < 2; ++half)
    {
      std::uint64_t eight = 0;
      std::memcpy(&eight, codes.data() + i * lanes + half * (lanes / 2), sizeof(eight));
      eight &= mask;
      words[2 * word + half] |= (eight << shift) & kept;
      words[2 * word + 2 + half] |= (eight >> (rest & 63u)) & carried;
    }
  }
  std::memcpy(rows, words.data(), rowBytes * width);
}

/// For eight codes from `first` on, the highest bit of the byte of each that has more than `width`
/// bits. `lengths` is filled unless the codes are bytes: these are looked at themselves.
template <typename T>
std::uint64_t longerThan(
  const CodeGroup<T>& codes, const GroupLengths& lengths, std::size_t first, unsigned width)
{
  constexpr std::uint64_t ones = 0x0101010101010101ull;
  std::uint64_t eight = 0;
  if constexpr (sizeof(T) == 1)
  {
    std::memcpy(&eight, codes.data() + first, sizeof(eight));
    const std::uint64_t above = eight & (ones * ((0xffu << width) & 0xffu));
    // Adding 127 to the low seven bits of a byte sets its highest bit unless they are zero.
    return (((above & (ones * 0x7fu)) + ones * 0x7fu) | above) & (ones * 0x80u);
  }
  else
  {
    // Lengths are at most 64: adding 127 - width sets the highest bit of those above the width.
    std::memcpy(&eight, lengths.data() + first, sizeof(eight));
    return (eight + ones * (127u - width)) & (ones * 0x80u);
  }
}
} // namespace packed

/// Bytes that putGroup() writes.
template <typename T>
std::size_t groupBytes(const CodeGroup<T>& codes)
{
  packed::GroupLengths lengths; // NOLINT: filled by the call
  return packed::planOf<T>(codes, lengths).bytes;
}

/// Writes the group, at most packed::mostGroupBytes<T>, and up to packed::writtenBeyond bytes of no
/// meaning after it; returns the place after the group.
template <typename T>
std::byte* putGroup(const CodeGroup<T>& codes, std::byte* at)
{
  packed::GroupLengths lengths; // NOLINT: filled by the call
  const packed::GroupPlan plan = packed::planOf<T>(codes, lengths);
  *at++ = static_cast<std::byte>(plan.width);
  *at++ = static_cast<std::byte>(plan.exceptions);
  packed::packRows<T>(codes, plan.width, at);
  at += packed::rowBytes * plan.width;
  if (plan.exceptions == 0)
  {
    return at;
  }
  *at++ = static_cast<std::byte>(plan.exceptionBytes);
  std::byte* upper = at + plan.exceptions;
  for (std::size_t i = 0; i < codesPerGroup; i += 8)
  {
    std::uint64_t longer = packed::longerThan<T>(codes, lengths, i, plan.width);
    for (; longer != 0; longer &= longer - 1)
    {
      const std::size_t place = i + static_cast<std::size_t>(__builtin_ctzll(longer)) / 8;
      *at++ = static_cast<std::byte>(place);
      const std::uint64_t high = std::uint64_t(codes[place]) >> plan.width;
      std::memcpy(upper, &high, sizeof(high)); // the next one overwrites what is too much
      upper += plan.exceptionBytes;
    }
  }
  return upper;
}

} // namespace pointfront
