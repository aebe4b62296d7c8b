#pragma once

#include "pointfront/Store/StoredCloud.h"
#include "pointfront/Tiles/CollectedTile.h"

#include <cstddef>

namespace pointfront
{

double diagonalOf(const Bounds& bounds);

/// Stores that differ in no more than counts, bounds, ranges and grids, described as one: counts
/// added up, bounds and ranges of all of them. Its path is that of the first.
struct AlikeTiles
{
  StoreDescription together;
  std::size_t count = 0;
  double lengths = 0.0; ///< diagonals of their boxes, added up

  void begin(const StoreDescription& first);
  void add(const CollectedTile& tile); ///< one of the same kind
};

} // namespace pointfront
