#include "pointfront/Tiles/AlikeTiles.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>

namespace pointfront
{

double diagonalOf(const Bounds& bounds)
{
  return bounds.empty() ? 0.0 : glm::length(bounds.size());
}

void AlikeTiles::begin(const StoreDescription& first)
{
  together = first;
  together.wholeCount = first.pointCount + first.missingPoints();
  count = 1;
  lengths = diagonalOf(first.bounds);
}

void AlikeTiles::add(const CollectedTile& tile)
{
  ++count;
  lengths += diagonalOf(tile.bounds);
  together.fileBytes += tile.fileBytes;
  together.pointCount += tile.pointCount;
  together.wholeCount += std::max(tile.pointCount, tile.wholeCount);
  together.bounds.add(tile.bounds);
  together.levels = std::max(together.levels, tile.levels);
  auto ends = tile.ranges.begin();
  for (ColumnRange& range : together.ranges)
  {
    for (std::array<double, 2>& all : range.components)
    {
      all = { std::min(all[0], (*ends)[0]), std::max(all[1], (*ends)[1]) };
      ++ends;
    }
  }
  for (std::size_t layer = 0; layer < tile.layers.size(); ++layer)
  {
    together.layers[layer].pointCount += tile.layers[layer].first;
    together.layers[layer].nodeCount += tile.layers[layer].second;
  }
}

} // namespace pointfront
