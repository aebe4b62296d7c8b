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

} // namespace packed

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
