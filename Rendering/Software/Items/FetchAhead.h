#pragma once

#include <cstddef>
#include <cstdint>

namespace pointfront
{

/// Points [first, last) of a column.
struct PointRange
{
  std::uint32_t first;
  std::uint32_t last;
};

/// Asks for the memory of a column's points, a cache line at a time, while the points before them
/// are drawn: what processors fetch ahead by themselves ends with each page.
inline void fetchAhead(const void* column, std::size_t pointBytes, PointRange points)
{
  constexpr std::size_t cacheLine = 64;
  const auto* const bytes = static_cast<const char*>(column);
  for (std::size_t at = points.first * pointBytes; at < points.last * pointBytes; at += cacheLine)
  {
    __builtin_prefetch(bytes + at);
  }
}

} // namespace pointfront
