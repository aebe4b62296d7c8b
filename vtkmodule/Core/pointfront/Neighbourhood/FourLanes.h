#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace pointfront
{

/// Four numbers in one register of any machine that has such (GCC's and Clang's vector types); the
/// usual operators work on each. Comparisons give FourLanes: all bits of a lane set where true.
using FourFloats = float __attribute__((vector_size(16)));
using FourLanes = std::int32_t __attribute__((vector_size(16)));

inline FourFloats fourFrom(const float* first)
{
  FourFloats four;
  std::memcpy(&four, first, sizeof four);
  return four;
}

inline FourFloats fourTimes(float value)
{
  return FourFloats{ value, value, value, value };
}

/// Bit i: lane i is set. The lanes are the result of a comparison.
inline std::size_t bitsOf(FourLanes lanes)
{
#if defined(__SSE2__)
  FourFloats signs;
  std::memcpy(&signs, &lanes, sizeof signs);
  return static_cast<std::size_t>(__builtin_ia32_movmskps(signs));
#else
  return static_cast<std::size_t>(
    (lanes[0] & 1) | (lanes[1] & 2) | (lanes[2] & 4) | (lanes[3] & 8));
#endif
}

/// For each such set of bits: the lanes that are set, in order, and how many they are.
struct LanesSet
{
  std::array<std::array<std::int32_t, 4>, 16> lanes{};
  std::array<std::uint8_t, 16> count{};
  constexpr LanesSet()
  {
    for (std::size_t bits = 0; bits < lanes.size(); ++bits)
    {
      for (std::int32_t lane = 0; lane < 4; ++lane)
      {
        if ((bits >> lane & 1) != 0)
        {
          lanes[bits][count[bits]++] = lane;
        }
      }
    }
  }
};
inline constexpr LanesSet lanesSet;

/// Appends the numbers of the lanes that are set, the first of which is `first`, to a list that has
/// room for four; returns how many. Has no branch that depends on them.
inline std::size_t appendSet(FourLanes lanes, std::int32_t first, std::uint32_t* end)
{
  const std::size_t bits = bitsOf(lanes);
  FourLanes numbers;
  std::memcpy(&numbers, lanesSet.lanes[bits].data(), sizeof numbers);
  numbers += first;
  std::memcpy(end, &numbers, sizeof numbers);
  return lanesSet.count[bits];
}

} // namespace pointfront
