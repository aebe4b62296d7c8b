#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Store/Hierarchy.h"
#include "pointfront/Store/StoredCloud.h"

#include <cstdint>
#include <functional>
#include <vector>

class vtkPolyData;

namespace pointfront
{

/// A prefix of one node.
struct OverviewPart
{
  NodeIndex node = noNode;
  std::uint32_t pointCount = 0;
};

/// The parts of an overview of at most `maxPoints` points. Each layer and each subtree has its
/// share of the cloud's points, so histograms and statistics of the overview are close to those of
/// the cloud. Below the size of some thousand points a share is spread evenly over the subtree's
/// box (each prefix of a node is a fair subset of it). In table order, which is breadth first.
std::vector<OverviewPart> chooseOverview(const Hierarchy& hierarchy, std::uint64_t maxPoints);

/// The parts of piece `piece` of `pieces`: neighbours in the table. All pieces have about as many
/// points, and together they have each part once.
std::vector<OverviewPart> overviewPiece(
  const std::vector<OverviewPart>& parts, int piece, int pieces);

/// Fills `output` with those parts (PointArrays).
/// Errors  those of NodeReader::read; Cancelled when `advance` (fraction done) returns false.
Result<void> fillOverview(const StoredCloud& store, const std::vector<OverviewPart>& parts,
  const ColumnSelection& columns, vtkPolyData* output, const std::function<bool(double)>& advance);

} // namespace pointfront
