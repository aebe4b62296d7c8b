#pragma once

#include "pointfront/Records/RecordLayout.h"
#include "pointfront/Trees/PartTree.h"

#include <cstdint>
#include <vector>

namespace pointfront
{

/// A cell of the histogram of one layer: its place and its number of points. Cells of a layer are
/// cubes of one size and do not overlap.
struct KdCell
{
  TreePosition origin{ 0 };
  std::uint64_t count = 0;
};

/// Points that a part or a subtree owes to a node above it.
struct KdShare
{
  std::uint32_t node = 0; ///< number in KdCut::tree()
  std::uint64_t points = 0;
};

/// Where the points of a cell go: to one part, or the first `first` of them along an axis to one
/// place and the others to another.
struct KdPlace
{
  static constexpr std::uint32_t none = 0xffffffffu;
  std::uint32_t part = none; ///< none: divided
  std::uint8_t axis = 0;
  std::uint64_t first = 0;
  std::uint32_t left = none; ///< numbers of places
  std::uint32_t right = none;
};

/// Sizes of a tree's nodes.
struct KdRule
{
  std::uint32_t nodePoints = 16384; ///< points of each node but one a tree
  /// A subtree of at most so many nodes is a part, built in memory. Fixed, so that the tree
  /// depends on neither memory nor threads.
  std::uint32_t partNodes = 16;
  /// Only the leaves have points of the input; inner nodes of the upper tree stand for two
  /// divisions each (KdMeanBuilder.h), and nothing is owed.
  bool leavesOnly = false;

  std::uint32_t innerPoints() const { return leavesOnly ? 0 : nodePoints; }

  std::uint64_t partPoints() const { return std::uint64_t(nodePoints) * partNodes; }
};

/// How many points of `points` go to the left, when `points` is what children share: half of the
/// nodes, all of them full. Everything, when that is one node.
std::uint64_t kdLeftPoints(std::uint64_t points, std::uint32_t nodePoints);

/// The upper kd-tree of one layer, cut from a histogram alone, exact to the point (LAYERS-2).
/// Nodes     each takes nodePoints of the points in its region for itself, in proportion to the
///           occupied area; what is left is divided at the median along the longest axis, so that
///           the left has a whole number of full nodes.
/// Cells     are ordered by their place along the axis; those before the median cell go to the
///           left, those behind it to the right. Only the median cell is divided by its points
///           (KdPlace). So a point is moved once for all levels, and borders of regions are as
///           straight as cells are small.
/// Shares    the cut fixes how many points each part owes to each node above it. The part chooses
///           them when it has its points.
/// Threads   const after construction.
/// Source    Richter, Discher & Doellner 2015, section 4.1.1 and figure 6.
class KdCut
{
public:
  /// `cells` in Morton order; they must outlive this. The tree is that of layer `layer`.
  KdCut(const std::vector<KdCell>& cells, const KdRule& rule, std::uint16_t layer);

  /// PartNode::count of a part is the points that are moved to it, those that it owes included.
  const std::vector<PartNode>& tree() const { return tree_; }
  std::uint32_t partCount() const { return parts_; }
  /// Shares that each node of tree() owes to those above it, from the root down.
  const std::vector<std::vector<KdShare>>& shares() const { return shares_; }
  /// The first ones belong to the cells, in their order.
  const std::vector<KdPlace>& places() const { return places_; }

private:
  struct Item
  {
    std::uint32_t cell = 0;
    std::uint32_t place = 0;
    std::uint64_t count = 0;
  };
  struct Region
  {
    std::vector<Item> items;
    std::vector<KdShare> shares;
    std::uint32_t parent = PartNode::none;
    unsigned depth = 0;
  };
  struct Median
  {
    std::size_t item = 0;
    std::uint64_t inside = 0; ///< points of that item that go to the left
    std::vector<KdShare> left;
  };
  std::uint32_t addNode(const Region& region, std::uint64_t count);
  void addPart(const Region& region, std::uint64_t count);
  unsigned longestAxis(const Region& region) const;
  void divide(Region region, std::uint64_t own, std::vector<Region>& open);
  Median median(const Region& region, std::uint64_t leftPoints) const;
  void joinLevels();

  const std::vector<KdCell>& cells_;
  KdRule rule_;
  std::uint16_t layer_;
  std::vector<PartNode> tree_;
  std::vector<std::vector<KdShare>> shares_;
  std::vector<KdPlace> places_;
  std::uint32_t parts_ = 0;
};

} // namespace pointfront
