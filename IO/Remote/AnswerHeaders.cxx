#include "AnswerHeaders.h"

#include "pointfront/Base/LetterCase.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string>

namespace pointfront
{
namespace
{
constexpr std::chrono::milliseconds longestAskedPause{ 30000 };
constexpr std::int64_t mostSeconds = std::int64_t(366) * 24 * 3600;

/// Small letters without blanks.
std::string plainWords(const std::string& text)
{
  std::string plain = lowered(text);
  const auto isBlank = [](char letter) { return letter == ' ' || letter == '\t'; };
  plain.erase(std::remove_if(plain.begin(), plain.end(), isBlank), plain.end());
  return plain;
}

std::optional<std::int64_t> secondsOf(std::string text)
{
  if (text.size() > 1 && text.front() == '"' && text.back() == '"')
  {
    text = text.substr(1, text.size() - 2);
  }
  std::int64_t seconds = 0;
  const char* const end = text.data() + text.size();
  const auto [stopped, fault] = std::from_chars(text.data(), end, seconds);
  const bool sound = fault == std::errc() && stopped == end && seconds >= 0;
  return sound ? std::optional<std::int64_t>(seconds) : std::nullopt;
}

/// A word as object stores write codes and regions. Anything else is let go: a server's text need
/// not be fit for a message.
std::string soundWord(const std::string& text)
{
  const bool sound = text.size() <= 60 &&
    std::all_of(text.begin(), text.end(),
      [](char letter) { return isAsciiLetterOrDigit(letter) || letter == '-' || letter == '_'; });
  return sound ? text : std::string();
}

std::string elementOf(const std::string& words, const std::string& name)
{
  const std::string open = '<' + name + '>';
  const std::size_t at = words.find(open);
  const std::size_t end = at == std::string::npos ? at : words.find('<', at + open.size());
  return end == std::string::npos
    ? std::string()
    : soundWord(words.substr(at + open.size(), end - at - open.size()));
}
} // namespace

std::chrono::milliseconds askedPause(const HttpAnswer& answer)
{
  const std::string text = answer.header("retry-after");
  const long seconds = text.empty() ? 0 : std::strtol(text.c_str(), nullptr, 10);
  return std::clamp(std::chrono::milliseconds(1000 * std::clamp(seconds, 0L, 3600L)),
    std::chrono::milliseconds(0), longestAskedPause);
}

std::chrono::seconds unchangedFor(const HttpAnswer& answer)
{
  const std::string age = answer.header("age");
  std::istringstream words(plainWords(answer.header("cache-control")));
  std::int64_t lasts = 0;
  bool immutable = false;
  for (std::string word; std::getline(words, word, ',');)
  {
    if (word == "no-store" || word.compare(0, 8, "no-cache") == 0)
    {
      return {};
    }
    immutable = immutable || word == "immutable";
    if (word.compare(0, 8, "max-age=") == 0)
    {
      lasts = std::min(secondsOf(word.substr(8)).value_or(0), mostSeconds);
    }
  }
  const std::optional<std::int64_t> passed = age.empty() ? 0 : secondsOf(plainWords(age));
  const bool promised = immutable && passed && *passed < lasts;
  return std::chrono::seconds(promised ? lasts - *passed : 0);
}

std::string faultCode(const HttpAnswer& answer)
{
  return elementOf(answer.words, "Code");
}

std::string bucketRegion(const HttpAnswer& answer)
{
  const std::string region = soundWord(answer.header("x-amz-bucket-region"));
  return region.empty() ? elementOf(answer.words, "Region") : region;
}

} // namespace pointfront
