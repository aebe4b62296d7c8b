#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointfront
{

/// A node of a COPC file that is being written.
struct COPCNode
{
  int level = 0;
  glm::uvec3 cell{ 0 };
  std::uint64_t offset = 0; ///< where its chunk begins; 0: it has no points
  std::uint32_t bytes = 0;
  std::uint32_t points = 0;
};

/// The hierarchy of a COPC file as pages.
struct COPCPages
{
  std::vector<std::byte> bytes; ///< all pages, the root's first
  std::uint64_t rootBytes = 0;

  /// Small hierarchies are one page. In large ones a page has five levels of its node and the
  /// whole of smaller trees below; larger trees are pages of their own.
  /// `nodes`   each with all its ancestors, in any order; none: one node without points
  /// `offset`  in the file, of the first page
  static COPCPages compose(std::vector<COPCNode> nodes, std::uint64_t offset);
};

} // namespace pointfront
