#include "pointfront/Store/PackedCodec.h"

#include "pointfront/Store/ValueCode.h"

#include <algorithm>
#include <array>
#include <climits>
#include <cstring>
#include <utility>

namespace pointfront
{
namespace
{
/// How a value is predicted. The numbers are part of the format.
enum class Predictor : std::uint8_t
{
  Zero = 0,           ///< code = value
  PointBefore = 1,    ///< code = zigzag(value - value of the point before)
  SecondComponent = 2 ///< as 1, after component 1 was subtracted from 0 and 2: colours
};
constexpr std::uint8_t predictorCount = 3;

constexpr std::size_t groupSize = 128;
constexpr std::size_t rowBytes = 16; ///< one bit of each of 128 codes

template <typename T>
constexpr unsigned bitsOf = sizeof(T) * CHAR_BIT;

template <typename T>
constexpr T maskOf(unsigned width)
{
  return width == 0 ? T(0) : static_cast<T>(static_cast<T>(~T(0)) >> (bitsOf<T> - width));
}

template <typename T>
using Group = std::array<T, groupSize>;

// --- packing: code i lies in lane i % lanes; a lane is a bit stream over words of T, lowest bit
// first; row r holds word r of every lane. Every width fills `width` rows exactly.

template <typename T, unsigned width>
void unpackRows(const std::byte* rows, Group<T>& codes)
{
  constexpr std::size_t lanes = rowBytes / sizeof(T);
  constexpr T mask = maskOf<T>(width);
  std::array<T, lanes * width> words; // NOLINT: filled by the copy
  std::memcpy(words.data(), rows, rowBytes * width);
#pragma GCC unroll 64
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

template <typename T, unsigned width>
void packRows(const Group<T>& codes, std::byte* rows)
{
  constexpr std::size_t lanes = rowBytes / sizeof(T);
  constexpr T mask = maskOf<T>(width);
  std::array<T, lanes * width> words{};
#pragma GCC unroll 64
  for (unsigned i = 0; i < bitsOf<T>; ++i)
  {
    const unsigned word = i * width / bitsOf<T>;
    const unsigned shift = i * width % bitsOf<T>;
    for (std::size_t lane = 0; lane < lanes; ++lane)
    {
      const T code = static_cast<T>(codes[i * lanes + lane] & mask);
      T& low = words[word * lanes + lane];
      low = static_cast<T>(low | static_cast<T>(code << shift));
      if (shift + width > bitsOf<T>)
      {
        words[(word + 1) * lanes + lane] =
          static_cast<T>(code >> ((bitsOf<T> - shift) % bitsOf<T>));
      }
    }
  }
  std::memcpy(rows, words.data(), rowBytes * width);
}

// Width 0 has no rows: entry w - 1 is for width w.
template <typename T>
using Unpack = void (*)(const std::byte*, Group<T>&);
template <typename T>
using Pack = void (*)(const Group<T>&, std::byte*);

template <typename T, std::size_t... entries>
constexpr std::array<Unpack<T>, sizeof...(entries)> unpackTable(std::index_sequence<entries...>)
{
  return { unpackRows<T, static_cast<unsigned>(entries + 1)>... };
}

template <typename T, std::size_t... entries>
constexpr std::array<Pack<T>, sizeof...(entries)> packTable(std::index_sequence<entries...>)
{
  return { packRows<T, static_cast<unsigned>(entries + 1)>... };
}

template <typename T>
void unpack(unsigned width, const std::byte* rows, Group<T>& codes)
{
  static constexpr auto table = unpackTable<T>(std::make_index_sequence<bitsOf<T>>{});
  if (width == 0)
  {
    codes.fill(0);
    return;
  }
  table[width - 1](rows, codes);
}

template <typename T>
void pack(unsigned width, const Group<T>& codes, std::byte* rows)
{
  static constexpr auto table = packTable<T>(std::make_index_sequence<bitsOf<T>>{});
  if (width != 0)
  {
    table[width - 1](codes, rows);
  }
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
GroupPlan planOf(const Group<T>& codes)
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

template <typename T>
void putGroup(const Group<T>& codes, std::vector<std::byte>& out)
{
  const GroupPlan plan = planOf(codes);
  const std::size_t begin = out.size();
  out.resize(begin + plan.bytes);
  std::byte* at = out.data() + begin;
  *at++ = static_cast<std::byte>(plan.width);
  *at++ = static_cast<std::byte>(plan.exceptions);
  pack<T>(plan.width, codes, at);
  at += rowBytes * plan.width;
  if (plan.exceptions == 0)
  {
    return;
  }
  *at++ = static_cast<std::byte>(plan.exceptionBytes);
  std::byte* upper = at + plan.exceptions;
  for (std::size_t i = 0; i < groupSize; ++i)
  {
    if (bitLength(codes[i]) > plan.width)
    {
      *at++ = static_cast<std::byte>(i);
      const std::uint64_t high = std::uint64_t(codes[i]) >> plan.width;
      std::memcpy(upper, &high, plan.exceptionBytes);
      upper += plan.exceptionBytes;
    }
  }
}

/// Reads one group; nullptr when it runs over `end` or is not one.
template <typename T>
const std::byte* getGroup(const std::byte* at, const std::byte* end, Group<T>& codes)
{
  if (end - at < 2)
  {
    return nullptr;
  }
  const auto width = static_cast<unsigned>(*at++);
  const auto exceptions = static_cast<unsigned>(*at++);
  if (width > bitsOf<T> || end - at < std::ptrdiff_t(rowBytes * width))
  {
    return nullptr;
  }
  unpack<T>(width, at, codes);
  at += rowBytes * width;
  if (exceptions == 0)
  {
    return at;
  }
  if (width == bitsOf<T> || end - at < 1)
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
    if (i >= groupSize)
    {
      return nullptr;
    }
    std::uint64_t high = 0;
    std::memcpy(&high, upper, upperBytes);
    codes[i] = static_cast<T>(codes[i] | static_cast<T>(high << width));
  }
  return upper;
}

// --- prediction

template <typename T>
T valueAt(const std::byte* values, std::size_t index)
{
  T value;
  std::memcpy(&value, values + index * sizeof(T), sizeof(T));
  return value;
}

/// The value that is predicted for SecondComponent: colours minus their green.
template <typename T>
T sourceValue(
  const std::byte* values, const BlockShape& shape, std::size_t i, unsigned c, Predictor predictor)
{
  const std::size_t first = i * shape.components;
  const T value = valueAt<T>(values, first + c);
  return predictor == Predictor::SecondComponent && c != 1
    ? static_cast<T>(value - valueAt<T>(values, first + 1))
    : value;
}

template <typename T>
void codesOf(const std::byte* values, const BlockShape& shape, std::size_t begin, unsigned c,
  Predictor predictor, Group<T>& codes)
{
  const std::size_t count = std::min(groupSize, shape.points - begin);
  T before = predictor != Predictor::Zero && begin > 0
    ? sourceValue<T>(values, shape, begin - 1, c, predictor)
    : T(0);
  for (std::size_t i = 0; i < count; ++i)
  {
    const T value = sourceValue<T>(values, shape, begin + i, c, predictor);
    codes[i] = predictor == Predictor::Zero ? value : zigzag(static_cast<T>(value - before));
    before = value;
  }
  std::fill(codes.begin() + static_cast<std::ptrdiff_t>(count), codes.end(), T(0));
}

/// Bytes that encodeWith() gives.
template <typename T>
std::size_t encodedBytes(
  Predictor predictor, const std::byte* values, const BlockShape& shape)
{
  std::size_t sum = 1;
  Group<T> codes;
  for (std::size_t begin = 0; begin < shape.points; begin += groupSize)
  {
    for (unsigned c = 0; c < shape.components; ++c)
    {
      codesOf<T>(values, shape, begin, c, predictor, codes);
      sum += planOf(codes).bytes;
    }
  }
  return sum;
}

template <typename T>
std::vector<std::byte> encodeWith(
  Predictor predictor, const std::byte* values, const BlockShape& shape)
{
  std::vector<std::byte> out{ static_cast<std::byte>(predictor) };
  Group<T> codes;
  for (std::size_t begin = 0; begin < shape.points; begin += groupSize)
  {
    for (unsigned c = 0; c < shape.components; ++c)
    {
      codesOf<T>(values, shape, begin, c, predictor, codes);
      putGroup<T>(codes, out);
    }
  }
  return out;
}

/// Writes the first `count` points of decoded groups as interleaved values and moves `before` on.
template <typename T, typename Groups>
void putValues(const Groups& groups, unsigned components, Predictor predictor, std::size_t count,
  std::array<T, 16>& before, std::byte* target)
{
  std::array<T, 16> value = before;
  for (std::size_t i = 0; i < count; ++i)
  {
    for (unsigned c = 0; c < components; ++c)
    {
      value[c] = predictor == Predictor::Zero
        ? groups[c][i]
        : static_cast<T>(value[c] + unzigzag(groups[c][i]));
    }
    for (unsigned c = 0; c < components; ++c, target += sizeof(T))
    {
      const bool plusSecond = predictor == Predictor::SecondComponent && c != 1;
      const T result = plusSecond ? static_cast<T>(value[c] + value[1]) : value[c];
      std::memcpy(target, &result, sizeof(T));
    }
  }
  before = value;
}

/// `fixedComponents` is the number of components when it is known at compile time, else 0.
template <typename T, unsigned fixedComponents, Predictor predictor>
bool decodeGroups(
  const std::byte* at, const std::byte* end, const BlockShape& shape, std::byte* values)
{
  const unsigned components = fixedComponents != 0 ? fixedComponents : shape.components;
  std::array<Group<T>, fixedComponents != 0 ? fixedComponents : 16> groups;
  std::array<T, 16> before{};
  for (std::size_t begin = 0; begin < shape.points; begin += groupSize)
  {
    for (unsigned c = 0; c < components; ++c)
    {
      at = getGroup<T>(at, end, groups[c]);
      if (at == nullptr)
      {
        return false;
      }
    }
    const std::size_t count = std::min(groupSize, shape.points - begin);
    putValues<T>(groups, components, predictor, count, before,
      values + begin * components * sizeof(T));
  }
  return at == end;
}

template <typename T, Predictor predictor>
bool decodeComponents(
  const std::byte* at, const std::byte* end, const BlockShape& shape, std::byte* values)
{
  switch (shape.components)
  {
    case 1:
      return decodeGroups<T, 1, predictor>(at, end, shape, values);
    case 3:
      return decodeGroups<T, 3, predictor>(at, end, shape, values);
    default:
      return decodeGroups<T, 0, predictor>(at, end, shape, values);
  }
}

bool predictable(Predictor predictor, const BlockShape& shape)
{
  return predictor != Predictor::SecondComponent ||
    (shape.components == 3 && shape.scalarBytes <= 2);
}
} // namespace

std::vector<std::byte> encodePacked(const std::byte* values, const BlockShape& shape)
{
  return withUnsigned(shape.scalarBytes, [&](auto zero) {
    using T = decltype(zero);
    const BlockShape sample = sampleOf(shape);
    const std::byte* sampleValues = values + (shape.bytes() - sample.bytes());
    Predictor best = Predictor::Zero;
    std::size_t bestBytes = SIZE_MAX;
    for (std::uint8_t p = 0; p < predictorCount; ++p)
    {
      const auto predictor = static_cast<Predictor>(p);
      if (!predictable(predictor, shape))
      {
        continue;
      }
      const std::size_t bytes = encodedBytes<T>(predictor, sampleValues, sample);
      if (bytes < bestBytes)
      {
        best = predictor;
        bestBytes = bytes;
      }
    }
    return encodeWith<T>(best, values, shape);
  });
}

bool decodePacked(
  const std::byte* coded, std::size_t codedBytes, const BlockShape& shape, std::byte* values)
{
  if (codedBytes < 1 || static_cast<std::uint8_t>(coded[0]) >= predictorCount)
  {
    return false;
  }
  const auto predictor = static_cast<Predictor>(coded[0]);
  if (!predictable(predictor, shape))
  {
    return false;
  }
  return withUnsigned(shape.scalarBytes, [&](auto zero) {
    using T = decltype(zero);
    const std::byte* begin = coded + 1;
    const std::byte* end = coded + codedBytes;
    switch (predictor)
    {
      case Predictor::Zero:
        return decodeComponents<T, Predictor::Zero>(begin, end, shape, values);
      case Predictor::PointBefore:
        return decodeComponents<T, Predictor::PointBefore>(begin, end, shape, values);
      case Predictor::SecondComponent:
        break;
    }
    return decodeGroups<T, 3, Predictor::SecondComponent>(begin, end, shape, values);
  });
}

} // namespace pointfront
