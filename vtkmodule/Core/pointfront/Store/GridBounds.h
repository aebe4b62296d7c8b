#pragma once

#include "pointfront/Base/Bounds.h"
#include "pointfront/Points/QuantisationGrid.h"

#include <glm/common.hpp>

#include <cstdint>

namespace pointfront
{

/// The smallest box of grid positions around some points; low > high when there are none.
struct GridBounds
{
  GridPosition low{ INT64_MAX };
  GridPosition high{ INT64_MIN };

  bool empty() const { return low.x > high.x; }
  void add(const GridPosition& p)
  {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  void add(const GridBounds& other)
  {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
  Bounds toWorld(const QuantisationGrid& grid) const
  {
    return empty() ? Bounds{} : Bounds{ grid.toWorld(low), grid.toWorld(high) };
  }
  friend bool operator==(const GridBounds& a, const GridBounds& b)
  {
    return a.low == b.low && a.high == b.high;
  }
};

} // namespace pointfront
