#pragma once

#include <cstdint>
#include <vector>

namespace pointfront
{

/// A node above the parts that are built one at a time, or such a part.
struct PartNode
{
  static constexpr std::uint32_t none = 0xffffffffu;

  std::uint64_t count = 0; ///< points inside
  std::uint32_t parent = none; ///< none for a root
  std::uint32_t part = none; ///< number of the part; none for an inner node
  std::uint16_t layer = 0; ///< layer of the store; each layer has a tree of its own
  std::vector<std::uint32_t> children;
};

/// Inner nodes and parts, children before parents, siblings in their order, one tree after
/// another: the order in which their nodes stand in the file. Parents come before their children
/// in `nodes`, roots ascend by layer.
std::vector<std::uint32_t> postOrder(const std::vector<PartNode>& nodes);

} // namespace pointfront
