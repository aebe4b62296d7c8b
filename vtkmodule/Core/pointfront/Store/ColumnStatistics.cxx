#include "pointfront/Store/ColumnStatistics.h"

#include "pointfront/Store/ByteStream.h"

#include <algorithm>
#include <limits>

namespace pointfront
{
namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();

template <typename T>
std::array<double, 2> componentRange(
  const std::byte* values, std::size_t points, std::size_t strideBytes)
{
  if (points == 0)
  {
    return { infinity, -infinity };
  }
  T low = std::numeric_limits<T>::has_infinity ? std::numeric_limits<T>::infinity()
                                               : std::numeric_limits<T>::max();
  T high = std::numeric_limits<T>::has_infinity ? -std::numeric_limits<T>::infinity()
                                                : std::numeric_limits<T>::lowest();
  for (std::size_t i = 0; i < points; ++i)
  {
    T value;
    std::memcpy(&value, values + i * strideBytes, sizeof(T));
    low = value < low ? value : low; // false for NaN
    high = value > high ? value : high;
  }
  return { static_cast<double>(low), static_cast<double>(high) };
}

std::array<double, 2> componentRange(
  ScalarType type, const std::byte* values, std::size_t points, std::size_t strideBytes)
{
  switch (type)
  {
    case ScalarType::Int8:
      return componentRange<std::int8_t>(values, points, strideBytes);
    case ScalarType::UInt8:
      return componentRange<std::uint8_t>(values, points, strideBytes);
    case ScalarType::Int16:
      return componentRange<std::int16_t>(values, points, strideBytes);
    case ScalarType::UInt16:
      return componentRange<std::uint16_t>(values, points, strideBytes);
    case ScalarType::Int32:
      return componentRange<std::int32_t>(values, points, strideBytes);
    case ScalarType::UInt32:
      return componentRange<std::uint32_t>(values, points, strideBytes);
    case ScalarType::Int64:
      return componentRange<std::int64_t>(values, points, strideBytes);
    case ScalarType::UInt64:
      return componentRange<std::uint64_t>(values, points, strideBytes);
    case ScalarType::Float32:
      return componentRange<float>(values, points, strideBytes);
    case ScalarType::Float64:
      break;
  }
  return componentRange<double>(values, points, strideBytes);
}
} // namespace

BlockShape positionShape(std::size_t points) { return { points, 3, 4 }; }

BlockShape columnShape(const Attribute& attribute, std::size_t points)
{
  return { points, attribute.components, static_cast<unsigned>(sizeOf(attribute.type)) };
}

ColumnRange emptyRange(const Attribute& attribute)
{
  ColumnRange range;
  range.components.assign(attribute.components, { infinity, -infinity });
  return range;
}

ColumnRange rangeOf(const std::byte* values, const Attribute& attribute, std::size_t points)
{
  ColumnRange range;
  for (unsigned c = 0; c < attribute.components; ++c)
  {
    range.components.push_back(componentRange(
      attribute.type, values + c * sizeOf(attribute.type), points, attribute.bytes()));
  }
  return range;
}

void addRange(ColumnRange& range, const ColumnRange& other)
{
  for (std::size_t c = 0; c < range.components.size(); ++c)
  {
    range.components[c][0] = std::min(range.components[c][0], other.components[c][0]);
    range.components[c][1] = std::max(range.components[c][1], other.components[c][1]);
  }
}

bool encloses(const ColumnRange& outer, const ColumnRange& inner)
{
  for (std::size_t c = 0; c < outer.components.size(); ++c)
  {
    if (inner.components[c][0] < outer.components[c][0] ||
      inner.components[c][1] > outer.components[c][1])
    {
      return false;
    }
  }
  return true;
}

} // namespace pointfront
