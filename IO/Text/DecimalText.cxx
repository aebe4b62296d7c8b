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

template <typename Number>
Number loaded(const std::byte* from)
{
  Number value;
  std::memcpy(&value, from, sizeof value);
  return value;
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
  visitScalar(type, [&](auto zero) { appendNumber(text, loaded<decltype(zero)>(from)); });
}

double scalarValue(ScalarType type, const std::byte* from)
{
  return visitScalar(
    type, [from](auto zero) { return static_cast<double>(loaded<decltype(zero)>(from)); });
}

} // namespace pointfront
