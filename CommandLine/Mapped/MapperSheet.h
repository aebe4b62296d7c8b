#pragma once

#include "StoreScene.h"

#include "pointfront/Store/StoredCloud.h"
#include "pointfront/Style/StyleSheet.h"

#include <memory>
#include <vector>

namespace pointfront
{

/// Whether nothing is asked for that a mapper's own properties cannot say.
bool isPlain(const DrawingOptions& options);

/// One sheet for the mappers of all stores; the first store decides what is not said.
std::shared_ptr<const StyleSheet> sheetOf(
  const DrawingOptions& options, const std::vector<std::shared_ptr<const StoredCloud>>& stores);

} // namespace pointfront
