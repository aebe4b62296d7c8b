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

/// Marks a subset that covers all points: in each occupied cell the point nearest to the cell's
/// target is a candidate (ties by Morton order, then input order); along the Morton curve,
/// candidates closer than half a cell to a marked one are left out. So every point has a marked one
/// within about a cell, and no two marked ones make a clump, as they would where a slope crosses
/// the corner of a cell. Never first-come. Targets   not the centre: one third and two thirds of
/// the cell's edge in turn from level to
///           level, since one third of a cell is two thirds of its low octant, and so on. The
///           targets of coarse cells are targets of finer cells too, so a point that was chosen
///           for being near the target is still near it on the level above.
/// Memory    8 MiB of slots, one for each cell of a node of 128 cells an edge, clear between calls.
///           Larger nodes wrap around; then a slot may be another cell's, and a clump may stay.
/// Threads   one instance, one thread.
/// Source    the minimum distance within a node, as PotreeConverter 2 keeps it (Schuetz 2020).
class SubsetSampler
{
public:
  SubsetSampler();
  /// `points` in Morton order; `chosen[i]` belongs to points[i]. cellLog2 up to 32.
  void choose(const RecordView& records, const std::vector<std::uint32_t>& points,
    unsigned cellLog2, std::vector<bool>& chosen);

private:
  static constexpr unsigned slotBits = 7; // of each axis
  std::uint32_t& slotOf(const TreePosition& cell);
  bool crowded(const TreePosition& p, unsigned cellLog2);

  std::vector<std::uint32_t> slots_; // number of the cell's point in taken_, plus one
  std::vector<TreePosition> taken_;
};

/// Spacing between neighbours in tree steps of a set whose occupancy is known, taken as a
/// surface: cells that hold four points or more on average are all hit, so their
/// number is the covered area, and spacing = sqrt(area / points). Never more than the cell of
/// 2^nodeLog2Side steps that holds them all.
double surfaceSpacing(const CellOccupancy& occupancy, std::uint64_t points, unsigned nodeLog2Side);

} // namespace pointfront
