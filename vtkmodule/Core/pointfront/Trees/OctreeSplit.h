#pragma once

#include "pointfront/Records/MortonOrder.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointfront
{

/// Items begin to end - 1 of something in Morton order.
struct IndexRange
{
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
};

/// The children of a node, as ranges of its points in Morton order, empty ones left out: by octant
/// while the node is larger than one step, else (equal points) into at most eight runs of
/// equal length. The one rule of the tree's shape, for parts and for the tree above them.
/// `octant(i)` is called for nodes of more than one step only, and rises with i.
template <typename Octant>
std::vector<IndexRange> splitRange(IndexRange all, unsigned log2Side, const Octant& octant)
{
  std::vector<IndexRange> ranges;
  if (log2Side == 0)
  {
    const std::uint64_t run = (all.end - all.begin + 7) / 8;
    for (std::uint64_t begin = all.begin; begin < all.end; begin += run)
    {
      ranges.push_back({ begin, begin + run < all.end ? begin + run : all.end });
    }
    return ranges;
  }
  for (std::uint64_t begin = all.begin; begin < all.end;)
  {
    const unsigned own = octant(begin);
    std::uint64_t low = begin; // the last item known to be in the octant
    std::uint64_t high = all.end; // the first known to be beyond it
    while (high - low > 1)
    {
      const std::uint64_t middle = low + (high - low) / 2;
      (octant(middle) == own ? low : high) = middle;
    }
    ranges.push_back({ begin, high });
    begin = high;
  }
  return ranges;
}

/// The same of points in Morton order.
inline std::vector<IndexRange> splitPoints(
  const RecordSpan& positions, IndexRange all, unsigned log2Side)
{
  const auto octant = [&](std::uint64_t i)
  { return octantOf(positions.position(static_cast<std::size_t>(i)), log2Side); };
  return splitRange(all, log2Side, octant);
}

} // namespace pointfront
