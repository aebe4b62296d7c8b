#pragma once

#include "pointfront/Neighbourhood/PointTiles.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace pointfront
{

/// The classes that get normals: those asked for, or all. Error BadArgument when some are asked for
/// and no source is classified.
Result<ClassSet> chosenClasses(
  const PointSources& sources, const std::optional<std::vector<std::uint8_t>>& wanted);

} // namespace pointfront
