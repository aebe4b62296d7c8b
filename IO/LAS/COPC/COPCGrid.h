#pragma once

#include "LASExport.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace pointfront
{

/// The cube of a COPC file and the cells that its octree cuts it into.
/// Cube      side: the points' largest extent and at most 1/128 more, so that the planes between
///           cells of the upper levels lie half way between two steps of the coordinates: no
///           rounding of a reader puts a point into another cell.
/// Order     key() sorts points so that every cell of every level is one run, as Morton's order
///           does, but the children of a cell follow each other in an order that is random and the
///           same each time: the first point of a run is then a random point of its cell and not
///           the lowest (scrambling: A. Owen, Randomly permuted (t,m,s)-nets, 1995).
class COPCGrid
{
public:
  /// The order's levels: cells have 2^-21 of the cube's side.
  static constexpr int keyLevels = 21;

  /// Around the points that were counted; around nothing if there are none.
  COPCGrid(const LASTotals& totals, const QuantisationGrid& grid);

  const glm::dvec3& centre() const { return centre_; }
  double halfSize() const { return halfSize_; }

  /// The cell at keyLevels of a LAS record.
  glm::uvec3 cell(const std::byte* record) const;
  static std::uint64_t key(const glm::uvec3& cell);
  std::uint64_t key(const std::byte* record) const { return key(cell(record)); }

  /// The levels, from 1, on which two keys are in the same cell: 0 to keyLevels.
  static int commonLevels(std::uint64_t one, std::uint64_t other);

private:
  glm::dvec3 centre_{ 0.0 };
  double halfSize_ = 0.0;
  std::array<std::int64_t, 3> low_{}; ///< steps of the lowest point
  std::array<double, 3> sideSteps_{}; ///< the cube's side in steps of that axis
};

} // namespace pointfront
