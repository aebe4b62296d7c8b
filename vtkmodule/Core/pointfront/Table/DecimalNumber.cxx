#include "pointfront/Table/DecimalNumber.h"

#include "pointfront/Base/LetterCase.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <string>

namespace pointfront
{
namespace
{
/// A mantissa below 2^53 times or by one of these is rounded once: the nearest double (Clinger
/// 1990, "How to read floating point numbers accurately", the fast path).
constexpr double powersOfTen[] = { 1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11,
  1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22 };
constexpr int exactPowers = 22;
constexpr std::uint64_t exactMantissa = 1ull << 53;

bool isDigit(char c)
{
  return c >= '0' && c <= '9';
}

/// nan, nan(ind), 1.#QNAN, inf, infinity, 1.#INF behind the sign.
const char* readSpecial(const char* text, const char* end, bool negative, DecimalNumber& number)
{
  const double infinity = std::numeric_limits<double>::infinity();
  struct Word
  {
    const char* spelling;
    int length;
    bool infinite;
  };
  static const Word words[] = { { "nan(ind)", 8, false }, { "nan(snan)", 9, false },
    { "nan", 3, false }, { "infinity", 8, true }, { "inf", 3, true }, { "1.#qnan", 7, false },
    { "1.#snan", 7, false }, { "1.#ind", 6, false }, { "1.#inf", 6, true } };
  for (const Word& word : words)
  {
    const auto length = static_cast<std::size_t>(word.length);
    const std::size_t there = std::min(length, static_cast<std::size_t>(end - text));
    if (sameWithoutCase({ text, there }, word.spelling))
    {
      number = DecimalNumber{};
      number.value = word.infinite ? (negative ? -infinity : infinity)
                                   : std::numeric_limits<double>::quiet_NaN();
      return text + word.length;
    }
  }
  return nullptr;
}

/// The digits of a number as they are met.
struct Digits
{
  std::uint64_t mantissa = 0; ///< the first 19 significant digits
  int kept = 0; ///< digits in it, leading zeros not
  int dropped = 0; ///< further integer digits
  int trailingZeros = 0; ///< at the end of all that were seen
  int significant = 0;
  bool any = false;

  void add(char c)
  {
    any = true;
    if (c == '0' && significant == 0)
    {
      return;
    }
    ++significant;
    trailingZeros = c == '0' ? trailingZeros + 1 : 0;
    if (kept < 19)
    {
      mantissa = mantissa * 10 + static_cast<unsigned>(c - '0');
      ++kept;
    }
    else
    {
      ++dropped;
    }
  }
};

/// An exponent behind the digits, if a whole one is there.
const char* readExponent(const char* text, const char* end, int& exponent)
{
  if (text == end || (*text != 'e' && *text != 'E' && *text != 'd' && *text != 'D'))
  {
    return text;
  }
  const char* p = text + 1;
  const bool negative = p != end && *p == '-';
  p += p != end && (*p == '-' || *p == '+') ? 1 : 0;
  if (p == end || !isDigit(*p))
  {
    return text;
  }
  int value = 0;
  for (; p != end && isDigit(*p); ++p)
  {
    value = std::min(value * 10 + (*p - '0'), 100000);
  }
  exponent = negative ? -value : value;
  return p;
}

/// For what the fast path cannot do exactly: the library, on a copy in C's spelling.
double readSlowly(const char* text, const char* end, char point, bool negative)
{
  std::string copy(text, end);
  for (char& c : copy)
  {
    c = c == point ? '.' : (c == 'd' || c == 'D' ? 'e' : c);
  }
  double value = 0.0;
  const auto read = std::from_chars(copy.data(), copy.data() + copy.size(), value);
  if (read.ec == std::errc::result_out_of_range)
  {
    // Too small or too large for a double: the sign of the exponent tells which.
    const std::size_t e = copy.find_first_of("eE");
    const bool small = e != std::string::npos ? copy[e + 1] == '-' : copy[0] == '0';
    value = small ? 0.0 : std::numeric_limits<double>::infinity();
  }
  return negative ? -value : value;
}
} // namespace

const char* readDecimal(const char* text, const char* end, char point, DecimalNumber& number)
{
  const char* p = text;
  const bool negative = p != end && *p == '-';
  p += p != end && (*p == '-' || *p == '+') ? 1 : 0;
  const char* const begin = p;
  Digits digits;
  for (; p != end && isDigit(*p); ++p)
  {
    digits.add(*p);
  }
  int places = 0;
  number.pointSeen = false;
  if (p != end && *p == point)
  {
    const char* const afterPoint = ++p;
    for (; p != end && isDigit(*p); ++p)
    {
      digits.add(*p);
    }
    places = static_cast<int>(std::min<std::ptrdiff_t>(p - afterPoint, 1 << 20));
    number.pointSeen = true;
  }
  if (!digits.any || (p != end && *p == '#'))
  {
    const char* special = readSpecial(begin, end, negative, number);
    return special != nullptr ? special : text;
  }
  int exponent = 0;
  const char* const behind = readExponent(p, end, exponent);
  number.pointSeen = number.pointSeen || behind != p;
  const bool zero = digits.significant == 0;
  number.decimals = zero ? 0 : std::max(0, places - digits.trailingZeros - exponent);
  number.digits = std::max(1, digits.significant - digits.trailingZeros);
  number.magnitude = digits.mantissa;
  number.integer = !number.pointSeen &&
    (digits.dropped == 0 ||
      (digits.dropped == 1 && std::from_chars(begin, behind, number.magnitude).ec == std::errc()));
  const int power = exponent - places + digits.dropped;
  if (zero)
  {
    number.value = negative ? -0.0 : 0.0;
  }
  else if (digits.dropped == 0 && digits.mantissa < exactMantissa && power >= -exactPowers &&
    power <= exactPowers)
  {
    const auto mantissa = static_cast<double>(digits.mantissa);
    const double value = power < 0 ? mantissa / powersOfTen[-power] : mantissa * powersOfTen[power];
    number.value = negative ? -value : value;
  }
  else
  {
    number.value = readSlowly(begin, behind, point, negative);
  }
  return behind;
}

} // namespace pointfront
