#include "pointfront/Query/PointsById.h"

#include "pointfront/Query/ChosenColumns.h"
#include "pointfront/Query/ChosenRows.h"
#include "pointfront/Query/NodeOfPoint.h"
#include "pointfront/Query/NodeSweep.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace pointfront
{
namespace
{

/// Ids of one node: ids[first, first + count).
struct NodeIds
{
  NodeIndex node = noNode;
  std::uint32_t points = 0;
  std::size_t first = 0;
  std::size_t count = 0;
};

Error notInCloud(const StoreDescription& store, std::uint64_t id)
{
  return makeError(
    Error::Kind::BadArgument, store.path + ": it has no point of the id " + std::to_string(id));
}

/// Whether a node is below a root: an epoch of a collection has some of the roots, and the table
/// has the nodes of all.
bool isShown(const Hierarchy& hierarchy, Node node, NodeIndex index)
{
  while (node.parent != noNode)
  {
    index = node.parent;
    node = hierarchy.node(index);
  }
  const std::vector<NodeIndex>& roots = hierarchy.roots();
  return std::find(roots.begin(), roots.end(), index) != roots.end();
}

Result<std::vector<NodeIds>> nodesOf(
  const StoredCloud& store, const std::vector<std::uint64_t>& ids)
{
  const Hierarchy& hierarchy = *store.hierarchy();
  std::vector<NodeIds> nodes;
  for (std::size_t i = 0; i < ids.size();)
  {
    if (hierarchy.nodeCount() == 0)
    {
      return notInCloud(store.description(), ids[i]);
    }
    const NodeIndex index = nodeOfPoint(hierarchy, ids[i]);
    const Node row = hierarchy.node(index);
    const bool shown = isShown(hierarchy, row, index);
    if (std::optional<Error> damage = hierarchy.fault())
    {
      return *damage;
    }
    const std::uint64_t end = row.firstPoint + row.pointCount;
    if (ids[i] >= end || !shown)
    {
      return notInCloud(store.description(), ids[i]);
    }
    const auto after =
      std::lower_bound(ids.begin() + static_cast<std::ptrdiff_t>(i), ids.end(), end);
    const auto next = static_cast<std::size_t>(after - ids.begin());
    nodes.push_back({ index, row.pointCount, i, next - i });
    i = next;
  }
  return nodes;
}

/// The node's points of these ids.
QueryBatch chosen(const NodeIds& of, const std::vector<std::uint64_t>& ids,
  const StoreDescription& description, const NodeColumns& node)
{
  std::vector<std::uint32_t> rows(of.count);
  for (std::size_t i = 0; i < of.count; ++i)
  {
    rows[i] = static_cast<std::uint32_t>(ids[of.first + i] - node.firstPoint);
  }
  return chosenRows(node, rows, description);
}

} // namespace

Result<QueryReport> pointsById(const StoredCloud& store, const std::vector<std::uint64_t>& ids,
  const std::optional<std::vector<std::string>>& attributes, const QueryOptions& options,
  const QueryConsumer& consume)
{
  if (std::adjacent_find(ids.begin(), ids.end(), std::greater_equal<>()) != ids.end())
  {
    return makeError(Error::Kind::BadArgument, "ids of points must ascend, each once");
  }
  const Result<ChosenColumns> columns = ChosenColumns::make(store.description(), attributes);
  if (!columns)
  {
    return columns.error();
  }
  const Result<std::vector<NodeIds>> nodes = nodesOf(store, ids);
  if (!nodes)
  {
    return nodes.error();
  }
  NodeSweep sweep;
  sweep.count = nodes->size();
  sweep.columns = columns->columns;
  sweep.resultBytes =
    sizeof(std::uint64_t) + sizeof(glm::dvec3) + columns->description.schema.pointBytes();
  sweep.node = [&nodes](std::size_t i) { return (*nodes)[i].node; };
  sweep.points = [&nodes](std::size_t i) { return (*nodes)[i].points; };
  sweep.choose = [&](std::size_t i, NodeColumns&& node)
  { return chosen((*nodes)[i], ids, store.description(), node); };
  return sweepNodes(store, sweep, options, consume);
}

} // namespace pointfront
