#pragma once

#include "pointfront/Build/BlockSorter.h"
#include "pointfront/Build/CommonSchema.h"
#include "pointfront/Build/TreeSpace.h"
#include "pointfront/Points/AttributePass.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace pointfront
{

/// The points of a sample as the records that they have in the pool once it is cut into parts:
/// positions relative to the root, colours of the sources marked in `widened` widened.
/// `sample`: one source for each that the build reads; what cannot be read of it is left out.
std::vector<std::byte> sampleRecords(const PointSources& sample, const CommonSchema& schema,
  const TreeSpace& space, const std::optional<ColourWidening>& widening,
  const std::vector<bool>& widened);

} // namespace pointfront
