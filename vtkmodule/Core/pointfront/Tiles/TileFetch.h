#pragma once

#include "pointfront/Points/AttributeSchema.h"
#include "pointfront/Store/StoredCloud.h"

#include <cstddef>
#include <vector>

namespace pointfront
{

/// A node of one of the clouds that a cloud is made of.
struct WantedOfTile
{
  const StoredCloud* tile = nullptr;
  WantedNode node;
};

/// Fetches the nodes of each tile together, and far tiles beside each other. The answers are in the
/// order of `wanted`.
std::vector<Result<FetchedNode>> fetchTiles(
  const std::vector<WantedOfTile>& wanted, const ReadStop& stop);

/// Points `begin` to `end` of a node; no more memory than they take. `schema` is the node's own.
NodeColumns sliced(
  const NodeColumns& node, std::size_t begin, std::size_t end, const AttributeSchema& schema);

/// Each open tile holds a file open: raises the limit of this process as far as it may be raised.
void raiseOpenFiles(std::size_t tiles);

} // namespace pointfront
