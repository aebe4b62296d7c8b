#pragma once

#include "pointfront/Records/MortonOrder.h"
#include "pointfront/Records/RecordLayout.h"

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

  /// Number of places of the points; some may share one.
  std::uint64_t places() const { return distinct[0]; }
  /// Adds points that come behind these; the last here and the first there differ in so many bits
  /// (differingBits()).
  void append(const CellOccupancy& others, unsigned between);
};

CellOccupancy cellOccupancy(const RecordSpan& records, const std::vector<std::uint32_t>& points);
/// How many different places points in Morton order have.
std::uint64_t placesOf(const RecordSpan& records, const std::vector<std::uint32_t>& points);
/// The same from how many bits each point differs in from the one before (differingBits()), without
/// asking where they are. That of the first is not looked at.
CellOccupancy cellOccupancy(const std::uint8_t* steps, std::size_t points);

/// A distance of 2^(quarters / 4) tree steps: the distances that inner nodes sample at. Quarters of
/// an octave, so that a node's points come near its capacity; whole numbers, so that they compare.
/// Range  quarters 0 to 128.
struct SamplingDistance
{
  int quarters = 0;

  double squaredSteps() const; ///< exact powers of two times one of two fixed factors
  double steps() const;
};

/// The limits of an inner node's points.
struct SamplingRule
{
  std::uint32_t nodePoints = 16384;
};

/// The distance at which an inner node samples its candidates: the smallest for which the node is
/// expected to hold at most nodePoints of them, and at most about a third of them.
/// Expectation  points no closer than d, as dense as they can be, are three for every four cells
///              of d that are occupied: on a surface (0.70 / d^2 on a plane) as in a
///              block (0.73 / d^3). Between two sizes of cell, occupancy is interpolated.
/// `coarsestBelow` is the largest distance of the inner children (-1: none); spacing falls by
///              at least the square root of two from level to level.
/// A node's own candidates decide, not the grid of its cell: a dense child does not thin out
/// what lies above it, and a cell with a sliver of surface in it is filled as any other.
SamplingDistance samplingDistance(const CellOccupancy& occupancy, std::uint64_t candidates,
  int coarsestBelow, const SamplingRule& rule);

/// Chooses a subset that covers all points: along the Morton curve, each point that is not closer
/// than the distance to one chosen before. No two chosen ones are closer than that,
/// and none can be added: a maximal Poisson-disk sample. It depends on the positions
/// only, never on who came first (of equal positions: the first in input order).
/// Cost     a hash table of cells of twice the distance, so that what is in reach lies in eight of
///          them; many points fall to those chosen last and never ask the table.
/// Memory   64 KiB, and 32 bytes for each chosen point, reused from call to call.
/// Threads  one instance, one thread.
/// Source   the minimum distance within a node, as PotreeConverter 2 keeps it (Schuetz 2020); cells
///          that make the search local: Bridson 2007, Fast Poisson Disk Sampling.
class SubsetSampler
{
public:
  SubsetSampler();
  /// `points` in Morton order; `chosen`: at which places of `points` those are, ascending.
  void choose(const RecordSpan& records, const std::vector<std::uint32_t>& points,
    SamplingDistance distance, std::vector<std::uint32_t>& chosen);

private:
  static constexpr unsigned slotBits = 14;
  static constexpr std::uint32_t none = 0; ///< in taken_ a point near to nothing
  static constexpr std::size_t recentPoints = 6;

  using Pair = double __attribute__((vector_size(16))); ///< every x86-64 and ARMv8 has it
  using Mask = decltype(Pair() < Pair());

  struct Taken
  {
    glm::dvec3 position{ 0.0 };
    std::uint32_t next = none; ///< another one whose cell has the same slot
  };
  /// The cells that a ball around a point can touch.
  struct Reach
  {
    std::array<std::uint32_t, 2> x, y, z; ///< parts of hashes: [0] of the point's own cell
  };
  Reach reachOf(const glm::dvec3& p) const;
  static std::uint32_t slotOf(const Reach& reach, unsigned octant);

  /// A candidate, as vectors.
  struct Query
  {
    Pair xy;
    Pair z; ///< twice
    Pair squared; ///< square of the distance in steps, twice
  };
  /// Two points at a time, in the halves of vectors; the same sums as one by one.
  static Mask near(const Query& query, const Taken& a, const Taken& b);
  /// To one of those chosen last: along the curve they are the most likely ones.
  bool nearRecent(const Query& query) const;
  bool crowded(const Query& query, const Reach& reach) const;

  std::vector<std::uint32_t> slots_; // heads of lists in taken_
  std::vector<Taken> taken_;
  double cellsPerStep_ = 0.0; // cells of the table in a step
};

/// Spacing between neighbours in tree steps of a set whose occupancy is known, taken as a
/// surface: cells that hold four places or more on average are all hit, so their
/// number is the covered area, and spacing = sqrt(area / places). Never more than the cell of
/// 2^nodeLog2Side steps that holds them all. Points that share a place count as one.
double surfaceSpacing(const CellOccupancy& occupancy, unsigned nodeLog2Side);
/// Spacing of points in Morton order, in the smallest cell that holds them all.
double surfaceSpacing(const RecordSpan& records, const std::vector<std::uint32_t>& points);

} // namespace pointfront
