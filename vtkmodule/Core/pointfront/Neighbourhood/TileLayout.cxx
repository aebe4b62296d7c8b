#include "pointfront/Neighbourhood/TileLayout.h"

#include "pointfront/Base/Infinity.h"

#include <algorithm>
#include <cmath>

namespace pointfront
{
namespace
{
/// Halos of an estimate are made narrower until the copies are no more than this share of all.
constexpr double mostCopies = 1.0;

Bounds everything()
{
  return { glm::dvec3(-infinity), glm::dvec3(infinity) };
}

bool touches(const Bounds& box, const glm::dvec3& low, const glm::dvec3& high)
{
  return box.overlaps({ low, high });
}

std::uint64_t pointsOf(
  std::vector<PopulatedCell>::iterator begin, std::vector<PopulatedCell>::iterator end)
{
  std::uint64_t points = 0;
  for (auto cell = begin; cell != end; ++cell)
  {
    points += cell->points;
  }
  return points;
}

/// The axis along which the cells reach farthest; -1 for a single cell.
int longestAxis(
  std::vector<PopulatedCell>::iterator begin, std::vector<PopulatedCell>::iterator end)
{
  CellIndex low = begin->index;
  CellIndex high = begin->index;
  for (auto cell = begin; cell != end; ++cell)
  {
    for (std::size_t axis = 0; axis < low.size(); ++axis)
    {
      low[axis] = std::min(low[axis], cell->index[axis]);
      high[axis] = std::max(high[axis], cell->index[axis]);
    }
  }
  int longest = -1;
  std::int64_t length = 0;
  for (std::size_t axis = 0; axis < low.size(); ++axis)
  {
    if (high[axis] - low[axis] > length)
    {
      length = high[axis] - low[axis];
      longest = static_cast<int>(axis);
    }
  }
  return longest;
}

/// The cell boundary that parts the points most evenly; cells are sorted along the axis.
std::vector<PopulatedCell>::iterator evenCut(std::vector<PopulatedCell>::iterator begin,
  std::vector<PopulatedCell>::iterator end, std::size_t axis, std::uint64_t points)
{
  auto best = end;
  double bestDistance = infinity;
  std::uint64_t before = begin->points;
  for (auto cell = begin + 1; cell != end; ++cell)
  {
    if (cell->index[axis] != (cell - 1)->index[axis])
    {
      const double distance = std::abs(static_cast<double>(before) - 0.5 * double(points));
      if (distance < bestDistance)
      {
        bestDistance = distance;
        best = cell;
      }
    }
    before += cell->points;
  }
  return best;
}
} // namespace

TileLayout::TileLayout(const CellHistogram& histogram, const TilingOptions& options)
  : options_(options)
  , edge_(histogram.edge())
{
  std::vector<PopulatedCell> cells = histogram.cells();
  divide(cells.begin(), cells.end(), everything());
  countGathered(cells);
  const auto copies = [this]()
  {
    double sum = 0.0;
    for (const Tile& tile : tiles_)
    {
      sum += static_cast<double>(tile.mostGathered - tile.points);
    }
    return sum;
  };
  // Only an estimate may be narrowed: what lies beyond it is looked for in a second round.
  while (options_.halo <= 0.0 && copies() > mostCopies * static_cast<double>(histogram.points()) &&
    largestHalo_ > edge_)
  {
    for (double& halo : halos_)
    {
      halo *= 0.5;
    }
    countGathered(cells);
  }
}

std::size_t TileLayout::divide(CellIterator begin, CellIterator end, const Bounds& own)
{
  const std::uint64_t points = pointsOf(begin, end);
  const std::size_t number = nodes_.size();
  nodes_.emplace_back();
  const int axis = points > options_.tilePoints ? longestAxis(begin, end) : -1;
  if (axis < 0)
  {
    Tile tile;
    tile.own = own;
    tile.points = points;
    nodes_[number].below = tiles_.size();
    tiles_.push_back(tile);
    halos_.push_back(options_.halo > 0.0
        ? options_.halo
        : estimatedHalo(static_cast<std::size_t>(end - begin), points));
    return number;
  }
  const auto along = static_cast<std::size_t>(axis);
  std::sort(begin, end,
    [along](const PopulatedCell& a, const PopulatedCell& b)
    { return a.index[along] < b.index[along]; });
  const CellIterator cut = evenCut(begin, end, along, points);
  const double plane = static_cast<double>(cut->index[along]) * edge_;
  Bounds low = own;
  Bounds high = own;
  low.high[axis] = plane;
  high.low[axis] = plane;
  const std::size_t below = divide(begin, cut, low);
  const std::size_t above = divide(cut, end, high);
  nodes_[number] = { axis, plane, below, above, {} };
  return number;
}

double TileLayout::estimatedHalo(std::size_t cells, std::uint64_t points) const
{
  // The points of a scan lie on surfaces: a cell of edge e stands for about e^2 of them, and the
  // disc that holds k neighbours has the radius spacing * sqrt(k / pi). Three times that, because
  // density varies inside a tile.
  const double spacing =
    edge_ * std::sqrt(static_cast<double>(cells) / std::max(1.0, static_cast<double>(points)));
  return 3.0 * spacing * std::sqrt(options_.neighbours / 3.141592653589793);
}

void TileLayout::countGathered(const std::vector<PopulatedCell>& cells)
{
  largestHalo_ = 0.0;
  for (std::size_t t = 0; t < tiles_.size(); ++t)
  {
    Tile& tile = tiles_[t];
    tile.mostGathered = 0;
    tile.gathered = { tile.own.low - halos_[t], tile.own.high + halos_[t] };
    largestHalo_ = std::max(largestHalo_, halos_[t]);
  }
  gatherBelow(0);
  for (const PopulatedCell& cell : cells)
  {
    glm::dvec3 low(0.0);
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = static_cast<double>(cell.index[static_cast<std::size_t>(axis)]) * edge_;
    }
    forEachGathering(
      low, low + edge_, [&](std::size_t t) { tiles_[t].mostGathered += cell.points; });
  }
}

Bounds TileLayout::gatherBelow(std::size_t node)
{
  Bounds all;
  if (nodes_[node].axis < 0)
  {
    all = tiles_[nodes_[node].below].gathered;
  }
  else
  {
    all = gatherBelow(nodes_[node].below);
    all.add(gatherBelow(nodes_[node].above));
  }
  nodes_[node].gathered = all;
  return all;
}

std::size_t TileLayout::tileOf(const glm::dvec3& p) const
{
  std::size_t node = 0;
  while (nodes_[node].axis >= 0)
  {
    node = p[nodes_[node].axis] < nodes_[node].cut ? nodes_[node].below : nodes_[node].above;
  }
  return nodes_[node].below;
}

bool TileLayout::isInner(const glm::dvec3& p, std::size_t tile) const
{
  const Bounds& own = tiles_[tile].own;
  return p.x - own.low.x > largestHalo_ && own.high.x - p.x > largestHalo_ &&
    p.y - own.low.y > largestHalo_ && own.high.y - p.y > largestHalo_ &&
    p.z - own.low.z > largestHalo_ && own.high.z - p.z > largestHalo_;
}

void TileLayout::forEachGathering(const glm::dvec3& low, const glm::dvec3& high,
  const std::function<void(std::size_t)>& found) const
{
  visit(0, low, high, found);
}

void TileLayout::visit(std::size_t node, const glm::dvec3& low, const glm::dvec3& high,
  const std::function<void(std::size_t)>& found) const
{
  if (!touches(nodes_[node].gathered, low, high))
  {
    return;
  }
  if (nodes_[node].axis < 0)
  {
    found(nodes_[node].below);
    return;
  }
  visit(nodes_[node].below, low, high, found);
  visit(nodes_[node].above, low, high, found);
}

} // namespace pointfront
