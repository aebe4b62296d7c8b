#include "pointfront/Trees/BuiltTree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pointfront
{
float roundedUp(double v)
{
  float f = static_cast<float>(v);
  while (static_cast<double>(f) < v)
  {
    f = std::nextafter(f, std::numeric_limits<float>::infinity());
  }
  return f;
}

namespace
{
/// A leaf's spacing is an estimate; it must still be finer than what its parent shows.
constexpr float spacingFall = 0.75f;

/// Smallest float h with centre - h <= low and high <= centre + h, evaluated as box() does.
float halfSizeOf(double centre, double low, double high)
{
  float h = roundedUp(std::max(high - centre, centre - low));
  while (centre - static_cast<double>(h) > low || centre + static_cast<double>(h) < high)
  {
    h = std::nextafter(h, std::numeric_limits<float>::infinity());
  }
  return h;
}
} // namespace

void encloseNode(
  Node& row, const Bounds& own, const std::vector<std::unique_ptr<BuiltNode>>& children)
{
  Bounds box = own;
  for (const auto& child : children)
  {
    box.add(child->row.box());
  }
  encloseBox(row, box);
}

void encloseBox(Node& row, const Bounds& box)
{
  row.centre = box.centre();
  for (int axis = 0; axis < 3; ++axis)
  {
    row.halfSize[axis] = halfSizeOf(row.centre[axis], box.low[axis], box.high[axis]);
  }
  row.radius = roundedUp(glm::length(glm::dvec3(row.halfSize)));
}

NodeTable nodeTable(const std::vector<std::unique_ptr<BuiltNode>>& trees)
{
  NodeTable table;
  std::vector<const BuiltNode*> order;
  for (std::size_t layer = 0; layer < trees.size(); ++layer)
  {
    if (const BuiltNode* root = trees[layer].get())
    {
      table.roots.push_back(static_cast<NodeIndex>(order.size()));
      order.push_back(root);
      table.nodes.push_back(root->row);
      table.nodes.back().layer = static_cast<std::uint16_t>(layer);
    }
  }
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const BuiltNode& node = *order[i];
    table.payloads.push_back(node.payload);
    table.levels = std::max(table.levels, table.nodes[i].level + 1u);
    if (node.children.empty())
    {
      continue;
    }
    table.nodes[i].firstChild = static_cast<NodeIndex>(order.size());
    table.nodes[i].childCount = static_cast<std::uint8_t>(node.children.size());
    for (const auto& child : node.children)
    {
      Node row = child->row;
      row.parent = static_cast<NodeIndex>(i);
      row.layer = table.nodes[i].layer;
      row.level = static_cast<std::uint8_t>(table.nodes[i].level + 1);
      row.spacing = std::min(row.spacing, spacingFall * table.nodes[i].spacing);
      order.push_back(child.get());
      table.nodes.push_back(row);
    }
  }
  return table;
}

} // namespace pointfront
