#pragma once

#include <cstdint>

namespace pointfront
{

/// Largest value of a colour of 8 bits.
constexpr std::uint16_t largestOf8Bits = 255;

/// A colour of 8 bits as one of 16. A larger one stays: it has 16 bits already, although whoever
/// looked at a sample of its file may have missed that.
constexpr std::uint16_t widenedColour(std::uint16_t value)
{
  return value <= largestOf8Bits ? static_cast<std::uint16_t>(257u * value) : value;
}

} // namespace pointfront
