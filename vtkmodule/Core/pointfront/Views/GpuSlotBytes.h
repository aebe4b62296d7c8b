#pragma once

#include "pointfront/Front/GpuSlots.h"

#include <cstdint>

namespace pointfront
{

/// What a slot of GPU memory (GpuSlots.h) takes, and how many a window's budget is worth.
/// Units  bytes.
struct GpuSlotBytes
{
  static constexpr std::int64_t position = 12; ///< of a point: three unsigned grid steps
  static constexpr std::int64_t value = 4;     ///< of a point, where a colouring needs values
  static constexpr std::int64_t record = 48;   ///< of a slot, what the vertex shader knows of it

  static constexpr std::int64_t of(bool values)
  {
    return gpuSlotPoints * (position + (values ? value : 0)) + record;
  }

  /// Slots that the fronts of `clouds` clouds may fill together so that their pools stay within
  /// `budget` > 0: a pool's last block may be partly empty, by an eighth of it and a slot. At least
  /// one: a budget that small shows what fits.
  static constexpr std::uint64_t slotsWithin(
    std::int64_t budget, bool values, std::uint64_t clouds)
  {
    const std::int64_t all = budget / of(values) - static_cast<std::int64_t>(clouds);
    return all > 1 ? static_cast<std::uint64_t>(all * 8 / 9) : 1;
  }
};

} // namespace pointfront
