#pragma once

#include <string>
#include <string_view>

namespace pointfront
{

/// The number that begins the text, which then begins behind it; NaN, and the text stays, if none
/// does. A number has a decimal point, whatever the process's locale writes in its place.
double takeNumber(std::string_view& text);

/// So many significant digits, with a decimal point: "0.25", "1e+20".
std::string numberText(double value, int digits);

/// So many decimals, with a decimal point: "0.250", "12".
std::string decimalText(double value, int decimals);

} // namespace pointfront
