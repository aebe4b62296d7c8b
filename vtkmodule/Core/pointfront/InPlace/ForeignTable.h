#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/InPlace/ForeignTree.h"
#include "pointfront/Store/Hierarchy.h"

#include <cstdint>
#include <vector>

namespace pointfront
{

/// The rows of a foreign octree, breadth first, and where the points of each are.
struct ForeignTable
{
  std::vector<Node> nodes;
  std::vector<std::uint64_t> chunks;
  std::uint32_t levels = 0;

  /// Cells above others that the hierarchy does not name become nodes without points. Boxes are
  /// `margin` wider than the cells.
  /// Errors  as ForeignTree::make().
  static Result<ForeignTable> make(const ForeignTreeContent& content, const glm::dvec3& margin);
  /// Cells outside of the box belong to no node.
  void cutTo(const Bounds& box);
};

} // namespace pointfront
