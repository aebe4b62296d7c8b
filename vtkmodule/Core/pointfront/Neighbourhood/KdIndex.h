#pragma once

#include "pointfront/Neighbourhood/NeighbourList.h"

namespace pointfront
{

/// An exact search by a kd-tree over two or three axes.
/// Memory   28 bytes a place.
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
    double cut = 0.0;
    std::int32_t axis = -1; ///< -1: a leaf
    std::uint32_t above = 0; ///< child beyond the cut; the one below follows its parent
    std::uint32_t begin = 0; ///< first of a leaf
    std::uint32_t end = 0;
  };
  std::uint32_t divide(std::uint32_t begin, std::uint32_t end);
  void visit(
    std::uint32_t node, const glm::dvec3& from, glm::dvec3& beyond, NeighbourList& list) const;

  const PositionSet& set_;
  int axes_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

} // namespace pointfront
