#pragma once

#include "pointfront/Neighbourhood/NeighbourList.h"

namespace pointfront
{

/// An exact search by a kd-tree over two or three axes. Each node has the box of its places: a
/// search from far away, over water say, leaves out all that only a plane of the tree would let in.
/// Memory   10 to 16 bytes a place.
/// Threads  immutable; the set must live as long as the index.
class KdIndex final : public NeighbourIndex
{
public:
  /// `axes` 2: distances are horizontal, height plays no part.
  KdIndex(const PositionSet& set, int axes);
  void search(const glm::dvec3& from, NeighbourList& list) const override;

private:
  struct Node
  {
    // From the origin, rounded outwards, so that no place lies nearer than its box.
    glm::vec3 low;
    glm::vec3 high;
    std::uint32_t above = 0; ///< second child, 0: a leaf; the first follows its parent
    std::uint32_t begin = 0; ///< first place of a leaf
    std::uint32_t end = 0;
  };
  std::uint32_t divide(std::uint32_t begin, std::uint32_t end);
  double squaredDistance(std::uint32_t node, const glm::dvec3& offset) const;
  void visit(std::uint32_t node, const glm::dvec3& from, NeighbourList& list) const;

  const PositionSet& set_;
  int axes_;
  glm::dvec3 origin_{ 0.0 };
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

} // namespace pointfront
