#pragma once

#include <CLI/CLI.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// Values of options that are more than a number. Each parser gives nothing for wrong text.

/// An empty condition comes of a script's unset variable, and would take all points.
inline constexpr const char* noCondition =
  "the condition is empty; leave --where out if all points are meant";

/// "2,6,9" -> the words between the commas; empty words are left out.
std::vector<std::string> splitList(const std::string& text);
/// "1,2.5,-3" -> exactly N finite numbers.
template <std::size_t N>
std::optional<std::array<double, N>> parseNumbers(const std::string& text);
/// "2,6" -> class codes from 0 to 255, sorted, once each.
std::optional<std::vector<std::uint8_t>> parseClasses(const std::string& text);
/// "1280x720" -> width and height, 1 to 65535 pixels.
std::optional<std::array<int, 2>> parseImageSize(const std::string& text);

/// Check for an option that is a length or the like: finite, above 0.
CLI::Validator positiveNumber();
/// Check for an option with a smallest and a largest value; what is no number is refused, "nan"
/// too.
CLI::Validator numberBetween(double low, double high);
/// Check for a list that names something: a script's unset variable does not.
CLI::Validator someWords(const std::string& hint);
/// Transformation for an option that counts: decimal digits, at most 15, of these or of "1e6".
CLI::Validator wholeNumber();
/// Check for a number that may be any of 64 bits, as seeds are.
CLI::Validator wholeNumberOf64Bits();

/// An option of bytes: "512M", "4G". Wrong text is wrong usage.
CLI::Option* addByteSize(
  CLI::App& app, const std::string& option, std::uint64_t& bytes, const std::string& description);

} // namespace pointfront
