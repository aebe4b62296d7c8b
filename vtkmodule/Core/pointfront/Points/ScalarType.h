#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace pointfront
{

/// Component type of an attribute. The numbers are part of the store format: never renumber.
enum class ScalarType : std::uint8_t
{
  Int8 = 1,
  UInt8 = 2,
  Int16 = 3,
  UInt16 = 4,
  Int32 = 5,
  UInt32 = 6,
  Int64 = 7,
  UInt64 = 8,
  Float32 = 9,
  Float64 = 10
};

/// Bytes of one component: 1, 2, 4 or 8.
std::size_t sizeOf(ScalarType type);
/// "int8", "uint8" ... "float64": the names of `info --json` and of --attributes.
std::string_view nameOf(ScalarType type);
/// The type of that name, or nothing.
std::optional<ScalarType> scalarTypeOf(std::string_view name);
/// The type of that number in a store, or nothing.
std::optional<ScalarType> scalarTypeOf(std::uint8_t number);

} // namespace pointfront
