#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pointfront
{

struct StoreDescription;

/// Names layers that have no room for a single point: "class 2, class 6", or the store where it has
/// one tree for all classes. Empty where there are none.
std::string leftOutOf(const StoreDescription& store, const std::vector<std::uint16_t>& layers);

/// The warning of a mapper that draws nothing of these layers.
std::string roomWarning(
  const StoreDescription& store, const std::vector<std::uint16_t>& layers, bool byGpuMemory);

} // namespace pointfront
