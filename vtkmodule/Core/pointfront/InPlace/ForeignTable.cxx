#include "pointfront/InPlace/ForeignTable.h"

#include "pointfront/Store/StoreFormat.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace pointfront
{
namespace
{
constexpr std::int32_t deepest = 30; ///< so that cells have numbers of 32 bits
constexpr double usualTicks = 128.0; ///< points along the root's side

/// Level, then the path from the root: children of one node are neighbours.
using CellKey = std::tuple<std::int32_t, std::int64_t, std::int64_t, std::int64_t>;

struct Cell
{
  std::uint32_t points = 0;
  std::uint64_t chunk = 0;
  bool named = false;
};

Error bad(const ForeignTreeContent& content, const std::string& what)
{
  return makeError(Error::Kind::BadFormat, content.source.path + ": " + what);
}

std::string nameOf(const ForeignNode& node)
{
  return std::to_string(node.level) + "-" + std::to_string(node.x) + "-" + std::to_string(node.y) +
    "-" + std::to_string(node.z);
}

bool isCell(const ForeignNode& node)
{
  if (node.level < 0 || node.level > deepest)
  {
    return false;
  }
  const std::int64_t cells = std::int64_t(1) << node.level;
  return node.x >= 0 && node.y >= 0 && node.z >= 0 && node.x < cells && node.y < cells &&
    node.z < cells;
}

float upward(double value)
{
  const auto rounded = static_cast<float>(value);
  return rounded < value ? std::nextafter(rounded, std::numeric_limits<float>::max()) : rounded;
}

void setBox(Node& node, const Bounds& box)
{
  node.centre = box.centre();
  const glm::dvec3 half = glm::max(box.high - node.centre, node.centre - box.low);
  node.halfSize = { upward(half.x), upward(half.y), upward(half.z) };
  node.radius = upward(glm::length(glm::dvec3(node.halfSize)));
}

/// All cells that are named, and those above them.
Result<std::map<CellKey, Cell>> cellsOf(const ForeignTreeContent& content)
{
  std::map<CellKey, Cell> cells;
  for (const ForeignNode& node : content.nodes)
  {
    if (!isCell(node))
    {
      return bad(content, "its node " + nameOf(node) + " is no cell of an octree");
    }
    if (node.points > maxNodePoints)
    {
      return bad(content,
        "its node " + nameOf(node) + " claims " + std::to_string(node.points) +
          " points; more than " + std::to_string(maxNodePoints) + " are not read at once");
    }
    Cell& cell = cells[{ node.level, node.x, node.y, node.z }];
    if (cell.named)
    {
      return bad(content, "its node " + nameOf(node) + " is there twice");
    }
    cell = { node.points, node.chunk, true };
    for (std::int32_t up = 1; up <= node.level; ++up)
    {
      cells[{ node.level - up, node.x >> up, node.y >> up, node.z >> up }];
    }
  }
  return cells;
}
} // namespace

Result<ForeignTable> ForeignTable::make(const ForeignTreeContent& content, const glm::dvec3& margin)
{
  const glm::dvec3 reach = glm::abs(content.low) + glm::dvec3(content.side);
  if (!(content.side > 0.0) || !(std::max({ reach.x, reach.y, reach.z }) <= farthestCoordinate))
  {
    return bad(content, "the cube of its octree is none");
  }
  const Result<std::map<CellKey, Cell>> cells = cellsOf(content);
  if (!cells)
  {
    return cells.error();
  }
  ForeignTable table;
  if (cells->empty())
  {
    return table;
  }
  const double spacing = content.spacing > 0.0 && std::isfinite(content.spacing)
    ? content.spacing
    : content.side / usualTicks;
  std::vector<CellKey> keys{ { 0, 0, 0, 0 } };
  table.nodes.emplace_back();
  for (std::size_t i = 0; i < keys.size(); ++i) // grows: breadth first
  {
    const auto [level, x, y, z] = keys[i];
    const Cell& cell = cells->at(keys[i]);
    Node node = table.nodes[i]; // its parent is set
    node.level = static_cast<std::uint8_t>(level);
    node.pointCount = cell.points;
    node.pointsBelow = cell.points;
    node.spacing = static_cast<float>(std::ldexp(spacing, -level));
    const double size = std::ldexp(content.side, -level);
    const glm::dvec3 low = content.low + size * glm::dvec3(double(x), double(y), double(z));
    setBox(node, { low - margin, low + size + margin });
    for (std::int64_t child = 0; child < 8; ++child)
    {
      const CellKey key{ level + 1, 2 * x + (child & 1), 2 * y + ((child >> 1) & 1),
        2 * z + (child >> 2) };
      if (cells->count(key) > 0)
      {
        node.firstChild = node.childCount == 0 ? NodeIndex(keys.size()) : node.firstChild;
        ++node.childCount;
        keys.push_back(key);
        table.nodes.emplace_back();
        table.nodes.back().parent = static_cast<NodeIndex>(i);
      }
    }
    table.nodes[i] = node;
    table.chunks.push_back(cell.chunk);
    table.levels = std::max<std::uint32_t>(table.levels, std::uint32_t(level) + 1);
  }
  for (std::size_t i = table.nodes.size(); i-- > 1;)
  {
    table.nodes[table.nodes[i].parent].pointsBelow += table.nodes[i].pointsBelow;
  }
  return table;
}

void ForeignTable::cutTo(const Bounds& box)
{
  for (Node& node : nodes)
  {
    Bounds cut{ glm::max(node.box().low, box.low), glm::min(node.box().high, box.high) };
    if (!cut.empty())
    {
      setBox(node, cut);
    }
  }
}

} // namespace pointfront
