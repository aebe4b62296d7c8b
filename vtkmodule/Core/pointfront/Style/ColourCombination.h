#pragma once

#include "pointfront/Style/ColourMap.h"

#include <algorithm>
#include <cstdint>

namespace pointfront
{

/// How two colours of one point are combined.
enum class ColourCombination : std::uint8_t
{
  None, ///< there is one only
  Multiply, ///< channel by channel: white leaves the first as it is
  Mix, ///< (1 - share) * first + share * second
  HueValue ///< hue and saturation of the first, value (largest channel) of the second
};

/// Alpha is the first one's.
/// Exactness  integers, rounded to nearest: the same on every machine. `share256` is Mix's share in
///            parts of 256, 0 to 256. A first colour that is black has no hue: HueValue gives grey.
/// Source     Smith 1978, "Color gamut transform pairs": HSV.
inline Rgba8 combined(
  ColourCombination combination, std::uint32_t share256, const Rgba8& first, const Rgba8& second)
{
  Rgba8 result = first;
  const std::uint32_t brightest = std::max({ first[0], first[1], first[2] });
  const std::uint32_t value = std::max({ second[0], second[1], second[2] });
  for (std::size_t channel = 0; channel < 3; ++channel)
  {
    const std::uint32_t a = first[channel];
    const std::uint32_t b = second[channel];
    std::uint32_t c = a;
    switch (combination)
    {
      case ColourCombination::None:
        break;
      case ColourCombination::Multiply:
        c = (a * b + 127) / 255;
        break;
      case ColourCombination::Mix:
        c = (a * (256 - share256) + b * share256 + 128) / 256;
        break;
      case ColourCombination::HueValue:
        c = brightest > 0 ? (a * value + brightest / 2) / brightest : value;
        break;
    }
    result[channel] = static_cast<std::uint8_t>(c);
  }
  return result;
}

} // namespace pointfront
