#include "pointfront/Points/ScalarType.h"

#include <array>

namespace pointfront
{
namespace
{
struct Row
{
  ScalarType type;
  std::size_t bytes;
  std::string_view name;
};
constexpr std::array<Row, 10> rows{ { { ScalarType::Int8, 1, "int8" },
  { ScalarType::UInt8, 1, "uint8" }, { ScalarType::Int16, 2, "int16" },
  { ScalarType::UInt16, 2, "uint16" }, { ScalarType::Int32, 4, "int32" },
  { ScalarType::UInt32, 4, "uint32" }, { ScalarType::Int64, 8, "int64" },
  { ScalarType::UInt64, 8, "uint64" }, { ScalarType::Float32, 4, "float32" },
  { ScalarType::Float64, 8, "float64" } } };

// The enumerators number the rows from 1.
const Row& rowOf(ScalarType type)
{
  return rows[static_cast<std::size_t>(type) - 1];
}
} // namespace

std::size_t sizeOf(ScalarType type)
{
  return rowOf(type).bytes;
}

std::string_view nameOf(ScalarType type)
{
  return rowOf(type).name;
}

std::optional<ScalarType> scalarTypeOf(std::string_view name)
{
  for (const Row& row : rows)
  {
    if (row.name == name)
    {
      return row.type;
    }
  }
  return std::nullopt;
}

std::optional<ScalarType> scalarTypeOf(std::uint8_t number)
{
  if (number < 1 || number > rows.size())
  {
    return std::nullopt;
  }
  return static_cast<ScalarType>(number);
}

std::optional<ScalarType> integerTypeOf(std::int64_t bytes, bool isSigned)
{
  switch (bytes)
  {
    case 1:
      return isSigned ? ScalarType::Int8 : ScalarType::UInt8;
    case 2:
      return isSigned ? ScalarType::Int16 : ScalarType::UInt16;
    case 4:
      return isSigned ? ScalarType::Int32 : ScalarType::UInt32;
    case 8:
      return isSigned ? ScalarType::Int64 : ScalarType::UInt64;
    default:
      return std::nullopt;
  }
}

std::optional<ScalarType> floatTypeOf(std::int64_t bytes)
{
  return bytes == 4 ? std::optional<ScalarType>(ScalarType::Float32)
    : bytes == 8    ? std::optional<ScalarType>(ScalarType::Float64)
                    : std::nullopt;
}

} // namespace pointfront
