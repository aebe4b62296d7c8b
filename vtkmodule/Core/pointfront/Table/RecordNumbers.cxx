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

template <typename T, typename To>
void gather(const RecordNumbers& numbers, std::size_t count, To* to)
{
  const std::byte* from = numbers.first;
  if (numbers.swapped)
  {
    for (std::size_t i = 0; i < count; ++i, from += numbers.stride)
    {
      to[i] = static_cast<To>(loadSwapped<T>(from));
    }
    return;
  }
  for (std::size_t i = 0; i < count; ++i, from += numbers.stride)
  {
    T value;
    std::memcpy(&value, from, sizeof value);
    to[i] = static_cast<To>(value);
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
  visitScalar(numbers.type, [&](auto zero) { gather<decltype(zero)>(numbers, count, to); });
}

void gatherWholes(const RecordNumbers& numbers, std::size_t count, std::uint64_t* to)
{
  gather<std::uint64_t>(numbers, count, to); // the bits of either type
}

bool wantsWholes(ScalarType type)
{
  return type == ScalarType::Int64 || type == ScalarType::UInt64;
}

} // namespace pointfront
