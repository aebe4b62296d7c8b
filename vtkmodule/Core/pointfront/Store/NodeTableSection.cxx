#include "pointfront/Store/NodeTableSection.h"

#include "pointfront/Store/ByteStream.h"
#include "pointfront/Store/StoreFormat.h"

#include <cassert>
#include <cmath>

namespace pointfront
{
namespace
{
bool notNegative(float value) { return std::isfinite(value) && value >= 0.0f; }

std::string sizeFault(const Node& node)
{
  const glm::dvec3& c = node.centre;
  if (!std::isfinite(c.x) || !std::isfinite(c.y) || !std::isfinite(c.z))
  {
    return "its centre is not a number";
  }
  const glm::vec3& h = node.halfSize;
  if (!notNegative(h.x) || !notNegative(h.y) || !notNegative(h.z) || !notNegative(node.radius) ||
    !notNegative(node.spacing))
  {
    return "its size, radius or spacing is not a positive number";
  }
  return {};
}

std::string parentFault(const std::vector<Node>& nodes, std::size_t i)
{
  const Node& node = nodes[i];
  if (node.parent == noNode)
  {
    return node.level == 0 ? "" : "it has no parent and is not at level 0";
  }
  if (node.parent >= i)
  {
    return "its parent does not come before it";
  }
  const Node& parent = nodes[node.parent];
  if (i < parent.firstChild || i - parent.firstChild >= parent.childCount)
  {
    return "its parent does not name it as a child";
  }
  if (node.level != parent.level + 1)
  {
    return "its level does not follow its parent's";
  }
  return node.layer == parent.layer ? "" : "its layer is not its parent's";
}

std::string childrenFault(const std::vector<Node>& nodes, std::size_t i)
{
  const Node& node = nodes[i];
  if (node.leaf())
  {
    return node.firstChild == noNode ? "" : "it has no children but names a first child";
  }
  if (node.firstChild <= i || node.firstChild >= nodes.size() ||
    node.childCount > nodes.size() - node.firstChild)
  {
    return "its children lie outside the table";
  }
  return {};
}

std::string countFault(const std::vector<Node>& nodes, std::size_t i, Refinement refinement)
{
  const Node& node = nodes[i];
  if (node.pointCount > maxNodePoints)
  {
    return "it claims " + std::to_string(node.pointCount) + " points of its own, more than " +
      std::to_string(maxNodePoints);
  }
  std::uint64_t sum = originalPoints(node, refinement);
  for (std::uint32_t k = 0; k < node.childCount; ++k)
  {
    const Node& child = nodes[node.firstChild + k];
    if (child.parent != i)
    {
      return "a child of it names another parent";
    }
    if (child.pointsBelow > UINT64_MAX - sum)
    {
      return "its children's counts are too large";
    }
    sum += child.pointsBelow;
  }
  return sum == node.pointsBelow ? "" : "the points below it do not add up";
}
} // namespace

std::vector<std::byte> encodeNodeTable(const std::vector<Node>& nodes)
{
  ByteWriter out;
  for (const Node& node : nodes)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      out.put(node.centre[axis]);
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      out.put(node.halfSize[axis]);
    }
    out.put(node.radius);
    out.put(node.spacing);
    out.put(node.pointCount);
    out.put(node.pointsBelow);
    out.put(node.parent);
    out.put(node.firstChild);
    out.put(node.childCount);
    out.put(node.level);
    out.put(node.layer);
  }
  assert(out.size() == nodes.size() * nodeRowBytes);
  return out.bytes();
}

std::vector<Node> decodeNodeTable(const std::byte* data, std::uint32_t nodeCount)
{
  ByteReader in(data, std::size_t(nodeCount) * nodeRowBytes);
  std::vector<Node> nodes(nodeCount);
  for (Node& node : nodes)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      node.centre[axis] = in.get<double>();
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      node.halfSize[axis] = in.get<float>();
    }
    node.radius = in.get<float>();
    node.spacing = in.get<float>();
    node.pointCount = in.get<std::uint32_t>();
    node.pointsBelow = in.get<std::uint64_t>();
    node.parent = in.get<std::uint32_t>();
    node.firstChild = in.get<std::uint32_t>();
    node.childCount = in.get<std::uint8_t>();
    node.level = in.get<std::uint8_t>();
    node.layer = in.get<std::uint16_t>();
  }
  return nodes;
}

std::string nodeTableFault(const std::vector<Node>& nodes, std::size_t layerCount,
  std::uint64_t pointCount, Refinement refinement)
{
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i)
  {
    std::string fault = sizeFault(nodes[i]);
    if (fault.empty())
    {
      fault = parentFault(nodes, i);
    }
    if (fault.empty())
    {
      fault = childrenFault(nodes, i);
    }
    if (fault.empty())
    {
      fault = countFault(nodes, i, refinement);
    }
    if (fault.empty() && nodes[i].layer >= layerCount)
    {
      fault = "its layer is not in the list of layers";
    }
    if (!fault.empty())
    {
      return "node " + std::to_string(i) + ": " + fault;
    }
    total += originalPoints(nodes[i], refinement); // at most 2^32 nodes of 2^24 points: no overflow
  }
  if (total != pointCount)
  {
    return "the nodes hold " + std::to_string(total) + " points, the store claims " +
      std::to_string(pointCount);
  }
  return {};
}

std::vector<NodeIndex> rootsOf(const std::vector<Node>& nodes)
{
  std::vector<NodeIndex> roots;
  for (std::size_t i = 0; i < nodes.size(); ++i)
  {
    if (nodes[i].parent == noNode)
    {
      roots.push_back(static_cast<NodeIndex>(i));
    }
  }
  return roots;
}

} // namespace pointfront
