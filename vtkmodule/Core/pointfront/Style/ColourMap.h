#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace pointfront
{

/// Red, green, blue, alpha, 0 to 255.
using Rgba8 = std::array<std::uint8_t, 4>;

/// From a world value to a colour: equal steps over a range, or one entry for each whole number.
/// Threads  a value.
struct ColourMap
{
  std::vector<Rgba8> entries; ///< at least one
  std::array<double, 2> range{ 0.0, 1.0 }; ///< low end of the first entry, high end of the last one
  bool logarithmic = false; ///< equal steps of log10; range > 0 then
  /// Whole numbers from range[0] on have an entry each; values between two are missing, and so are
  /// other numbers.
  bool indexed = false;
  Rgba8 below{ 0, 0, 0, 255 };
  Rgba8 above{ 255, 255, 255, 255 };
  Rgba8 missing{ 127, 0, 0, 255 }; ///< NaN, and what an indexed map does not have
  bool usesBelow = false; ///< else the first entry
  bool usesAbove = false; ///< else the last one

  Rgba8 at(double value) const;

  friend bool operator==(const ColourMap& a, const ColourMap& b)
  {
    return a.entries == b.entries && a.range == b.range && a.logarithmic == b.logarithmic &&
      a.indexed == b.indexed && a.below == b.below && a.above == b.above &&
      a.missing == b.missing && a.usesBelow == b.usesBelow && a.usesAbove == b.usesAbove;
  }
};

} // namespace pointfront
