#pragma once

#include "pointfront/Store/GridBounds.h"
#include "pointfront/Store/StoredCloud.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace pointfront
{

/// A description and what only the file knows of it.
struct StoredDescription
{
  StoreDescription description;
  GridBounds gridBounds; ///< description.bounds is this in world coordinates
};

/// The description section's bytes. Path, version, sizes and counts are not in it: they stand in
/// header, footer and node table.
std::vector<std::byte> encodeDescription(const StoredDescription& stored);

/// What the bytes say, or nothing when they are not a description (texts that run over the end,
/// a scalar type or a refinement that does not exist, a scale of zero ...).
std::optional<StoredDescription> decodeDescription(const std::byte* data, std::size_t size);

} // namespace pointfront
