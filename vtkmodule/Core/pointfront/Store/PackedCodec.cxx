#include "pointfront/Store/PackedCodec.h"

#include "pointfront/Store/PackedGroup.h"
#include "pointfront/Store/ValueCode.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>

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
/// Set in the byte of the predictor: a factor follows that all values were divided by.
constexpr std::byte factorFlag{ 0x80 };

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
  Predictor predictor, CodeGroup<T>& codes)
{
  const std::size_t count = std::min(codesPerGroup, shape.points - begin);
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
  CodeGroup<T> codes;
  for (std::size_t begin = 0; begin < shape.points; begin += codesPerGroup)
  {
    for (unsigned c = 0; c < shape.components; ++c)
    {
      codesOf<T>(values, shape, begin, c, predictor, codes);
      sum += groupBytes(codes);
    }
  }
  return sum;
}

template <typename T>
std::vector<std::byte> encodeWith(
  Predictor predictor, T factor, const std::byte* values, const BlockShape& shape)
{
  std::vector<std::byte> out{ static_cast<std::byte>(predictor) };
  if (factor > 1)
  {
    out[0] |= factorFlag;
    out.resize(1 + sizeof(T));
    std::memcpy(out.data() + 1, &factor, sizeof(T));
  }
  CodeGroup<T> codes;
  for (std::size_t begin = 0; begin < shape.points; begin += codesPerGroup)
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
  std::array<CodeGroup<T>, fixedComponents != 0 ? fixedComponents : 16> groups;
  std::array<T, 16> before{};
  for (std::size_t begin = 0; begin < shape.points; begin += codesPerGroup)
  {
    for (unsigned c = 0; c < components; ++c)
    {
      at = getGroup<T>(at, end, groups[c]);
      if (at == nullptr)
      {
        return false;
      }
    }
    const std::size_t count = std::min(codesPerGroup, shape.points - begin);
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

template <typename T>
bool decodePredicted(Predictor predictor, const std::byte* at, const std::byte* end,
  const BlockShape& shape, std::byte* values)
{
  switch (predictor)
  {
    case Predictor::Zero:
      return decodeComponents<T, Predictor::Zero>(at, end, shape, values);
    case Predictor::PointBefore:
      return decodeComponents<T, Predictor::PointBefore>(at, end, shape, values);
    case Predictor::SecondComponent:
      break;
  }
  return decodeGroups<T, 3, Predictor::SecondComponent>(at, end, shape, values);
}

bool predictable(Predictor predictor, const BlockShape& shape)
{
  return predictor != Predictor::SecondComponent ||
    (shape.components == 3 && shape.scalarBytes <= 2);
}

template <typename T>
Predictor bestPredictor(const std::byte* values, const BlockShape& shape)
{
  const BlockShape sample = sampleOf(shape);
  const std::byte* begin = values + (shape.bytes() - sample.bytes());
  Predictor best = Predictor::Zero;
  std::size_t bestBytes = encodedBytes<T>(best, begin, sample);
  for (const Predictor predictor : { Predictor::PointBefore, Predictor::SecondComponent })
  {
    const std::size_t bytes =
      predictable(predictor, shape) ? encodedBytes<T>(predictor, begin, sample) : SIZE_MAX;
    if (bytes < bestBytes)
    {
      best = predictor;
      bestBytes = bytes;
    }
  }
  return best;
}

// --- a factor that all values share: colours of 8 bits that were stretched to 16, coordinates
// of a scale finer than their instrument, doubles that once were floats.

template <typename T>
T commonFactor(const std::byte* values, const BlockShape& shape)
{
  T factor = 0;
  for (std::size_t i = 0; i < shape.points * shape.components && factor != 1; ++i)
  {
    factor = std::gcd(factor, valueAt<T>(values, i));
  }
  return factor;
}

template <typename T>
std::vector<std::byte> divided(const std::byte* values, const BlockShape& shape, T factor)
{
  std::vector<std::byte> quotients(shape.bytes());
  for (std::size_t i = 0; i < shape.points * shape.components; ++i)
  {
    const auto quotient = static_cast<T>(valueAt<T>(values, i) / factor);
    std::memcpy(quotients.data() + i * sizeof(T), &quotient, sizeof(T));
  }
  return quotients;
}

template <typename T>
void multiply(std::byte* values, const BlockShape& shape, T factor)
{
  for (std::size_t i = 0; i < shape.points * shape.components; ++i)
  {
    // In 64 bits: the product of two uint16_t would overflow an int.
    const auto product =
      static_cast<T>(std::uint64_t(valueAt<T>(values, i)) * std::uint64_t(factor));
    std::memcpy(values + i * sizeof(T), &product, sizeof(T));
  }
}
} // namespace

std::vector<std::byte> encodePacked(const std::byte* values, const BlockShape& shape)
{
  return withUnsigned(shape.scalarBytes, [&](auto zero) {
    using T = decltype(zero);
    const T factor = commonFactor<T>(values, shape);
    if (factor <= 1)
    {
      return encodeWith<T>(bestPredictor<T>(values, shape), 0, values, shape);
    }
    const std::vector<std::byte> quotients = divided<T>(values, shape, factor);
    const Predictor predictor = bestPredictor<T>(quotients.data(), shape);
    return encodeWith<T>(predictor, factor, quotients.data(), shape);
  });
}

bool decodePacked(
  const std::byte* coded, std::size_t codedBytes, const BlockShape& shape, std::byte* values)
{
  if (codedBytes < 1)
  {
    return false;
  }
  const auto predictor = static_cast<Predictor>(coded[0] & ~factorFlag);
  const bool hasFactor = (coded[0] & factorFlag) != std::byte(0);
  if (static_cast<std::uint8_t>(predictor) >= predictorCount || !predictable(predictor, shape) ||
    codedBytes < 1 + (hasFactor ? shape.scalarBytes : 0))
  {
    return false;
  }
  return withUnsigned(shape.scalarBytes, [&](auto zero) {
    using T = decltype(zero);
    const std::byte* begin = coded + 1 + (hasFactor ? sizeof(T) : 0);
    if (!decodePredicted<T>(predictor, begin, coded + codedBytes, shape, values))
    {
      return false;
    }
    if (hasFactor)
    {
      multiply<T>(values, shape, valueAt<T>(coded + 1, 0));
    }
    return true;
  });
}

} // namespace pointfront
