#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointfront
{

/// A cube of 2^edgeLog2 world units, aligned to multiples of its edge from the world's origin.
using CellIndex = std::array<std::int64_t, 3>;

/// Cells that have points, and how many.
struct PopulatedCell
{
  CellIndex index{};
  std::uint64_t points = 0;
};

/// A position that can have neighbours: finite and within 1e12 of the origin, so that the number of
/// its cell fits. All others are rejected by the build, or so far out that no double tells
/// neighbours apart.
inline bool hasPlace(const glm::dvec3& p)
{
  constexpr double farthest = 1e12;
  return p.x >= -farthest && p.x <= farthest && p.y >= -farthest && p.y <= farthest &&
    p.z >= -farthest && p.z <= farthest; // false for NaN
}

/// Counts points in cells, in bounded memory: it begins with fine cells and doubles their edge
/// whenever there are more than `mostCells`.
/// Order   the result is the same whatever the order of the points, and however they are spread
///         over several histograms that are added up: its edge is the smallest, from the first on,
///         that needs no more than mostCells for all points.
/// Axes    with 2, height plays no part: all cells lie in layer 0.
/// Threads one thread each.
class CellHistogram
{
public:
  CellHistogram(int edgeLog2, unsigned axes, std::size_t mostCells);

  /// `p` must have a place.
  void add(const glm::dvec3& p);
  void add(const CellHistogram& other);

  int edgeLog2() const { return edgeLog2_; }
  double edge() const { return edge_; }
  std::uint64_t points() const { return points_; }
  /// Sorted by index.
  std::vector<PopulatedCell> cells() const;

private:
  std::uint64_t& countOf(const CellIndex& index);
  void grow();
  void coarsen();

  int edgeLog2_;
  double edge_;
  unsigned axes_;
  std::size_t mostCells_;
  std::uint64_t points_ = 0;
  // A hash table of cells, those without points are free; at most half are taken. A power of two.
  std::vector<PopulatedCell> slots_;
  std::size_t taken_ = 0;
  std::uint64_t* last_ = nullptr; ///< count of the cell of the point before: points come in runs
  CellIndex lastIndex_{};
};

} // namespace pointfront
