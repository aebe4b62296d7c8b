#pragma once

#include "pointfront/Neighbourhood/PointTiles.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pointfront
{

/// Heights above the mean of the same class nearby, of the points of one tile; see LocalHeightPass.
/// Order    sums are taken cell by cell and in a cell by height: not in the order of the points.
/// Threads  one.
class LocalMean
{
public:
  /// `points`: those of a tile and all within reach(radius) of them.
  LocalMean(const std::vector<TilePoint>& points, double radius);

  /// How far around a point other points count, at most.
  static double reach(double radius) { return radius * (1.0 + 3.0 / cellsOfRadius); }

  /// heights[i] of points[i] for i < own.
  void heightsAbove(std::size_t own, std::vector<float>& heights) const;

private:
  static constexpr int cellsOfRadius = 8;
  static constexpr int span = 2 * cellsOfRadius + 3; ///< cells that any of the 3 x 3 means needs

  /// Cells are sorted by class, row, column.
  struct Cell
  {
    std::uint8_t objectClass = 0;
    std::int64_t row = 0;
    std::int64_t column = 0;
    std::size_t begin = 0; ///< in order_
    double count = 0.0;
    double sum = 0.0;
  };
  struct Window
  {
    std::array<double, span * span> count;
    std::array<double, span * span> sum;
  };
  void windowAround(const Cell& cell, std::array<std::size_t, span>& cursors, Window& window) const;
  static double meanAround(const Window& window, int row, int column);
  static std::array<double, 9> meansAround(const Window& window);
  std::int64_t cellOf(double coordinate) const;

  const std::vector<TilePoint>& points_;
  double edge_;
  std::vector<std::uint32_t> order_;
  std::vector<Cell> cells_;
};

} // namespace pointfront
