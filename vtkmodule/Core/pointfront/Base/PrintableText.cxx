#include "pointfront/Base/PrintableText.h"

namespace pointfront
{
namespace
{
/// Bytes of the UTF-8 sequence that begins with `lead`; 0 when none does.
std::size_t sequenceLength(unsigned char lead)
{
  if (lead < 0x80)
  {
    return 1;
  }
  if (lead >= 0xC2 && lead <= 0xDF)
  {
    return 2;
  }
  if (lead >= 0xE0 && lead <= 0xEF)
  {
    return 3;
  }
  return lead >= 0xF0 && lead <= 0xF4 ? 4 : 0;
}

/// Rejects what a lead byte alone does not: overlong forms, surrogates, beyond U+10FFFF.
bool secondByteAllowed(unsigned char lead, unsigned char second)
{
  switch (lead)
  {
    case 0xE0:
      return second >= 0xA0;
    case 0xED:
      return second <= 0x9F;
    case 0xF0:
      return second >= 0x90;
    case 0xF4:
      return second <= 0x8F;
    default:
      return true;
  }
}

bool isUtf8(const std::string& text)
{
  for (std::size_t i = 0; i < text.size();)
  {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t length = sequenceLength(lead);
    if (length == 0 || i + length > text.size())
    {
      return false;
    }
    for (std::size_t k = 1; k < length; ++k)
    {
      const auto next = static_cast<unsigned char>(text[i + k]);
      if ((next & 0xC0) != 0x80 || (k == 1 && !secondByteAllowed(lead, next)))
      {
        return false;
      }
    }
    i += length;
  }
  return true;
}
} // namespace

std::string printableText(std::string text)
{
  const bool utf8 = isUtf8(text);
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    char& c = text[i];
    const auto byte = static_cast<unsigned char>(c);
    if (utf8 && byte == 0xC2 && static_cast<unsigned char>(text[i + 1]) < 0xA0)
    {
      text.replace(i, 2, "_"); // U+0080 to U+009F: what some terminals obey
      continue;
    }
    if (byte == '\t' || byte == '\n' || byte == '\r')
    {
      c = ' ';
    }
    else if (byte < 0x20 || byte == 0x7F || (byte > 0x7F && !utf8))
    {
      c = '_';
    }
  }
  return text;
}

} // namespace pointfront
