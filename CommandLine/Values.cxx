#include "Values.h"

#include "ByteSize.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <system_error>

namespace pointfront
{

namespace
{
constexpr int largestImageEdge = 65535;

std::optional<double> parseNumber(const std::string& text)
{
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || end != text.c_str() + text.size() || !std::isfinite(value))
  {
    return std::nullopt;
  }
  return value;
}

/// Decimal digits only.
std::optional<long> parseCount(const std::string& text)
{
  const bool digits = !text.empty() && text.size() < 10 &&
    std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  return digits ? std::optional<long>(std::strtol(text.c_str(), nullptr, 10)) : std::nullopt;
}
} // namespace

std::vector<std::string> splitList(const std::string& text)
{
  std::vector<std::string> words;
  std::string::size_type begin = 0;
  while (begin <= text.size())
  {
    const std::string::size_type end = std::min(text.find(',', begin), text.size());
    if (end > begin)
    {
      words.push_back(text.substr(begin, end - begin));
    }
    begin = end + 1;
  }
  return words;
}

template <std::size_t N>
std::optional<std::array<double, N>> parseNumbers(const std::string& text)
{
  const std::vector<std::string> words = splitList(text);
  std::array<double, N> numbers{};
  if (words.size() != N)
  {
    return std::nullopt;
  }
  for (std::size_t i = 0; i < N; ++i)
  {
    const std::optional<double> number = parseNumber(words[i]);
    if (!number)
    {
      return std::nullopt;
    }
    numbers[i] = *number;
  }
  return numbers;
}
template std::optional<std::array<double, 1>> parseNumbers<1>(const std::string&);
template std::optional<std::array<double, 3>> parseNumbers<3>(const std::string&);
template std::optional<std::array<double, 4>> parseNumbers<4>(const std::string&);
template std::optional<std::array<double, 6>> parseNumbers<6>(const std::string&);

std::optional<std::vector<std::uint8_t>> parseClasses(const std::string& text)
{
  std::vector<std::uint8_t> classes;
  for (const std::string& word : splitList(text))
  {
    const std::optional<long> code = parseCount(word);
    if (!code || *code > 255)
    {
      return std::nullopt;
    }
    classes.push_back(static_cast<std::uint8_t>(*code));
  }
  std::sort(classes.begin(), classes.end());
  classes.erase(std::unique(classes.begin(), classes.end()), classes.end());
  return classes.empty() ? std::nullopt : std::make_optional(std::move(classes));
}

std::optional<std::array<int, 2>> parseImageSize(const std::string& text)
{
  const std::string::size_type cross = text.find('x');
  if (cross == std::string::npos)
  {
    return std::nullopt;
  }
  const std::optional<long> width = parseCount(text.substr(0, cross));
  const std::optional<long> height = parseCount(text.substr(cross + 1));
  const auto fits = [](const std::optional<long>& edge)
  { return edge && *edge >= 1 && *edge <= largestImageEdge; };
  if (!fits(width) || !fits(height))
  {
    return std::nullopt;
  }
  return std::array<int, 2>{ static_cast<int>(*width), static_cast<int>(*height) };
}

CLI::Validator positiveNumber()
{
  const auto check = [](std::string& text) -> std::string
  {
    const auto number = parseNumbers<1>(text);
    return number && (*number)[0] > 0.0
      ? std::string()
      : "'" + text.substr(0, 40) + "' is not a number above 0 that has an end";
  };
  return CLI::Validator(check, "POSITIVE");
}

CLI::Validator numberBetween(double low, double high)
{
  std::ostringstream limits;
  limits << low << " to " << high;
  const auto check = [low, high, told = limits.str()](std::string& text) -> std::string
  {
    const auto number = parseNumbers<1>(text);
    return number && (*number)[0] >= low && (*number)[0] <= high
      ? std::string()
      : "'" + text.substr(0, 40) + "' is not a number from " + told;
  };
  return CLI::Validator(check, "FLOAT in [" + limits.str() + "]");
}

CLI::Validator someWords(const std::string& hint)
{
  return CLI::Validator([hint](const std::string& text)
    { return splitList(text).empty() ? "'" + text + "' names nothing; " + hint : std::string(); },
    "");
}

CLI::Validator wholeNumberOf64Bits()
{
  const auto check = [](std::string& text) -> std::string
  {
    std::uint64_t number = 0;
    const char* const end = text.data() + text.size();
    const std::from_chars_result read = std::from_chars(text.data(), end, number);
    return read.ec == std::errc() && read.ptr == end
      ? std::string()
      : "'" + text.substr(0, 40) + "' is no whole number from 0 to 18446744073709551615";
  };
  return CLI::Validator(check, "");
}

CLI::Validator wholeNumber()
{
  const auto check = [](std::string& text) -> std::string
  {
    constexpr std::size_t mostDigits = 15;
    const auto isCount = [](const std::string& digits)
    {
      return !digits.empty() && digits.size() <= mostDigits &&
        digits.find_first_not_of("0123456789") == std::string::npos;
    };
    const std::optional<double> number = parseNumber(text);
    const bool scientific = number && *number >= 0.0 && *number < 1e15 &&
      std::floor(*number) == *number && text.find_first_not_of("0123456789.eE+") == text.npos;
    if (!isCount(text) && scientific)
    {
      text = std::to_string(static_cast<std::uint64_t>(*number));
    }
    if (isCount(text))
    {
      return {};
    }
    const std::string refused = "'" + text.substr(0, 40) + "' is not a count: ";
    const std::size_t unit = text.empty() ? 0 : std::string("kMGT").find(text.back());
    const bool shortened = unit < 4 && isCount(text.substr(0, text.size() - 1));
    return shortened
      ? refused + "write " + text.substr(0, text.size() - 1) + "e" + std::to_string(3 * (unit + 1))
      : refused + "0, 1, 2 ... 1e6 ...";
  };
  return CLI::Validator(check, "COUNT");
}

CLI::Option* addByteSize(
  CLI::App& app, const std::string& option, std::uint64_t& bytes, const std::string& description)
{
  const CLI::callback_t parse = [option, &bytes](const CLI::results_t& words) -> bool
  {
    const std::optional<std::uint64_t> size = parseByteSize(words.back());
    if (!size)
    {
      const std::string shown = words.back().substr(0, 40);
      throw CLI::ParseError(isByteSizeOutOfRange(words.back())
          ? option + ": '" + shown + "' is out of range: 1 byte to 8E"
          : option + ": '" + shown + "' is not a size in bytes: write 512M or 4G",
        2);
    }
    bytes = *size;
    return true;
  };
  return app.add_option(option, parse, description)->type_name("BYTES")->expected(1);
}

} // namespace pointfront
