#pragma once

#include "pointfront/Store/Hierarchy.h"

#include <cstdint>

namespace pointfront
{

/// The node that holds the point of that rank, if one does: the last whose first point is not
/// behind it. Rows ascend by their first points, and nodes without points share theirs with the
/// next one.
/// The hierarchy has at least one node.
inline NodeIndex nodeOfRank(const Hierarchy& hierarchy, std::uint64_t rank)
{
  NodeIndex low = 0;
  NodeIndex behind = hierarchy.nodeCount();
  while (behind - low > 1)
  {
    const NodeIndex middle = low + (behind - low) / 2;
    (hierarchy.node(middle).firstPoint <= rank ? low : behind) = middle;
  }
  return low;
}

} // namespace pointfront
