#pragma once

#include "pointfront/Points/AttributeSchema.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace pointfront
{

/// Name of the column that tells how large a disc around each point must be for the surface to
/// close when all points are drawn: one byte a point, a code of `decodeSplatRadius`.
constexpr const char* splatRadiusAttribute = "splat_radius";

/// Code of a point whose radius is not known; 1 to 255 are radii.
constexpr std::uint8_t unknownSplatRadius = 0;

inline Attribute splatRadiusColumn()
{
  Attribute column;
  column.name = splatRadiusAttribute;
  column.type = ScalarType::UInt8;
  column.description = "radius that closes the surface, 16 codes to a doubling; 0 unknown";
  return column;
}

namespace splat
{
constexpr int codesPerDoubling = 16;
constexpr int codeOfBase = 128;

/// 2^(i/16), rounded to the nearest double: the same on every machine, unlike exp2.
constexpr std::array<double, codesPerDoubling> sixteenths = { 1.0, 1.0442737824274138,
  1.0905077326652577, 1.1387886347566916, 1.189207115002721, 1.2418578120734840, 1.2968395546510096,
  1.3542555469368927, 1.4142135623730951, 1.4768261459394993, 1.5422108254079407,
  1.6104903319492543, 1.6817928305074292, 1.7562521603732995, 1.8340080864093424,
  1.9152065613971474 };
} // namespace splat

/// Units  world units: base * 2^((code - 128) / 16). 0 for code 0, and where the store has no base.
/// Range  base / 245 to base * 245.
inline float decodeSplatRadius(std::uint8_t code, double base)
{
  if (code == unknownSplatRadius)
  {
    return 0.0f;
  }
  const int steps = code - splat::codeOfBase + 16 * splat::codesPerDoubling; // not negative
  const auto step = static_cast<std::size_t>(steps % splat::codesPerDoubling);
  const double radius =
    std::ldexp(base * splat::sixteenths[step], steps / splat::codesPerDoubling - 16);
  return static_cast<float>(
    std::min<double>(radius, std::numeric_limits<float>::max())); // where no float is larger
}

/// The smallest code whose radius is not smaller than `radius` (at most 4.5 % larger), or the
/// largest code if there is none. 0 (unknown) without a base, and for a radius that is not a
/// positive number.
inline std::uint8_t encodeSplatRadius(double radius, double base)
{
  if (!(radius > 0.0) || !(base > 0.0) || !std::isfinite(base))
  {
    return unknownSplatRadius;
  }
  const double ratio = std::clamp(radius / base, 1.0 / 512.0, 512.0); // beyond all codes
  int exponent = 0;
  const double mantissa = 2.0 * std::frexp(ratio, &exponent); // 1 to 2, times 2^(exponent - 1)
  std::size_t step = 0;
  while (step < splat::sixteenths.size() && splat::sixteenths[step] < mantissa)
  {
    ++step;
  }
  int code = splat::codeOfBase + splat::codesPerDoubling * (exponent - 1) + static_cast<int>(step);
  code = std::clamp(code, 1, 255);
  // The quotient is rounded, and so are radii, to float: what they are decoded to decides.
  const auto covers = [&](int smaller)
  { return decodeSplatRadius(static_cast<std::uint8_t>(smaller), base) >= radius; };
  if (code > 1 && covers(code - 1))
  {
    --code;
  }
  else if (code < 255 && !covers(code))
  {
    ++code;
  }
  return static_cast<std::uint8_t>(code);
}

} // namespace pointfront
