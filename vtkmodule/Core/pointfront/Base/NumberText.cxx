#include "pointfront/Base/NumberText.h"

#include <array>
#include <charconv>
#include <limits>

namespace pointfront
{

double takeNumber(std::string_view& text)
{
  double value = 0.0;
  const char* const begin = text.data();
  const auto [end, failure] = std::from_chars(begin, begin + text.size(), value);
  if (failure != std::errc())
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  text.remove_prefix(static_cast<std::size_t>(end - begin));
  return value;
}

std::string numberText(double value, int digits)
{
  std::array<char, 64> text;
  const auto end =
    std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits)
      .ptr;
  return { text.data(), end };
}

std::string decimalText(double value, int decimals)
{
  std::array<char, 400> text; // the largest double has 309 digits before the point
  const auto end =
    std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, decimals)
      .ptr;
  return { text.data(), end };
}

} // namespace pointfront
