#include "DecimalText.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace pointfront
{
namespace
{
constexpr int mostDecimals = 12;

/// True if the number has at most that many decimals, within the rounding of double.
bool isDecimal(double value, int decimals)
{
  const double shifted = value * std::pow(10.0, decimals);
  return std::abs(shifted - std::round(shifted)) <= 1e-9 * std::fmax(1.0, std::abs(shifted) * 1e-6);
}

/// Calls `visit` with the component in its own type.
template <typename Visit>
auto visitScalar(ScalarType type, const std::byte* from, Visit visit)
{
  const auto load = [from, &visit](auto value)
  {
    std::memcpy(&value, from, sizeof value);
    return visit(value);
  };
  switch (type)
  {
    case ScalarType::Int8:
      return load(std::int8_t{});
    case ScalarType::UInt8:
      return load(std::uint8_t{});
    case ScalarType::Int16:
      return load(std::int16_t{});
    case ScalarType::UInt16:
      return load(std::uint16_t{});
    case ScalarType::Int32:
      return load(std::int32_t{});
    case ScalarType::UInt32:
      return load(std::uint32_t{});
    case ScalarType::Int64:
      return load(std::int64_t{});
    case ScalarType::UInt64:
      return load(std::uint64_t{});
    case ScalarType::Float32:
      return load(float{});
    case ScalarType::Float64:
      break;
  }
  return load(double{});
}

template <typename Number>
void appendNumber(std::string& text, Number value)
{
  char buffer[32];
  const std::to_chars_result end = std::to_chars(buffer, buffer + sizeof buffer, value);
  text.append(buffer, end.ptr);
}
} // namespace

int decimalsOf(double scale, double offset)
{
  for (int decimals = 0; decimals <= mostDecimals; ++decimals)
  {
    if (scale * std::pow(10.0, decimals) > 0.5 && isDecimal(scale, decimals) &&
      isDecimal(offset, decimals))
    {
      return decimals;
    }
  }
  const int magnitude = static_cast<int>(std::ceil(-std::log10(std::abs(scale))));
  return std::max(magnitude, 0) + 1;
}

void appendFixed(std::string& text, double value, int decimals)
{
  char buffer[400]; // a double has up to 309 digits before the point
  const std::to_chars_result end =
    std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, decimals);
  text.append(buffer, end.ptr);
}

void appendScalar(std::string& text, ScalarType type, const std::byte* from)
{
  visitScalar(type, from, [&text](auto value) { appendNumber(text, value); });
}

double scalarValue(ScalarType type, const std::byte* from)
{
  return visitScalar(type, from, [](auto value) { return static_cast<double>(value); });
}

} // namespace pointfront
