#pragma once

#include "Overview.h"

#include "pointfront/Query/QueryBatch.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace pointfront
{

/// Points of one node, by their positions in it, ascending.
struct NodeRows
{
  NodeIndex node = noNode;
  std::vector<std::uint32_t> rows;
};

/// The places of the points with those ids, except the points of `overview`: in table order, each
/// once.
/// Errors  BadArgument: an id beyond the store's points; damage of the table that was met.
Result<std::vector<NodeRows>> locatePoints(const Hierarchy& hierarchy,
  std::vector<std::uint64_t> ids, const std::vector<OverviewPart>& overview);

/// The points of the input in all nodes whose box satisfies `overlaps`, except the points of
/// `overview`. They contain all points of the region that `overlaps` describes. In table order.
/// Errors  damage of the table that was met.
Result<std::vector<NodeRows>> pointsOfNodes(const Hierarchy& hierarchy,
  const std::function<bool(const Bounds&)>& overlaps, const std::vector<OverviewPart>& overview);

std::uint64_t countOf(const std::vector<NodeRows>& points);

/// The share of piece `piece` of `pieces`: neighbours. All shares have about as many points, and
/// together they have each point once.
std::vector<NodeRows> shareOf(std::vector<NodeRows> points, int piece, int pieces);

/// Fills `output` with those points (PointArrays).
/// Errors  those of sweepNodes().
Result<void> fillPoints(const StoredCloud& store, const std::vector<NodeRows>& points,
  const ColumnSelection& columns, const QueryOptions& options, vtkPolyData* output);

} // namespace pointfront
