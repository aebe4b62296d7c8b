#pragma once

namespace pointfront
{

/// Which level of the octree each point goes to, in the order of COPCGrid::key().
/// Sample   a node has the first point of each of the 128^3 cells that its own is cut into, but for
///          those that the levels above have taken.
/// Leaves   a cell of at most `leafPoints` points is not divided: all that levels above have left
///          over are its own. A leaf of at most `leastPoints` points becomes part of its parent.
/// Memory   none: a point, the one before it and two that come later tell it.
/// Source   grid samples of all levels in one pass over an order of space: docs/adr/0047.
class COPCLevels
{
public:
  static constexpr int sampleLevels = 7; ///< 2^7 cells to a node's side: its spacing
  static constexpr int deepest = 14; ///< sampleLevels below it, keys end
  static constexpr unsigned leafPoints = 50000;
  static constexpr unsigned leastPoints = 500;

  /// `differs`  the first level on which the point's cell is not that of the point before; 0: there
  ///            was none before
  /// `ofLeaf`, `ofLeast`  the levels that it has in common with the point leafPoints, leastPoints
  ///            behind it; -1: there is none
  int place(int differs, int ofLeaf, int ofLeast)
  {
    if (differs <= leaf_)
    {
      leaf_ = clamp(differs > ofLeaf + 1 ? differs : ofLeaf + 1);
      target_ = leaf_ > 0 && ofLeast < leaf_ ? leaf_ - 1 : leaf_;
    }
    const int sampled = differs > sampleLevels ? differs - sampleLevels : 0;
    return sampled < target_ ? sampled : target_;
  }

private:
  static int clamp(int level) { return level < deepest ? level : deepest; }

  int leaf_ = deepest; ///< the level of the cell that is not divided and has the current point
  int target_ = 0;
};

} // namespace pointfront
