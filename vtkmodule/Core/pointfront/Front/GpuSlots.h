#pragma once

#include <cstdint>

namespace pointfront
{

/// GPU memory is given out in equal slots. A node takes as many whole slots as its drawn prefix
/// fills, so small nodes take more memory than their points. The demand of a view on the GPU is
/// therefore counted in slots.
constexpr std::uint32_t gpuSlotPoints = 4096;

constexpr std::uint64_t gpuSlotsOf(std::uint64_t points)
{
  return (points + gpuSlotPoints - 1) / gpuSlotPoints;
}

} // namespace pointfront
