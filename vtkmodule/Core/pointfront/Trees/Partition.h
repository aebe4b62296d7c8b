#pragma once

#include "pointfront/Records/MortonOrder.h"
#include "pointfront/Trees/PartTree.h"

#include <cstdint>
#include <vector>

namespace pointfront
{

/// How many points a counted cell holds. Cells are aligned cubes of one size.
struct CountedCell
{
  TreePosition origin{ 0 }; ///< tree steps
  std::uint64_t count = 0;
};

/// The upper octree, down to parts that are built one at a time.
/// The nodes are those that a build in one piece would have: a cell that holds more points than a
/// part may, the smallest around its points, is an inner node. So parts may be cut anywhere. Source
/// Richter & Doellner 2010, section 3.1: split in eight until a part fits.
class Partition
{
public:
  static constexpr std::uint32_t none = PartNode::none;

  struct Node : PartNode
  {
    OctreeCell cell; ///< cell of a part: around its points, not always the smallest
  };

  Partition() = default;
  /// Cuts so that a part holds at most `partPoints` points, where the cells are fine enough.
  /// `cells` in Morton order, each of 2^cellLog2 steps. `partOf` (one for each cell) is filled.
  Partition(const std::vector<CountedCell>& cells, unsigned cellLog2, std::uint64_t partPoints,
    std::vector<std::uint32_t>& partOf);

  const std::vector<Node>& nodes() const { return nodes_; }
  std::uint32_t root() const { return 0; } ///< root of layer 0; none when nodes() is empty
  std::uint32_t partCount() const { return static_cast<std::uint32_t>(parts_.size()); }
  const Node& part(std::uint32_t number) const { return nodes_[parts_[number]]; }

  /// Replaces a part that is too large by the partition of its own finer cells. Its parts get
  /// numbers from partCount() on, except for the first, which keeps the number.
  /// Returns the numbers in the order of `partOf` of the finer partition.
  std::vector<std::uint32_t> refine(std::uint32_t part, const Partition& finer);
  /// Cuts a part of equal points into eight runs of input order; returns their numbers.
  std::vector<std::uint32_t> refineByOrder(std::uint32_t part);

  /// Adds the trees of `other`, of points of their own, as the next layer. Its parts get numbers
  /// from partCount() on, in their order.
  void append(const Partition& other);

  /// The deepest node of that layer whose cell holds the position: a part, or the inner node
  /// that is cut by order. none outside of the layer.
  std::uint32_t nodeAt(std::size_t layer, const TreePosition& position) const;

  /// The nodes without their cells.
  std::vector<PartNode> tree() const { return { nodes_.begin(), nodes_.end() }; }

private:
  std::uint32_t addNode(OctreeCell cell, std::uint64_t count, std::uint32_t parent);
  std::uint32_t addPart(OctreeCell cell, std::uint64_t count, std::uint32_t parent);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> parts_; // node of each part
  std::vector<std::uint32_t> roots_; // node of each layer's root
};

} // namespace pointfront
