#include "pointfront/Store/NodeTableSection.h"

#include "pointfront/Codec/ByteStream.h"
#include "pointfront/Store/NodePage.h"
#include "pointfront/Store/StoredCloud.h"

#include <algorithm>
#include <cassert>

namespace pointfront
{
namespace
{
std::string parentFault(const Hierarchy& table, NodeIndex index, const Node& node)
{
  if (node.parent == noNode)
  {
    return {};
  }
  const Node parent = table.node(node.parent);
  if (index < parent.firstChild || index - parent.firstChild >= parent.childCount)
  {
    return "its parent does not name it as a child";
  }
  if (node.level != parent.level + 1)
  {
    return "its level does not follow its parent's";
  }
  return node.layer == parent.layer ? "" : "its layer is not its parent's";
}

std::string countFault(const Hierarchy& table, NodeIndex index, const Node& node)
{
  std::uint64_t sum = originalPoints(node, table.refinement());
  for (std::uint32_t k = 0; k < node.childCount; ++k)
  {
    const Node child = table.node(node.firstChild + k);
    if (child.parent != index)
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

std::string rootFault(const Hierarchy& table, NodeIndex index, const Node& node, std::size_t& root)
{
  if (node.parent != noNode)
  {
    return {};
  }
  const bool listed = root < table.roots().size() && table.roots()[root] == index;
  ++root;
  return listed ? "" : "it has no parent and is not in the list of roots";
}

std::string nodeFault(const Hierarchy& table, NodeIndex index, const Node& node,
  const TableLimits& limits, std::size_t& root)
{
  std::string fault = rowFault(node, index, limits);
  fault = fault.empty() ? parentFault(table, index, node) : fault;
  fault = fault.empty() ? countFault(table, index, node) : fault;
  return fault.empty() ? rootFault(table, index, node, root) : fault;
}
} // namespace

BorrowedTable::BorrowedTable(const std::vector<Node>& nodes, Refinement refinement)
  : nodes_(nodes)
  , roots_(rootsOf(nodes))
  , refinement_(refinement)
{
}

void encodeNodeRow(const Node& node, NodeRowForm form, ByteWriter& out)
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
  if (form == NodeRowForm::WithSplatRadius)
  {
    out.put(node.splatRadius);
  }
}

Node decodeNodeRow(NodeRowForm form, ByteReader& in)
{
  Node node;
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
  if (form == NodeRowForm::WithSplatRadius)
  {
    node.splatRadius = in.get<float>();
  }
  return node;
}

std::vector<std::byte> encodeNodeTable(const std::vector<Node>& nodes, NodeRowForm form)
{
  ByteWriter out;
  for (const Node& node : nodes)
  {
    encodeNodeRow(node, form, out);
  }
  assert(out.size() == nodes.size() * nodeRowBytes(form));
  return out.bytes();
}

std::vector<Node> decodeNodeTable(const std::byte* data, std::uint32_t nodeCount, NodeRowForm form)
{
  ByteReader in(data, std::size_t(nodeCount) * nodeRowBytes(form));
  std::vector<Node> nodes(nodeCount);
  for (Node& node : nodes)
  {
    node = decodeNodeRow(form, in);
  }
  return nodes;
}

std::string nodeTableFault(const Hierarchy& table, std::size_t layerCount, std::uint64_t pointCount)
{
  const TableLimits limits{ table.nodeCount(), static_cast<std::uint32_t>(layerCount) };
  std::uint64_t total = 0;
  std::size_t root = 0;
  for (NodeIndex i = 0; i < limits.nodes; ++i)
  {
    const Node node = table.node(i);
    const std::string fault = nodeFault(table, i, node, limits, root);
    if (const std::optional<Error> damage = table.fault())
    {
      return damage->what;
    }
    if (!fault.empty())
    {
      return "node " + std::to_string(i) + ": " + fault;
    }
    total += originalPoints(node, table.refinement()); // 2^32 nodes of 2^24 points: no overflow
  }
  if (root != table.roots().size())
  {
    return "the list of roots names " + std::to_string(table.roots().size()) + " nodes, " +
      std::to_string(root) + " have no parent";
  }
  if (total != pointCount)
  {
    return "the nodes hold " + std::to_string(total) + " points, the store claims " +
      std::to_string(pointCount);
  }
  return {};
}

std::string nodeTableFault(const std::vector<Node>& nodes, std::size_t layerCount,
  std::uint64_t pointCount, Refinement refinement)
{
  return nodeTableFault(BorrowedTable(nodes, refinement), layerCount, pointCount);
}

void countLayers(const Hierarchy& table, StoreDescription& description)
{
  for (Layer& layer : description.layers)
  {
    layer.pointCount = 0;
    layer.nodeCount = 0;
  }
  description.levels = 0;
  for (NodeIndex i = 0; i < table.nodeCount(); ++i)
  {
    const Node node = table.node(i);
    Layer& layer = description.layers[node.layer];
    layer.pointCount += originalPoints(node, table.refinement());
    ++layer.nodeCount;
    description.levels = std::max<std::uint32_t>(description.levels, node.level + 1u);
  }
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
