#include "LocalMean.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace pointfront
{
namespace
{
constexpr int middle = 9; // the middle cell of a window
} // namespace

std::int64_t LocalMean::cellOf(double coordinate) const
{
  return static_cast<std::int64_t>(std::floor(coordinate / edge_));
}

LocalMean::LocalMean(const std::vector<TilePoint>& points, double radius)
  : points_(points)
  , edge_(radius / cellsOfRadius)
  , order_(points.size())
{
  static_assert(span == 2 * middle + 1);
  struct CellKey
  {
    std::int64_t row;
    std::int64_t column;
  };
  std::vector<CellKey> places(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    places[i] = { cellOf(points[i].position.y), cellOf(points[i].position.x) };
  }
  const auto keyOf = [&](std::uint32_t i)
  {
    return std::make_tuple(
      points[i].objectClass(), places[i].row, places[i].column, points[i].position.z);
  };
  std::iota(order_.begin(), order_.end(), 0u);
  std::sort(order_.begin(), order_.end(),
    [&](std::uint32_t a, std::uint32_t b) { return keyOf(a) < keyOf(b); });
  for (std::size_t at = 0; at < order_.size(); ++at)
  {
    const std::uint32_t i = order_[at];
    const std::uint8_t objectClass = points[i].objectClass();
    if (cells_.empty() || cells_.back().objectClass != objectClass ||
      cells_.back().row != places[i].row || cells_.back().column != places[i].column)
    {
      cells_.push_back({ objectClass, places[i].row, places[i].column, at, 0.0, 0.0 });
    }
    cells_.back().count += 1.0;
    cells_.back().sum += points[i].position.z;
  }
}

/// `cursors`: for each row of the window a cell that is not beyond its first column; they only go
/// forward while the cells of one row are asked for in their order.
void LocalMean::windowAround(
  const Cell& cell, std::array<std::size_t, span>& cursors, Window& window) const
{
  window.count.fill(0.0);
  window.sum.fill(0.0);
  for (int r = 0; r < span; ++r)
  {
    const std::int64_t row = cell.row + r - middle;
    const auto inRow = [&](std::size_t at)
    {
      return at < cells_.size() && cells_[at].objectClass == cell.objectClass &&
        cells_[at].row == row;
    };
    std::size_t& cursor = cursors[static_cast<std::size_t>(r)];
    while (inRow(cursor) && cells_[cursor].column < cell.column - middle)
    {
      ++cursor;
    }
    for (std::size_t at = cursor; inRow(at) && cells_[at].column <= cell.column + middle; ++at)
    {
      const auto slot =
        static_cast<std::int64_t>(r) * span + (cells_[at].column - cell.column) + middle;
      window.count[slot] = cells_[at].count;
      window.sum[slot] = cells_[at].sum;
    }
  }
}

double LocalMean::meanAround(const Window& window, int row, int column)
{
  double count = 0.0;
  double sum = 0.0;
  for (int r = -cellsOfRadius; r <= cellsOfRadius; ++r)
  {
    const int half = static_cast<int>(std::sqrt(double(cellsOfRadius * cellsOfRadius - r * r)));
    const int begin = (middle + row + r) * span + middle + column - half;
    for (int at = begin; at <= begin + 2 * half; ++at)
    {
      count += window.count[static_cast<std::size_t>(at)];
      sum += window.sum[static_cast<std::size_t>(at)];
    }
  }
  return sum / count; // the cell in the middle has points
}

std::array<double, 9> LocalMean::meansAround(const Window& window)
{
  std::array<double, 9> means{};
  for (int i = 0; i < 9; ++i)
  {
    means[static_cast<std::size_t>(i)] = meanAround(window, i / 3 - 1, i % 3 - 1);
  }
  return means;
}

void LocalMean::heightsAbove(std::size_t own, std::vector<float>& heights) const
{
  heights.assign(own, 0.0f);
  std::array<std::size_t, span> cursors{};
  Window window;
  for (std::size_t c = 0; c < cells_.size(); ++c)
  {
    const Cell& cell = cells_[c];
    const bool newRow =
      c == 0 || cells_[c - 1].row != cell.row || cells_[c - 1].objectClass != cell.objectClass;
    for (int r = 0; newRow && r < span; ++r)
    {
      const auto first = std::lower_bound(cells_.begin(), cells_.end(), cell.row + r - middle,
        [&](const Cell& a, std::int64_t row)
        { return std::tie(a.objectClass, a.row) < std::tie(cell.objectClass, row); });
      cursors[static_cast<std::size_t>(r)] = static_cast<std::size_t>(first - cells_.begin());
    }
    const std::size_t end = c + 1 < cells_.size() ? cells_[c + 1].begin : order_.size();
    const bool needed = std::any_of(order_.begin() + std::ptrdiff_t(cell.begin),
      order_.begin() + std::ptrdiff_t(end), [own](std::uint32_t i) { return i < own; });
    if (!needed)
    {
      continue;
    }
    windowAround(cell, cursors, window);
    const std::array<double, 9> means = meansAround(window);
    for (std::size_t at = cell.begin; at < end; ++at)
    {
      const std::uint32_t i = order_[at];
      if (i >= own)
      {
        continue;
      }
      // Between the centres of the four cells around the point.
      const glm::dvec3& p = points_[i].position;
      const double x = p.x / edge_ - static_cast<double>(cell.column) + 0.5; // 0.5 to 1.5
      const double y = p.y / edge_ - static_cast<double>(cell.row) + 0.5;
      const auto left = static_cast<std::size_t>(std::clamp(x, 0.0, 1.0));
      const auto low = static_cast<std::size_t>(std::clamp(y, 0.0, 1.0));
      const double u = x - double(left);
      const double v = y - double(low);
      const std::size_t m = low * 3 + left;
      const double mean = (1.0 - v) * ((1.0 - u) * means[m] + u * means[m + 1]) +
        v * ((1.0 - u) * means[m + 3] + u * means[m + 4]);
      heights[i] = static_cast<float>(p.z - mean);
    }
  }
}

} // namespace pointfront
