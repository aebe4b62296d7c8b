#pragma once

#include "pointfront/Store/Hierarchy.h"

#include <cstdint>

namespace pointfront
{

/// The node that holds the point of that id, if there is one: the last node whose first point has
/// that id or a lower one. Rows ascend by their first points; a node without points has the first
/// point of the next one. The hierarchy has at least one node.
inline NodeIndex nodeOfPoint(const Hierarchy& hierarchy, std::uint64_t id)
{
  auto [low, behind] = hierarchy.nodesAround(id);
  while (behind - low > 1)
  {
    const NodeIndex middle = low + (behind - low) / 2;
    (hierarchy.node(middle).firstPoint <= id ? low : behind) = middle;
  }
  return low;
}

} // namespace pointfront
