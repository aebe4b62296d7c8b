#pragma once

#include "pointfront/Points/QuantisationGrid.h"

#include <cstdint>
#include <vector>

namespace pointfront
{

/// Places of the points in an order whose every prefix is a fair subset: batches along the Morton
/// curve. `low` and `high` are the corners of their box.
std::vector<std::uint32_t> fairOrder(
  const std::vector<GridPosition>& steps, const GridPosition& low, const GridPosition& high);

} // namespace pointfront
