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

/// The integer or the float of so many bytes, or nothing.
std::optional<ScalarType> integerTypeOf(std::int64_t bytes, bool isSigned);
std::optional<ScalarType> floatTypeOf(std::int64_t bytes);

/// Calls `function` with a zero of the C++ type that stands for `type`, and returns its result. So
/// the switch over types is written once, and loops over points are compiled for one type.
template <typename Function>
decltype(auto) visitScalar(ScalarType type, Function&& function)
{
  switch (type)
  {
    case ScalarType::Int8:
      return function(std::int8_t(0));
    case ScalarType::UInt8:
      return function(std::uint8_t(0));
    case ScalarType::Int16:
      return function(std::int16_t(0));
    case ScalarType::UInt16:
      return function(std::uint16_t(0));
    case ScalarType::Int32:
      return function(std::int32_t(0));
    case ScalarType::UInt32:
      return function(std::uint32_t(0));
    case ScalarType::Int64:
      return function(std::int64_t(0));
    case ScalarType::UInt64:
      return function(std::uint64_t(0));
    case ScalarType::Float32:
      return function(0.0f);
    case ScalarType::Float64:
      break;
  }
  return function(0.0);
}

} // namespace pointfront
