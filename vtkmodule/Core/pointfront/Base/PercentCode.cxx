#include "pointfront/Base/PercentCode.h"

#include "pointfront/Base/LetterCase.h"

namespace pointfront
{
namespace
{
constexpr std::string_view hexDigits = "0123456789ABCDEF";

/// 16 and above: it is none.
std::size_t hexValue(char digit)
{
  const char capital = digit >= 'a' && digit <= 'f' ? static_cast<char>(digit - 'a' + 'A') : digit;
  return hexDigits.find(capital);
}
} // namespace

std::string percentEncoded(std::string_view text, std::string_view kept)
{
  std::string made;
  for (const char letter : text)
  {
    if (isAsciiLetterOrDigit(letter) || kept.find(letter) != std::string_view::npos)
    {
      made += letter;
      continue;
    }
    const auto byte = static_cast<unsigned char>(letter);
    made += '%';
    made += hexDigits[byte / 16];
    made += hexDigits[byte % 16];
  }
  return made;
}

bool isPercentCode(std::string_view text, std::size_t at)
{
  return at + 2 < text.size() && text[at] == '%' && hexValue(text[at + 1]) < 16 &&
    hexValue(text[at + 2]) < 16;
}

std::string percentDecoded(std::string_view text)
{
  std::string made;
  for (std::size_t at = 0; at < text.size(); ++at)
  {
    const bool code = isPercentCode(text, at);
    made +=
      code ? static_cast<char>(16 * hexValue(text[at + 1]) + hexValue(text[at + 2])) : text[at];
    at += code ? 2 : 0;
  }
  return made;
}

} // namespace pointfront
