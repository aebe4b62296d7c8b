#pragma once

#include "pointfront/Query/QueryBatch.h"
#include "pointfront/Store/NodeReader.h"
#include "pointfront/Store/StoredCloud.h"

#include <cstdint>
#include <vector>

namespace pointfront
{

/// The points of a node at those positions in it, in their order, with world coordinates and the
/// columns that were read.
/// `description`  of the cloud that the node was read from.
QueryBatch chosenRows(const NodeColumns& node, const std::vector<std::uint32_t>& rows,
  const StoreDescription& description);

} // namespace pointfront
