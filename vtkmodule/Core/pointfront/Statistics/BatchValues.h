#pragma once

#include "pointfront/Points/PointBatch.h"
#include "pointfront/Statistics/ValueKey.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace pointfront
{

/// A value of a batch.
struct FoundValue
{
  enum class Kind : std::uint8_t
  {
    Finite,
    NotANumber,
    Infinite
  };
  Kind kind = Kind::Finite;
  std::uint64_t key = 0; ///< finite ones only: see ValueKey.h
};

inline FoundValue foundReal(double value)
{
  if (std::isfinite(value))
  {
    return { FoundValue::Kind::Finite, valueKey::ofReal(value) };
  }
  return { std::isnan(value) ? FoundValue::Kind::NotANumber : FoundValue::Kind::Infinite, 0 };
}

template <typename T>
FoundValue foundValue(T value, const Attribute& attribute, bool real)
{
  if (real)
  {
    const bool scaled = attribute.scale != 1.0 || attribute.offset != 0.0;
    const auto stored = static_cast<double>(value);
    return foundReal(scaled ? stored * attribute.scale + attribute.offset : stored);
  }
  return { FoundValue::Kind::Finite,
    std::is_signed_v<T> ? valueKey::ofSigned(static_cast<std::int64_t>(value))
                        : valueKey::ofUnsigned(static_cast<std::uint64_t>(value)) };
}

/// Calls visit(component, valueOf) for x, y, z and then every component of every attribute, in the
/// schema's order, numbered from 0; valueOf(point) is a FoundValue in world units.
template <typename Visit>
void visitComponents(const AttributeSchema& schema, const PointBatch& batch, const Visit& visit)
{
  std::size_t number = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    visit(number++, [&](std::size_t point) { return foundReal(batch.positions[point][axis]); });
  }
  for (std::size_t c = 0; c < schema.size(); ++c)
  {
    const Attribute& attribute = schema[c];
    const bool real = valueKindOf(attribute) == ValueKind::Real;
    for (std::size_t k = 0; k < attribute.components; ++k)
    {
      visitScalar(attribute.type,
        [&](auto zero)
        {
          using T = decltype(zero);
          const std::byte* const first = batch.columns[c].data() + k * sizeof(T);
          const std::size_t stride = attribute.bytes();
          visit(number,
            [&](std::size_t point)
            {
              T value;
              std::memcpy(&value, first + point * stride, sizeof value);
              return foundValue(value, attribute, real);
            });
        });
      ++number;
    }
  }
}

} // namespace pointfront
