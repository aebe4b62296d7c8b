#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Front/NodePruning.h"
#include "pointfront/Store/StoredCloud.h"
#include "pointfront/Style/StyleSheet.h"

#include <memory>
#include <vector>

namespace pointfront
{

/// Most nodes of a store that are judged one by one. Breadth first, these hold some 10^10 points;
/// deeper nodes are judged with the subtree of their ancestor.
constexpr NodeIndex mostPrunedNodes = NodeIndex(1) << 20;

/// For each layer the nodes that its styles' filters leave out, by the value ranges of nodes in the
/// store (docs/formats/pfront.md). Null for a hidden layer, for a layer with a style without a
/// filter, and for a store without ranges.
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
