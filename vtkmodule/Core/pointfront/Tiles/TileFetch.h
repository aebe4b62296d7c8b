#pragma once

#include "pointfront/Store/StoredCloud.h"

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

} // namespace pointfront
