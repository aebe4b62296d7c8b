#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Front/NodePruning.h"
#include "pointfront/Store/StoredCloud.h"
#include "pointfront/Style/StyleSheet.h"

#include <memory>
#include <vector>

namespace pointfront
{

/// More nodes of a store than this are not judged one by one; breadth first, they are some 10^10
/// points, and what lies below them is judged with their subtrees.
constexpr NodeIndex mostPrunedNodes = NodeIndex(1) << 20;

/// For each layer the nodes that its styles' filters leave out, by the ranges that the store knows
/// of its nodes (docs/formats/pfront.md). Null for a layer that has a style without a filter, that
/// is hidden, or where the store knows nothing.
/// Exactness  no point that passes a filter is left out: ranges are wider than values, never
///            narrower. One object for layers of equal filters.
/// Cost       4 bytes of the disk for each node and condition, and some ns; may wait for the disk.
Result<std::vector<std::shared_ptr<const NodePruning>>> pruningOf(const StoredCloud& store,
  const std::vector<LayerStyling>& layers, NodeIndex mostNodes = mostPrunedNodes);

/// The same of one filter, for the whole cloud.
Result<std::shared_ptr<const NodePruning>> pruningOf(
  const StoredCloud& store, const PointFilter& filter, NodeIndex mostNodes = mostPrunedNodes);

/// The range of world values that a filter's condition is to be asked with.
ValueRange inWorldUnits(
  const AttributeCondition& condition, const AttributeSchema& schema, const ValueRange& stored);

} // namespace pointfront
