#include "pointfront/Table/RecordNumbers.h"

#include <cstdint>
#include <cstring>

namespace pointfront
{
namespace
{
template <typename T>
T loadSwapped(const std::byte* from)
{
  std::byte reversed[sizeof(T)];
  for (std::size_t i = 0; i < sizeof(T); ++i)
  {
    reversed[i] = from[sizeof(T) - 1 - i];
  }
  T value;
  std::memcpy(&value, reversed, sizeof value);
  return value;
}

template <typename T>
void gather(const RecordNumbers& numbers, std::size_t count, double* to)
{
  const std::byte* from = numbers.first;
  if (numbers.swapped)
  {
    for (std::size_t i = 0; i < count; ++i, from += numbers.stride)
    {
      to[i] = static_cast<double>(loadSwapped<T>(from));
    }
    return;
  }
  for (std::size_t i = 0; i < count; ++i, from += numbers.stride)
  {
    T value;
    std::memcpy(&value, from, sizeof value);
    to[i] = static_cast<double>(value);
  }
}
} // namespace

bool machineIsLittleEndian()
{
  const std::uint16_t one = 1;
  unsigned char first = 0;
  std::memcpy(&first, &one, 1);
  return first == 1;
}

void gatherNumbers(const RecordNumbers& numbers, std::size_t count, double* to)
{
  switch (numbers.type)
  {
    case ScalarType::Int8:
      return gather<std::int8_t>(numbers, count, to);
    case ScalarType::UInt8:
      return gather<std::uint8_t>(numbers, count, to);
    case ScalarType::Int16:
      return gather<std::int16_t>(numbers, count, to);
    case ScalarType::UInt16:
      return gather<std::uint16_t>(numbers, count, to);
    case ScalarType::Int32:
      return gather<std::int32_t>(numbers, count, to);
    case ScalarType::UInt32:
      return gather<std::uint32_t>(numbers, count, to);
    case ScalarType::Int64:
      return gather<std::int64_t>(numbers, count, to);
    case ScalarType::UInt64:
      return gather<std::uint64_t>(numbers, count, to);
    case ScalarType::Float32:
      return gather<float>(numbers, count, to);
    case ScalarType::Float64:
      return gather<double>(numbers, count, to);
  }
}

} // namespace pointfront
