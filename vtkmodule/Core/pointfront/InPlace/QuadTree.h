#pragma once

#include "pointfront/InPlace/CellGrid.h"
#include "pointfront/Store/Hierarchy.h"

#include <cstdint>
#include <vector>

namespace pointfront
{

/// One node of the in-place quadtree while it is made.
struct QuadNode
{
  NodeIndex parent = noNode;
  NodeIndex firstChild = noNode;
  std::uint8_t childCount = 0;
  std::uint8_t level = 0;
  std::uint8_t logStep = 0; ///< an inner node holds the sample stream of this step
  bool sliced = false; ///< its children share its square: they are slices of the file's order
  std::uint64_t points = 0; ///< in its square, as counted
  std::uint64_t sliceStep = 0; ///< sliced only: points of each child but the last
  double area = 0.0; ///< area of the cells in its square that hold points, square steps
  Square square;
  CellGrid::Range range; ///< cells of a leaf, and of a sliced node

  bool leaf() const { return childCount == 0; }
};

/// The shape of the tree: squares that hold too many points are cut into four, empty ones are left
/// out, and so is a square whose points all lie in one of its quadrants.
/// Shapes    breadth first; children are neighbours; one root, or no node without points.
/// Leaves    at most `leafPoints` as counted. Where more share one grid position in the plane (a
///           wall, or duplicates) no square can part them: at most 255 slices of the file's order
///           are then the leaves.
/// Steps     an inner node with m points holds those of the stream of 2^logStep, the smallest with
///           m / 2^logStep <= leafPoints / 2, that no ancestor holds. Never more than its parent's;
///           if it is the same, all are its parent's and it holds none.
/// Source    Kovac 2009, section 2.1. There the header's box and count give a tree of equal depth;
///           here the points are counted, because headers lie and density varies.
class QuadTree
{
public:
  QuadTree(const CellGrid& grid, std::uint32_t leafPoints);

  const std::vector<QuadNode>& nodes() const { return nodes_; }
  /// Writes into each cell the node whose points lie there: a leaf, or a sliced node.
  void assignCells(CellGrid& grid) const;

  /// The ancestors of a node that hold points of its square, coarsest first.
  struct Holder
  {
    NodeIndex node;
    unsigned logStep;
  };
  std::vector<Holder> holdersAbove(NodeIndex node) const;

private:
  /// A square on the way up: its node in drafts_, or none yet as long as it may become part of a
  /// larger leaf.
  struct Draft
  {
    QuadNode node;
    std::vector<std::uint32_t> children; ///< in drafts_
  };
  struct Found
  {
    std::uint64_t points = 0;
    double area = 0.0;
    std::uint32_t draft = noNode;
    CellGrid::Range range;
  };
  Found build(const CellGrid::Range& range);
  Found buildCell(const CellGrid::Range& range);
  std::uint32_t draftOf(const Found& found);
  void slice(Draft& draft);
  void arrange(std::uint32_t root);
  void chooseSteps();

  const CellGrid& grid_;
  std::uint32_t leafPoints_;
  std::vector<Draft> drafts_;
  std::vector<QuadNode> nodes_;
};

} // namespace pointfront
