#pragma once

#include "pointfront/InPlace/GridRecords.h"

#include <glm/vec2.hpp>

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

namespace pointfront
{

/// A square of the plane: corner relative to the grid's, side 2^logSide steps.
struct Square
{
  std::uint64_t x = 0;
  std::uint64_t y = 0;
  unsigned logSide = 0;
};

/// Counts points in the cells of a square grid in the plane, with finer cells in dense places.
/// Later it finds the leaf of any position.
/// Shape     one grid of 2^topBits cells a side over the square frame around `box`; a cell that
///           holds too many is cut into 8 x 8 by refine(), and so on. Cells lie in Morton order,
///           so that every square of the quadtree is one range of them.
/// Memory    4 bytes a cell: at most 64 MiB for the first grid, 256 for each cell that is cut.
/// Counts    stop at 2^30. They shape the tree only; the exact counts come with the runs.
/// Threads   count() from any number of threads at once; everything else from one.
class CellGrid
{
public:
  /// As many bits as give some 32 points a cell, 12 at most.
  static unsigned topBitsFor(std::uint64_t points);

  CellGrid(const RecordBox& box, unsigned topBits);

  /// Adds records [begin, end) to the cells of the newest level.
  void count(const GridRecords& records, std::uint64_t begin, std::uint64_t end);
  /// Cuts every cell of the newest level with more than `capacity` points that can be cut. False
  /// if there is none; else all records must be counted once more.
  bool refine(std::uint32_t capacity);

  /// A range of cells that together are one square: 4^bits cells of `level` from `first` on.
  struct Range
  {
    std::uint32_t level = 0;
    std::uint32_t first = 0;
    unsigned bits = 0;
    Square square;
  };
  Range whole() const { return { 0, 0, topBits_, { 0, 0, frameBits_ } }; }
  /// One of the four quadrants, 0 to 3 (x lowest bit), of a range with bits > 0.
  static Range quadrant(const Range& range, unsigned which);
  /// True when `range` is one cell and that cell was cut; `inside` is then what it was cut into.
  bool cut(const Range& range, Range& inside) const;
  /// Points of a range that is one cell and was not cut.
  std::uint32_t points(const Range& range) const { return cell(range.level, range.first); }

  /// Assigns `leaf` (below 2^31) to the cells of `range`, none of which is cut.
  void assign(const Range& range, std::uint32_t leaf);
  /// The leaf that was assigned to the cell of this position; before that, the points of the cell.
  std::uint32_t at(const glm::ivec3& position) const;

  /// Lowest and highest grid position of a square that a point can have, inclusive.
  glm::ivec2 low(const Square& square) const;
  glm::ivec2 high(const Square& square) const;

private:
  using Cells = std::unique_ptr<std::atomic<std::uint32_t>[]>;
  struct CellNumber
  {
    std::uint32_t level;
    std::uint32_t index;
  };
  std::uint32_t cell(std::uint32_t level, std::uint32_t index) const;
  unsigned bitsOf(std::uint32_t level) const;
  CellNumber find(const glm::ivec3& position) const;
  void addLevel(std::size_t cells);

  RecordBox box_;
  unsigned frameBits_; ///< the frame's side is 2^frameBits_ steps, 0 to 32
  unsigned topBits_;
  std::vector<Cells> levels_;
  std::vector<std::size_t> sizes_;
  std::vector<unsigned> logSides_; ///< for each level, log2 of a cell's side
};

} // namespace pointfront
