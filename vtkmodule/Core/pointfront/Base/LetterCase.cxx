#include "pointfront/Base/LetterCase.h"

#include <algorithm>
#include <filesystem>

namespace pointfront
{
namespace
{
char smallLetter(char letter)
{
  return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

char capitalLetter(char letter)
{
  return letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
}

bool sameLetter(char a, char b)
{
  return smallLetter(a) == smallLetter(b);
}
} // namespace

std::string lowered(std::string_view text)
{
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), smallLetter);
  return result;
}

std::string capitals(std::string_view text)
{
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), capitalLetter);
  return result;
}

bool isAsciiLetter(char c)
{
  const char small = smallLetter(c);
  return small >= 'a' && small <= 'z';
}

bool isAsciiLetterOrDigit(char c)
{
  return isAsciiLetter(c) || (c >= '0' && c <= '9');
}

bool isAsciiSpace(char c)
{
  return c == ' ' || (c >= '\t' && c <= '\r');
}

bool sameWithoutCase(std::string_view a, std::string_view b)
{
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), sameLetter);
}

bool endsWithoutCase(std::string_view text, std::string_view end)
{
  return text.size() >= end.size() && sameWithoutCase(text.substr(text.size() - end.size()), end);
}

std::string loweredExtension(const std::string& path)
{
  return lowered(std::filesystem::path(path).extension().string());
}

} // namespace pointfront
