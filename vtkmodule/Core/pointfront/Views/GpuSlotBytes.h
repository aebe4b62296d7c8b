#pragma once

#include "pointfront/Front/GpuSlots.h"

#include <cstdint>

namespace pointfront
{

/// The bytes of a slot of GPU memory (GpuSlots.h), and the number of slots that a window's budget
/// holds.
/// Units  bytes.
struct GpuSlotBytes
{
  static constexpr std::int64_t position = 12; ///< bytes of a point: three unsigned grid steps
  static constexpr std::int64_t value = 4; ///< bytes of a point, in each stream (GpuStreams.h)
  static constexpr std::int64_t record = 80; ///< bytes of a slot, for the vertex shader

  static constexpr std::int64_t of(int streams)
  {
    return gpuSlotPoints * (position + streams * value) + record;
  }

  /// The slots that the fronts of `clouds` clouds may fill together so that their pools stay within
  /// `budget` > 0. A pool grows by an eighth, which may be partly empty, and by what is wanted
  /// where it is small; the room that one of several pools leaves is none for others: a slot each.
  /// At least one slot, so that even a small budget shows something.
  static constexpr std::uint64_t slotsWithin(std::int64_t budget, int streams, std::uint64_t clouds)
  {
    const std::int64_t between = clouds > 1 ? static_cast<std::int64_t>(clouds) : 0;
    const std::int64_t all = budget / of(streams) - between;
    return all > 1 ? static_cast<std::uint64_t>(all - all / 9) : 1;
  }
};

} // namespace pointfront
