#pragma once

#include <algorithm>
#include <array>
#include <climits>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

// A constant shift for every code, where it counts; a debug or sanitizer build would compile for
// minutes.
#ifdef NDEBUG
#define POINTFRONT_UNROLL _Pragma("GCC unroll 64")
#else
#define POINTFRONT_UNROLL
#endif

namespace pointfront
{

/// 128 unsigned codes of type T (8 to 64 bits), packed with as many bits as most of them need. In
/// the file: width, number of exceptions, width rows of 16 bytes; then, if there are exceptions,
/// the size of an upper part, the places of the exceptions and their upper parts.
constexpr std::size_t codesPerGroup = 128;

template <typename T>
using CodeGroup = std::array<T, codesPerGroup>;

namespace packed
{
constexpr std::size_t rowBytes = 16; ///< one bit of each of 128 codes

template <typename T>
constexpr unsigned bitsOf = sizeof(T) * CHAR_BIT;

template <typename T>
constexpr T maskOf(unsigned width)
{
  return width == 0 ? T(0) : static_cast<T>(static_cast<T>(~T(0)) >> (bitsOf<T> - width));
}

// --- packing: code i lies in lane i % lanes; a lane is a bit stream over words of T, lowest bit
// first; row r holds word r of every lane. Every width fills `width` rows exactly.

template <typename T, unsigned width>
void unpackRows(const std::byte* rows, CodeGroup<T>& codes)
{
  constexpr std::size_t lanes = rowBytes / sizeof(T);
  constexpr T mask = maskOf<T>(width);
  std::array<T, lanes * width> words; // NOLINT: filled by the copy
  std::memcpy(words.data(), rows, rowBytes * width);
  POINTFRONT_UNROLL
  for (unsigned i = 0; i < bitsOf<T>; ++i)
  {
    const unsigned word = i * width / bitsOf<T>;
    const unsigned shift = i * width % bitsOf<T>;
    for (std::size_t lane = 0; lane < lanes; ++lane)
    {
      T code = static_cast<T>(words[word * lanes + lane] >> shift);
      if (shift + width > bitsOf<T>)
      {
        const T upper = words[(word + 1) * lanes + lane];
        code = static_cast<T>(code | static_cast<T>(upper << ((bitsOf<T> - shift) % bitsOf<T>)));
      }
      codes[i * lanes + lane] = static_cast<T>(code & mask);
    }
  }
}

// Of any width: encoding is not what is waited for, and 120 more functions take long to compile.
template <typename T>
void packRows(const CodeGroup<T>& codes, unsigned width, std::byte* rows)
{
  constexpr std::size_t lanes = rowBytes / sizeof(T);
  const T mask = maskOf<T>(width);
  std::array<T, codesPerGroup> words{};
  for (unsigned i = 0; i < bitsOf<T>; ++i)
  {
    const unsigned word = i * width / bitsOf<T>;
    const unsigned shift = i * width % bitsOf<T>;
    const bool split = shift + width > bitsOf<T>;
    for (std::size_t lane = 0; lane < lanes; ++lane)
    {
      const T code = static_cast<T>(codes[i * lanes + lane] & mask);
      T& low = words[word * lanes + lane];
      low = static_cast<T>(low | static_cast<T>(code << shift));
      if (split)
      {
        words[(word + 1) * lanes + lane] = static_cast<T>(code >> (bitsOf<T> - shift));
      }
    }
  }
  std::memcpy(rows, words.data(), rowBytes * width);
}

// Width 0 has no rows: entry w - 1 is for width w.
template <typename T>
using Unpack = void (*)(const std::byte*, CodeGroup<T>&);

template <typename T, std::size_t... entries>
constexpr std::array<Unpack<T>, sizeof...(entries)> unpackTable(std::index_sequence<entries...>)
{
  return { unpackRows<T, static_cast<unsigned>(entries + 1)>... };
}

template <typename T>
void unpack(unsigned width, const std::byte* rows, CodeGroup<T>& codes)
{
  static constexpr auto table = unpackTable<T>(std::make_index_sequence<bitsOf<T>>{});
  if (width == 0)
  {
    codes.fill(0);
    return;
  }
  table[width - 1](rows, codes);
}

// --- the width of a group: the one that takes the fewest bytes, exceptions counted.

struct GroupPlan
{
  unsigned width = 0;
  unsigned exceptions = 0;     ///< codes of more than `width` bits
  unsigned exceptionBytes = 0; ///< of the upper part of each
  std::size_t bytes = 0;
};

template <typename T>
unsigned bitLength(T code)
{
  return code == 0 ? 0u : 64u - static_cast<unsigned>(__builtin_clzll(code));
}

template <typename T>
GroupPlan planOf(const CodeGroup<T>& codes)
{
  std::array<unsigned, 65> ofLength{};
  for (const T code : codes)
  {
    ++ofLength[bitLength(code)];
  }
  unsigned longest = bitsOf<T>;
  while (longest > 0 && ofLength[longest] == 0)
  {
    --longest;
  }
  GroupPlan best{ longest, 0, 0, 2 + rowBytes * longest };
  unsigned exceptions = 0;
  for (unsigned width = longest; width-- > 0;)
  {
    exceptions += ofLength[width + 1];
    const unsigned upperBytes = (longest - width + 7) / 8;
    const std::size_t bytes = 3 + rowBytes * width + exceptions * std::size_t(1 + upperBytes);
    if (bytes < best.bytes)
    {
      best = { width, exceptions, upperBytes, bytes };
    }
  }
  return best;
}
} // namespace packed

/// Bytes that putGroup() appends.
template <typename T>
std::size_t groupBytes(const CodeGroup<T>& codes)
{
  return packed::planOf(codes).bytes;
}

/// Appends the group.
template <typename T>
void putGroup(const CodeGroup<T>& codes, std::vector<std::byte>& out)
{
  const packed::GroupPlan plan = packed::planOf(codes);
  const std::size_t begin = out.size();
  out.resize(begin + plan.bytes);
  std::byte* at = out.data() + begin;
  *at++ = static_cast<std::byte>(plan.width);
  *at++ = static_cast<std::byte>(plan.exceptions);
  packed::packRows<T>(codes, plan.width, at);
  at += packed::rowBytes * plan.width;
  if (plan.exceptions == 0)
  {
    return;
  }
  *at++ = static_cast<std::byte>(plan.exceptionBytes);
  std::byte* upper = at + plan.exceptions;
  for (std::size_t i = 0; i < codesPerGroup; ++i)
  {
    if (packed::bitLength(codes[i]) > plan.width)
    {
      *at++ = static_cast<std::byte>(i);
      const std::uint64_t high = std::uint64_t(codes[i]) >> plan.width;
      std::memcpy(upper, &high, plan.exceptionBytes);
      upper += plan.exceptionBytes;
    }
  }
}

/// Reads a group at `at` and returns what follows it; nullptr when it runs over `end` or is not a
/// group. Reads nothing outside [at, end).
template <typename T>
const std::byte* getGroup(const std::byte* at, const std::byte* end, CodeGroup<T>& codes)
{
  if (end - at < 2)
  {
    return nullptr;
  }
  const auto width = static_cast<unsigned>(*at++);
  const auto exceptions = static_cast<unsigned>(*at++);
  if (width > packed::bitsOf<T> || end - at < std::ptrdiff_t(packed::rowBytes * width))
  {
    return nullptr;
  }
  packed::unpack<T>(width, at, codes);
  at += packed::rowBytes * width;
  if (exceptions == 0)
  {
    return at;
  }
  if (width == packed::bitsOf<T> || end - at < 1)
  {
    return nullptr;
  }
  const auto upperBytes = static_cast<unsigned>(*at++);
  if (upperBytes < 1 || upperBytes > sizeof(T) ||
    end - at < std::ptrdiff_t(exceptions * std::size_t(1 + upperBytes)))
  {
    return nullptr;
  }
  const std::byte* upper = at + exceptions;
  for (unsigned e = 0; e < exceptions; ++e, upper += upperBytes)
  {
    const auto i = static_cast<unsigned>(at[e]);
    if (i >= codesPerGroup)
    {
      return nullptr;
    }
    std::uint64_t high = 0;
    std::memcpy(&high, upper, upperBytes);
    codes[i] = static_cast<T>(codes[i] | static_cast<T>(high << width));
  }
  return upper;
}

} // namespace pointfront

#undef POINTFRONT_UNROLL
