#include "ByteSize.h"

#include "pointfront/Base/LetterCase.h"

#include <cctype>
#include <cmath>
#include <cstdio>

namespace pointfront
{

namespace
{
/// 1024^n of a unit such as "m", "mb", "mib" (lower case); nothing if it is none.
std::optional<double> unitFactor(const std::string& unit)
{
  if (unit.empty() || unit == "b")
  {
    return 1.0;
  }
  const std::string::size_type power = std::string("kmgt").find(unit[0]);
  const std::string rest = unit.substr(1);
  if (power == std::string::npos || !(rest.empty() || rest == "b" || rest == "ib"))
  {
    return std::nullopt;
  }
  return std::pow(1024.0, static_cast<double>(power) + 1.0);
}
} // namespace

namespace
{
/// Bytes, whatever their number; nothing for text that is no size.
std::optional<double> readByteSize(const std::string& text)
{
  std::string::size_type end = 0;
  int dots = 0;
  for (; end < text.size(); ++end)
  {
    const auto c = static_cast<unsigned char>(text[end]);
    dots += c == '.' ? 1 : 0;
    if (!std::isdigit(c) && c != '.')
    {
      break;
    }
  }
  if (end == 0 || dots > 1 || text[0] == '.' || text[end - 1] == '.')
  {
    return std::nullopt;
  }
  const std::optional<double> factor = unitFactor(lowered(text.substr(end)));
  return factor ? std::optional<double>(std::floor(std::strtod(text.c_str(), nullptr) * *factor))
                : std::nullopt;
}

bool inRange(double bytes)
{
  return bytes >= 1.0 && bytes < 9.2e18;
}
} // namespace

bool isByteSizeOutOfRange(const std::string& text)
{
  char* end = nullptr;
  const double plain = std::strtod(text.c_str(), &end); // 1e300
  const bool beyond = !text.empty() && *end == '\0' && plain >= 9.2e18;
  const std::optional<double> bytes = readByteSize(text);
  return beyond || (bytes && !inRange(*bytes));
}

std::optional<std::uint64_t> parseByteSize(const std::string& text)
{
  const std::optional<double> bytes = readByteSize(text);
  return bytes && inRange(*bytes) ? std::optional<std::uint64_t>(static_cast<std::uint64_t>(*bytes))
                                  : std::nullopt;
}

std::string byteSizeText(std::uint64_t bytes)
{
  const char* const units[] = { "B", "KiB", "MiB", "GiB", "TiB", "PiB" };
  double value = static_cast<double>(bytes);
  int unit = 0;
  for (; value >= 1024.0 && unit < 5; ++unit)
  {
    value /= 1024.0;
  }
  char text[32];
  std::snprintf(text, sizeof(text), unit == 0 ? "%.0f %s" : "%.1f %s", value, units[unit]);
  return text;
}

} // namespace pointfront
