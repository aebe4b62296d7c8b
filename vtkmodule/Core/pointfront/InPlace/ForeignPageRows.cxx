#include "pointfront/InPlace/ForeignPageRows.h"

#include "pointfront/Store/StoreFormat.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::int32_t deepest = 30; ///< so that cells have numbers of 32 bits

/// Level, then the path from the root: children of one node are neighbours.
using CellKey = std::tuple<std::int32_t, std::int32_t, std::int32_t, std::int32_t>;

struct Cell
{
  ForeignNode node;
  bool named = false;
  bool page = false;
};
using Cells = std::map<CellKey, Cell>;

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

CellKey keyAbove(const ForeignNode& node, std::int32_t levels)
{
  return { node.level - levels, node.x >> levels, node.y >> levels, node.z >> levels };
}

float upward(double value)
{
  const auto rounded = static_cast<float>(value);
  return rounded < value ? std::nextafter(rounded, std::numeric_limits<float>::max()) : rounded;
}

/// Collects the cells that a page names, and those between them and its root.
class PageCells
{
public:
  PageCells(const ForeignNode& root, const std::string& path)
    : root_(root)
    , path_(path)
  {
  }

  Result<void> add(const ForeignNode& node, bool page)
  {
    const std::int32_t below = node.level - root_.level;
    if (!isCell(node))
    {
      return bad(node, "is no cell of an octree");
    }
    if (below < 0 || keyAbove(node, below) != keyAbove(root_, 0) || (page && below == 0))
    {
      return bad(node, "does not lie below " + nameOf(root_) + ", whose page names it");
    }
    if (!page && node.points > maxNodePoints)
    {
      return bad(node,
        "claims " + std::to_string(node.points) + " points; more than " +
          std::to_string(maxNodePoints) + " are not read at once");
    }
    Cell& cell = cells[keyAbove(node, 0)];
    if (cell.named)
    {
      return bad(node, "is there twice");
    }
    cell = { node, true, page };
    for (std::int32_t up = 1; up <= below; ++up)
    {
      const CellKey key = keyAbove(node, up);
      Cell& above = cells[key];
      if (!above.named)
      {
        const auto [level, x, y, z] = key;
        above.node.level = level;
        above.node.x = x;
        above.node.y = y;
        above.node.z = z;
      }
    }
    return {};
  }

  /// Nodes below a page that somebody else has would be there twice.
  Result<void> check() const
  {
    for (const auto& [key, cell] : cells)
    {
      for (std::int32_t up = 1; up <= cell.node.level - root_.level; ++up)
      {
        if (cells.at(keyAbove(cell.node, up)).page)
        {
          return bad(cell.node, "lies below one that has a page of its own");
        }
      }
    }
    return {};
  }

  Cells cells;

private:
  Error bad(const ForeignNode& node, const std::string& what) const
  {
    return makeError(Error::Kind::BadFormat, path_ + ": its node " + nameOf(node) + " " + what);
  }

  const ForeignNode& root_;
  const std::string& path_;
};

/// Points of the page's own, from the leaves up; what it does not tell of those that are claimed,
/// evenly for each page below.
void countPoints(ForeignPageRows& page, std::uint64_t claimed)
{
  const std::uint64_t pages = page.pages.size();
  const std::uint64_t each =
    pages > 0 ? std::max<std::uint64_t>(1, (claimed - std::min(claimed, page.points)) / pages) : 0;
  std::uint64_t points = 0;
  for (ForeignRow& row : page.rows)
  {
    row.row.firstPoint = points;
    points += row.row.pointCount;
    row.row.pointsBelow = row.page ? each : row.row.pointCount;
  }
  for (std::size_t i = page.rows.size(); i-- > 1;)
  {
    page.rows[page.rows[i].row.parent].row.pointsBelow += page.rows[i].row.pointsBelow;
  }
}
} // namespace

void ForeignCells::setBox(Node& node, const Bounds& box) const
{
  node.centre = box.centre();
  const glm::dvec3 half = glm::max(box.high - node.centre, node.centre - box.low);
  node.halfSize = { upward(half.x), upward(half.y), upward(half.z) };
  node.radius = upward(glm::length(glm::dvec3(node.halfSize)));
}

void ForeignCells::cutRow(Node& node) const
{
  if (cut)
  {
    const Bounds box{ glm::max(node.box().low, cut->low), glm::min(node.box().high, cut->high) };
    if (!box.empty())
    {
      setBox(node, box);
    }
  }
}

Node ForeignCells::rowOf(const ForeignNode& cell) const
{
  Node node;
  node.level = static_cast<std::uint8_t>(cell.level);
  node.pointCount = cell.points;
  node.spacing = static_cast<float>(std::ldexp(spacing, -cell.level));
  const double size = std::ldexp(side, -cell.level);
  const glm::dvec3 corner = low + size * glm::dvec3(double(cell.x), double(cell.y), double(cell.z));
  setBox(node, { corner - margin, corner + size + margin });
  cutRow(node);
  return node;
}

Result<ForeignPageRows> ForeignPageRows::make(const ForeignPage& page, const ForeignNode& root,
  std::uint64_t claimed, const ForeignCells& cells, const std::string& path)
{
  PageCells named(root, path);
  named.cells[keyAbove(root, 0)].node = { root.level, root.x, root.y, root.z, 0, 0, 0 };
  for (const bool pages : { false, true })
  {
    for (const ForeignNode& node : pages ? page.pages : page.nodes)
    {
      if (Result<void> added = named.add(node, pages); !added)
      {
        return added.error();
      }
    }
  }
  if (Result<void> sound = named.check(); !sound)
  {
    return sound.error();
  }
  ForeignPageRows made;
  const auto append = [&](const Cell& cell, NodeIndex parent)
  {
    ForeignRow row;
    row.cell = cell.node;
    if (cell.page)
    {
      row.page = made.pages.size();
      made.pages.push_back(cell.node);
      row.cell.points = 0;
    }
    row.row = cells.rowOf(row.cell);
    row.row.parent = parent;
    made.points += row.row.pointCount;
    made.levels = std::max<std::uint32_t>(made.levels, row.row.level + 1u);
    made.rows.push_back(std::move(row));
  };
  append(named.cells.at(keyAbove(root, 0)), noNode);
  for (std::size_t i = 0; i < made.rows.size(); ++i) // grows: breadth first
  {
    const ForeignNode cell = made.rows[i].cell;
    for (std::int32_t child = 0; child < 8 && !made.rows[i].page && cell.level < deepest; ++child)
    {
      const auto found = named.cells.find({ cell.level + 1, 2 * cell.x + (child & 1),
        2 * cell.y + ((child >> 1) & 1), 2 * cell.z + (child >> 2) });
      if (found != named.cells.end())
      {
        Node& row = made.rows[i].row;
        row.firstChild = row.childCount == 0 ? NodeIndex(made.rows.size()) : row.firstChild;
        ++row.childCount;
        append(found->second, static_cast<NodeIndex>(i));
      }
    }
  }
  countPoints(made, claimed);
  return made;
}

} // namespace pointfront
