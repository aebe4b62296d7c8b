#include "LocatedPoints.h"

#include "PointArrays.h"

#include "pointfront/Query/ChosenRows.h"
#include "pointfront/Query/NodeOfPoint.h"
#include "pointfront/Query/NodeSweep.h"

#include <vtkPolyData.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>

namespace pointfront
{
namespace
{

/// How many points of a node the overview has: its first ones.
std::uint32_t overviewPoints(const std::vector<OverviewPart>& overview, NodeIndex node)
{
  const auto found = std::lower_bound(overview.begin(), overview.end(), node,
    [](const OverviewPart& part, NodeIndex index) { return part.node < index; });
  return found != overview.end() && found->node == node ? found->pointCount : 0;
}

} // namespace

Result<std::vector<NodeRows>> locatePoints(const Hierarchy& hierarchy,
  std::vector<std::uint64_t> ids, const std::vector<OverviewPart>& overview)
{
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  std::vector<NodeRows> found;
  auto id = ids.begin();
  while (id != ids.end() && hierarchy.nodeCount() > 0)
  {
    const NodeIndex index = nodeOfPoint(hierarchy, *id);
    const Node node = hierarchy.node(index);
    if (const std::optional<Error> damage = hierarchy.fault())
    {
      return *damage;
    }
    if (*id >= node.firstPoint + node.pointCount)
    {
      break;
    }
    const std::uint32_t known = overviewPoints(overview, index);
    NodeRows rows{ index, {} };
    for (; id != ids.end() && *id < node.firstPoint + node.pointCount; ++id)
    {
      const auto row = static_cast<std::uint32_t>(*id - node.firstPoint);
      if (row >= known)
      {
        rows.rows.push_back(row);
      }
    }
    if (!rows.rows.empty())
    {
      found.push_back(std::move(rows));
    }
  }
  if (id != ids.end())
  {
    return makeError(
      Error::Kind::BadArgument, "the cloud has no point of the id " + std::to_string(*id));
  }
  return found;
}

Result<std::vector<NodeRows>> pointsOfNodes(const Hierarchy& hierarchy,
  const std::function<bool(const Bounds&)>& overlaps, const std::vector<OverviewPart>& overview)
{
  std::vector<NodeRows> found;
  std::vector<NodeIndex> left(hierarchy.roots());
  while (!left.empty())
  {
    const NodeIndex index = left.back();
    left.pop_back();
    const Node node = hierarchy.node(index);
    if (!overlaps(node.box()))
    {
      continue;
    }
    hierarchy.appendChildren(index, node, left);
    const std::uint32_t points = originalPoints(node, hierarchy.refinement());
    const std::uint32_t known = std::min(overviewPoints(overview, index), points);
    if (known < points)
    {
      NodeRows rows{ index, std::vector<std::uint32_t>(points - known) };
      std::iota(rows.rows.begin(), rows.rows.end(), known);
      found.push_back(std::move(rows));
    }
  }
  if (const std::optional<Error> damage = hierarchy.fault())
  {
    return *damage;
  }
  std::sort(found.begin(), found.end(),
    [](const NodeRows& a, const NodeRows& b) { return a.node < b.node; });
  return found;
}

std::uint64_t countOf(const std::vector<NodeRows>& points)
{
  std::uint64_t total = 0;
  for (const NodeRows& node : points)
  {
    total += node.rows.size();
  }
  return total;
}

std::vector<NodeRows> shareOf(std::vector<NodeRows> points, int piece, int pieces)
{
  const std::uint64_t total = countOf(points);
  const auto begins = [&](int number)
  { return total * static_cast<std::uint64_t>(number) / static_cast<std::uint64_t>(pieces); };
  const std::uint64_t first = begins(piece);
  const std::uint64_t end = begins(piece + 1);
  std::vector<NodeRows> share;
  std::uint64_t before = 0;
  for (NodeRows& node : points)
  {
    const std::uint64_t count = node.rows.size();
    const std::uint64_t from = std::clamp(first, before, before + count) - before;
    const std::uint64_t to = std::clamp(end, before, before + count) - before;
    before += count;
    if (from < to)
    {
      const auto rows = node.rows.begin();
      share.push_back({ node.node,
        { rows + static_cast<std::ptrdiff_t>(from), rows + static_cast<std::ptrdiff_t>(to) } });
    }
  }
  return share;
}

Result<void> fillPoints(const StoredCloud& store, const std::vector<NodeRows>& points,
  const ColumnSelection& columns, const QueryOptions& options, vtkPolyData* output)
{
  const StoreDescription& description = store.description();
  PointArrays arrays(description, columns, countOf(points));
  NodeSweep sweep;
  sweep.count = points.size();
  sweep.columns = columns;
  sweep.resultBytes = sizeof(std::uint64_t) + sizeof(glm::dvec3) + description.schema.pointBytes();
  sweep.node = [&](std::size_t i) { return points[i].node; };
  sweep.points = [&](std::size_t i) { return store.hierarchy()->node(points[i].node).pointCount; };
  sweep.choose = [&](std::size_t i, NodeColumns&& node)
  { return chosenRows(node, points[i].rows, description); };
  Progress done;
  done.phase = options.phase;
  done.total = countOf(points);
  const auto goesOn = [&] { return !options.progress || options.progress(done); };
  const auto add = [&](QueryBatch& batch) -> Result<void>
  {
    arrays.add(batch);
    done.done += batch.size();
    done.fraction = static_cast<double>(done.done) / static_cast<double>(done.total);
    return goesOn() ? Result<void>() : makeError(Error::Kind::Cancelled, "reading was stopped");
  };
  QueryOptions roomy = options; // one node at a time goes, however large it is
  roomy.memoryBytes = std::max(options.memoryBytes, leastSweepBytes(store, sweep));
  roomy.progress = [&](const Progress&) { return goesOn(); }; // also while nothing comes
  const Result<QueryReport> read = sweepNodes(store, sweep, roomy, add);
  if (!read)
  {
    return read.error();
  }
  arrays.moveTo(output);
  return {};
}

} // namespace pointfront
