#pragma once

#include <cstdint>

namespace pointfront
{

/// GPU memory is given out in equal slots: a node takes as many whole ones as the prefix of it that
/// is drawn fills. What a view takes of a GPU is therefore counted in slots: small nodes take more
/// memory than their points.
constexpr std::uint32_t gpuSlotPoints = 4096;

constexpr std::uint64_t gpuSlotsOf(std::uint64_t points)
{
  return (points + gpuSlotPoints - 1) / gpuSlotPoints;
}

} // namespace pointfront
