#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Store/Hierarchy.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pointfront
{

/// Bytes of one node in the section.
constexpr std::size_t nodeRowBytes = 68;

/// The node table as bytes: one row of 68 bytes for each node.
std::vector<std::byte> encodeNodeTable(const std::vector<Node>& nodes);

/// `size` must be nodeCount * nodeRowBytes (the caller has checked it against the file).
std::vector<Node> decodeNodeTable(const std::byte* data, std::uint32_t nodeCount);

/// What is wrong with a table, or an empty text: parents before children, children neighbours and
/// linked both ways, levels, layers, counts and their sums (of points of the input), sizes finite
/// and not negative.
/// Time  linear in the nodes; takes no memory.
std::string nodeTableFault(const std::vector<Node>& nodes, std::size_t layerCount,
  std::uint64_t pointCount, Refinement refinement = Refinement::Add);

/// Nodes without a parent, in the table's order.
std::vector<NodeIndex> rootsOf(const std::vector<Node>& nodes);

} // namespace pointfront
