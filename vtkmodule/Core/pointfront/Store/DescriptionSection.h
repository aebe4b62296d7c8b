#pragma once

#include "pointfront/Store/GridBounds.h"
#include "pointfront/Store/StoredCloud.h"
#include "pointfront/Store/StoreFormat.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pointfront
{

/// A description, with the facts that only the file has.
struct StoredDescription
{
  StoreDescription description;
  GridBounds gridBounds; ///< description.bounds is this in world coordinates
  std::vector<NodeIndex> roots; ///< since version 2, ascending; one for each layer that has nodes
};

/// The description section's bytes. Path, version, sizes and the store's counts are not in it: they
/// stand in header and footer. Since version 2 it has what an open store must know of its node
/// table without reading it: levels, counts of the layers, roots. Since version 3
/// it ends with the base of splat radii.
std::vector<std::byte> encodeDescription(
  const StoredDescription& stored, std::uint32_t version = storeVersion);

/// The description in the bytes, or nothing when they are not a description (texts that run over
/// the end, a scalar type or a refinement that does not exist, a scale of zero ...).
std::optional<StoredDescription> decodeDescription(
  const std::byte* data, std::size_t size, std::uint32_t version = storeVersion);

} // namespace pointfront
