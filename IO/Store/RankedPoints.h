#pragma once

#include "Overview.h"

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

/// Where the points with those ranks lie that `overview` does not have: in table order, each once.
/// Ranks that the store does not have are left out.
/// Errors  damage of the table that was met.
Result<std::vector<NodeRows>> locatePoints(const Hierarchy& hierarchy,
  std::vector<std::uint64_t> ranks, const std::vector<OverviewPart>& overview);

/// Points of the input in all nodes whose box satisfies `overlaps`, without those that `overview`
/// has: no fewer than those in the region that `overlaps` asks about. In table order.
/// Errors  damage of the table that was met.
Result<std::vector<NodeRows>> pointsOfNodes(const Hierarchy& hierarchy,
  const std::function<bool(const Bounds&)>& overlaps, const std::vector<OverviewPart>& overview);

std::uint64_t countOf(const std::vector<NodeRows>& points);

/// Share `piece` of `pieces`: neighbours, about as many points in each; together each point once.
std::vector<NodeRows> shareOf(std::vector<NodeRows> points, int piece, int pieces);

/// Fills `output` with those points (PointArrays).
/// Errors  those of NodeReader::read.
Result<void> fillPoints(const StoredCloud& store, const std::vector<NodeRows>& points,
  const ColumnSelection& columns, vtkPolyData* output);

} // namespace pointfront
