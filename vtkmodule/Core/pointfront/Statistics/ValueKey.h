#pragma once

#include "pointfront/Points/AttributeSchema.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <variant>

namespace pointfront
{

/// The type in which the values of one component are kept while they are counted.
enum class ValueKind : std::uint8_t
{
  Unsigned,
  Signed,
  Real ///< floating point, and whole numbers with a scale or an offset
};

/// A value as it is; whole numbers of 64 bits do not fit into a double.
using ExactValue = std::variant<std::uint64_t, std::int64_t, double>;

/// Kind of the world values of an attribute.
inline ValueKind valueKindOf(const Attribute& attribute)
{
  const bool scaled = attribute.scale != 1.0 || attribute.offset != 0.0;
  return visitScalar(attribute.type,
    [scaled](auto zero)
    {
      using T = decltype(zero);
      return scaled || std::is_floating_point_v<T> ? ValueKind::Real
        : std::is_signed_v<T>                      ? ValueKind::Signed
                                                   : ValueKind::Unsigned;
    });
}

/// Values of one kind as unsigned numbers of the same order, so that smallest and largest are
/// exact for every type. Of whole numbers the difference of two keys is that of the values.
namespace valueKey
{
constexpr std::uint64_t signBit = std::uint64_t(1) << 63;

inline std::uint64_t ofUnsigned(std::uint64_t value)
{
  return value;
}
inline std::uint64_t ofSigned(std::int64_t value)
{
  return static_cast<std::uint64_t>(value) ^ signBit;
}
/// Finite; -0 counts as 0, or which of them is found would depend on the order.
inline std::uint64_t ofReal(double value)
{
  value += 0.0;
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return (bits & signBit) != 0 ? ~bits : bits | signBit;
}
inline double real(std::uint64_t key)
{
  const std::uint64_t bits = (key & signBit) != 0 ? key ^ signBit : ~key;
  double value = 0.0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}
inline ExactValue value(ValueKind kind, std::uint64_t key)
{
  return kind == ValueKind::Unsigned ? ExactValue(key)
    : kind == ValueKind::Signed      ? ExactValue(static_cast<std::int64_t>(key ^ signBit))
                                     : ExactValue(real(key));
}
} // namespace valueKey

} // namespace pointfront
