#pragma once

#include "pointfront/InPlace/QuadTree.h"

#include <cstdint>
#include <vector>

namespace pointfront
{

/// Consecutive points of a file that lie in the square of one leaf.
struct LeafRun
{
  NodeIndex leaf = noNode; ///< or a sliced node
  std::uint64_t first = 0;
  std::uint64_t count = 0;
  RecordBox box; ///< box of exactly these points
};

/// Cuts a stretch of a file into runs by stepping and bisection.
/// Paper       from the first point of a run it looks ahead by a constant step; at the first step
///             that ends outside the leaf it bisects for the last point inside.
/// Here        a step is taken if the box of *all* its points lies inside the square, not its last
///             point alone: a track that leaves the leaf and comes back within one step would
///             otherwise hide points of other leaves in the run. The bisection halves the same way,
///             so it finds the first point outside, and the runs are those that a test of every
///             point would find. Steps double while they succeed (1 to 256 points): a file without
///             any order costs one test a point, not one bisection a point.
/// Cost        every point is looked at about twice, in its order in memory; the tree once a run.
/// Threads     find() is pure: any thread, any stretch.
/// Source      Kovac 2009, section 2.2.
class RunFinder
{
public:
  /// The grid's cells are assigned to the tree's nodes.
  RunFinder(const GridRecords& records, const CellGrid& grid, const QuadTree& tree)
    : records_(records)
    , grid_(grid)
    , tree_(tree)
  {
  }
  /// Appends the runs of records [begin, end) to `runs`, ascending.
  void find(std::uint64_t begin, std::uint64_t end, std::vector<LeafRun>& runs) const;

private:
  LeafRun runFrom(std::uint64_t first, std::uint64_t end) const;

  const GridRecords& records_;
  const CellGrid& grid_;
  const QuadTree& tree_;
};

} // namespace pointfront
