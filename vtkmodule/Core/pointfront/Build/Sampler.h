#pragma once

#include "pointfront/Build/MortonOrder.h"
#include "pointfront/Build/RecordLayout.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pointfront
{

/// How many cells of each size hold at least one of some points: distinct[n] cells of 2^n steps.
/// One pass, because the points come in Morton order and a cell is then one run of them.
struct CellOccupancy
{
  std::array<std::uint64_t, 33> distinct{};
};

CellOccupancy cellOccupancy(const RecordView& records, const std::vector<std::uint32_t>& points);

/// What an inner node may hold.
struct SamplingRule
{
  std::uint32_t nodePoints = 16384;

  /// log2 of the cells along one edge of a node: 128 for 16384 points, since a surface
  /// through a node occupies about 128 * 128 of its 128^3 cells.
  unsigned finestGrid() const;
  /// An inner node never samples more points than that.
  std::uint64_t mostPoints() const { return 2ull * nodePoints; }
};

/// log2 of the cells' side in which an inner node keeps one point each: the finest that keeps the
/// node within its points, at least twice as coarse as those of its inner children
/// (`coarsestBelow`, -1 if none), so that spacing halves at least from level to level.
unsigned samplingCell(const CellOccupancy& occupancy, unsigned nodeLog2Side, int coarsestBelow,
  const SamplingRule& rule);

/// Marks one point for each occupied cell: the one nearest to the cell's target, ties by Morton
/// order, then input order. `points` in Morton order; `chosen[i]` belongs to points[i].
/// The target is not the centre: it lies at one third and two thirds of the cell's edge in
/// turn from level to level, since one third of a cell is two thirds of the low octant's and so on.
/// The targets of coarse cells are targets of finer cells too, so a point that was chosen for
/// being near the target is still near it on the level above. Never first-come.
void chooseNearTargets(const RecordView& records, const std::vector<std::uint32_t>& points,
  unsigned cellLog2, std::vector<bool>& chosen);

/// Spacing between neighbours in tree steps of a set whose occupancy is known, taken as a
/// surface: cells that hold four points or more on average are all hit, so their
/// number is the covered area, and spacing = sqrt(area / points). Never more than the cell of
/// 2^nodeLog2Side steps that holds them all.
double surfaceSpacing(const CellOccupancy& occupancy, std::uint64_t points, unsigned nodeLog2Side);

} // namespace pointfront
