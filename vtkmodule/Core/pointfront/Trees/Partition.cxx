#include "pointfront/Trees/Partition.h"

#include "pointfront/Trees/OctreeSplit.h"

#include <algorithm>
#include <cassert>

namespace pointfront
{
namespace
{
/// The smallest cell around all counted cells of a range in Morton order.
OctreeCell cellAround(const std::vector<CountedCell>& cells, IndexRange range, unsigned cellLog2)
{
  const OctreeCell cell = commonCell(cells[range.begin].origin, cells[range.end - 1].origin);
  return cell.log2Side >= cellLog2 ? cell : OctreeCell{ cells[range.begin].origin, cellLog2 };
}

struct OpenRange
{
  IndexRange range;
  std::uint32_t parent;
};
} // namespace

Partition::Partition(const std::vector<CountedCell>& cells, unsigned cellLog2,
  std::uint64_t partPoints, std::vector<std::uint32_t>& partOf)
{
  partOf.assign(cells.size(), none);
  std::vector<std::uint64_t> before{ 0 };
  for (const CountedCell& cell : cells)
  {
    before.push_back(before.back() + cell.count);
  }
  std::vector<OpenRange> open;
  if (!cells.empty())
  {
    open.push_back({ { 0, cells.size() }, none });
  }
  while (!open.empty())
  {
    const OpenRange next = open.back();
    open.pop_back();
    const std::uint64_t count = before[next.range.end] - before[next.range.begin];
    const OctreeCell cell = cellAround(cells, next.range, cellLog2);
    if (count <= partPoints || next.range.end - next.range.begin == 1)
    {
      const std::uint32_t number = nodes_[addPart(cell, count, next.parent)].part;
      std::fill(partOf.begin() + static_cast<std::ptrdiff_t>(next.range.begin),
        partOf.begin() + static_cast<std::ptrdiff_t>(next.range.end), number);
      continue;
    }
    const std::uint32_t node = addNode(cell, count, next.parent);
    const auto octant = [&](std::uint64_t i) { return octantOf(cells[i].origin, cell.log2Side); };
    const std::vector<IndexRange> split = splitRange(next.range, cell.log2Side, octant);
    for (auto range = split.rbegin(); range != split.rend(); ++range)
    {
      open.push_back({ *range, node }); // the last in is the first out: octant order
    }
  }
}

std::uint32_t Partition::nodeAt(std::size_t layer, const TreePosition& position) const
{
  const auto holds = [&](std::uint32_t node)
  { return differingBits(position, nodes_[node].cell.origin) <= nodes_[node].cell.log2Side; };
  if (layer >= roots_.size() || !holds(roots_[layer]))
  {
    return none;
  }
  std::uint32_t node = roots_[layer];
  for (;;)
  {
    const std::vector<std::uint32_t>& children = nodes_[node].children;
    const auto child = std::find_if(children.begin(), children.end(), holds);
    const bool byOrder = nodes_[node].cell.log2Side == 0; // all children have the same cell
    if (child == children.end() || byOrder)
    {
      return node;
    }
    node = *child;
  }
}

std::uint32_t Partition::addNode(OctreeCell cell, std::uint64_t count, std::uint32_t parent)
{
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  nodes_.back().cell = cell;
  nodes_.back().count = count;
  nodes_.back().parent = parent;
  if (parent == none)
  {
    roots_.push_back(index);
  }
  else
  {
    nodes_.back().layer = nodes_[parent].layer;
    nodes_[parent].children.push_back(index);
  }
  return index;
}

std::uint32_t Partition::addPart(OctreeCell cell, std::uint64_t count, std::uint32_t parent)
{
  const std::uint32_t index = addNode(cell, count, parent);
  nodes_[index].part = partCount();
  parts_.push_back(index);
  return index;
}

std::vector<std::uint32_t> Partition::refine(std::uint32_t part, const Partition& finer)
{
  assert(finer.nodes_.size() > 0);
  const std::uint32_t place = parts_[part];
  std::vector<std::uint32_t> nodeOf(finer.nodes_.size());
  std::vector<std::uint32_t> numbers(finer.partCount());
  bool firstPart = true;
  for (std::uint32_t i = 0; i < finer.nodes_.size(); ++i)
  {
    const Node& node = finer.nodes_[i];
    if (i == 0)
    {
      nodeOf[0] = place;
      nodes_[place].cell = node.cell;
      nodes_[place].part = none;
    }
    else
    {
      nodeOf[i] = addNode(node.cell, node.count, nodeOf[node.parent]);
    }
    if (node.part != none)
    {
      const std::uint32_t number = firstPart ? part : partCount();
      if (!firstPart)
      {
        parts_.push_back(none);
      }
      firstPart = false;
      parts_[number] = nodeOf[i];
      nodes_[nodeOf[i]].part = number;
      numbers[node.part] = number;
    }
  }
  return numbers;
}

std::vector<std::uint32_t> Partition::refineByOrder(std::uint32_t part)
{
  const std::uint32_t place = parts_[part];
  const OctreeCell cell = nodes_[place].cell;
  const std::vector<IndexRange> runs =
    splitRange({ 0, nodes_[place].count }, 0, [](std::uint64_t) { return 0u; });
  nodes_[place].part = none;
  std::vector<std::uint32_t> numbers;
  for (const IndexRange& run : runs)
  {
    const std::uint64_t count = run.end - run.begin;
    if (numbers.empty())
    {
      const std::uint32_t index = addNode(cell, count, place);
      nodes_[index].part = part;
      parts_[part] = index;
      numbers.push_back(part);
    }
    else
    {
      numbers.push_back(nodes_[addPart(cell, count, place)].part);
    }
  }
  return numbers;
}

void Partition::append(const Partition& other)
{
  const auto firstNode = static_cast<std::uint32_t>(nodes_.size());
  const std::uint32_t firstPart = partCount();
  const auto layer = static_cast<std::uint16_t>(nodes_.empty() ? 0 : nodes_.back().layer + 1);
  for (const std::uint32_t root : other.roots_)
  {
    roots_.push_back(firstNode + root);
  }
  for (Node node : other.nodes_)
  {
    node.layer = layer;
    node.parent += node.parent != none ? firstNode : 0;
    node.part += node.part != none ? firstPart : 0;
    for (std::uint32_t& child : node.children)
    {
      child += firstNode;
    }
    nodes_.push_back(std::move(node));
  }
  for (const std::uint32_t place : other.parts_)
  {
    parts_.push_back(firstNode + place);
  }
}

} // namespace pointfront
