#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace pointfront
{

/// Facts about all values of one field. NaN and infinities count for `notFinite` only.
struct FieldStatistics
{
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  std::uint64_t notFinite = 0; ///< values that are NaN or infinite
  bool whole = true; ///< every one is an integer
  double off255 = 0.0; ///< farthest that a value * 255 is from an integer: colours
  int decimals = 0; ///< text: most places after the point, trailing zeros left out
  int digits = 0; ///< text: most significant digits
  bool pointSeen = false; ///< text: a decimal point or an exponent is written somewhere
  bool integers = true; ///< text: 64 bits hold every number, with or without a sign
  bool beyondInt64 = false; ///< text: some integer is above 2^63 - 1
  bool rounded = false; ///< text: some number without a point is no double

  bool empty() const { return low > high; }
  /// Text of integers alone, some of which doubles may round.
  bool wideIntegers() const
  {
    constexpr double exact = 9007199254740992.0; // 2^53
    return digits > 0 && integers && !(beyondInt64 && low < 0.0) && (high > exact || low < -exact);
  }
  void add(double value)
  {
    if (!std::isfinite(value))
    {
      ++notFinite;
      return;
    }
    low = std::min(low, value);
    high = std::max(high, value);
    whole = whole && value == std::trunc(value);
    const double scaled = value * 255.0;
    off255 = std::max(off255, std::abs(scaled - std::nearbyint(scaled)));
  }
  void add(const FieldStatistics& other)
  {
    low = std::min(low, other.low);
    high = std::max(high, other.high);
    notFinite += other.notFinite;
    whole = whole && other.whole;
    off255 = std::max(off255, other.off255);
    decimals = std::max(decimals, other.decimals);
    digits = std::max(digits, other.digits);
    pointSeen = pointSeen || other.pointSeen;
    integers = integers && other.integers;
    beyondInt64 = beyondInt64 || other.beyondInt64;
    rounded = rounded || other.rounded;
  }
};

} // namespace pointfront
