#include "pointfront/Codec/PackedCodec.h"

#include "pointfront/Codec/PackedGroup.h"
#include "pointfront/Codec/PackedPredictor.h"
#include "pointfront/Codec/ValueCode.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace pointfront
{
namespace
{
template <typename T>
T valueAt(const std::byte* values, std::size_t index)
{
  T value;
  std::memcpy(&value, values + index * sizeof(T), sizeof(T));
  return value;
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
      value[c] = predictor == Predictor::Zero ? groups[c][i]
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
    putValues<T>(
      groups, components, predictor, count, before, values + begin * components * sizeof(T));
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
  return withUnsigned(shape.scalarBytes,
    [&](auto zero)
    {
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
