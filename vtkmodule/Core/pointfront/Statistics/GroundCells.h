#pragma once

#include "pointfront/Base/Bounds.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointfront
{

/// Square cells on the ground of a cloud, and which of them hold a point. A density is measured
/// over these cells, without the gaps and the corners of the bounding box.
/// Cells    such that 16 points would lie in each if the cloud filled its box evenly; larger where
///          that would be more than 2^24 of them. They begin at the box's low corner.
/// Threads  add() from any thread.
class GroundCells
{
public:
  static constexpr double pointsOfCell = 16.0;
  static constexpr std::size_t mostCells = std::size_t(1) << 24;

  /// Bounds of `points` finite points. Those on one vertical line, or in one vertical plane along
  /// an axis, have no ground: no cells.
  GroundCells(const Bounds& bounds, std::uint64_t points);

  /// A point in the bounds.
  void add(const glm::dvec3& point);

  double cellSize() const { return cellSize_; } ///< world units; 0 without cells
  std::uint64_t occupied() const;

private:
  glm::dvec3 low_{ 0.0 };
  double cellSize_ = 0.0;
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::vector<std::atomic<std::uint64_t>> bits_; ///< one a cell
};

} // namespace pointfront
