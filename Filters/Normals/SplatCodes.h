#pragma once

#include "pointfront/Points/SplatRadius.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace pointfront
{

/// A radius as it waits for the base of the store, which is known when all radii are: steps of
/// 2^(1/16), for all numbers that a float has; 0 unknown.
using WaitingRadius = std::uint16_t;

/// Rounds up.
WaitingRadius waitingRadius(double radius);

/// Counts how often each radius occurs, and chooses the base.
/// Threads  count() from any; base() when all have counted. The result does not depend on them.
class SplatCodes
{
public:
  void count(WaitingRadius radius);
  /// A power of two. 0 if no radius was counted. All radii can be told if the largest is less than
  /// 2^15.8 times the smallest, else those around the median.
  double base() const;

private:
  static constexpr std::size_t shares = 16; ///< so that threads do not wait for one another
  static constexpr std::size_t codes = 1 << 12;
  std::array<std::array<std::atomic<std::uint32_t>, codes>, shares> counts_{};
};

/// The byte of a radius, `base` being a power of two.
std::uint8_t splatCode(WaitingRadius radius, double base);

} // namespace pointfront
