#pragma once

#include "pointfront/Store/StoredCloud.h"
#include "pointfront/Style/StyleSheet.h"

#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// A sentence for a style whose default is lit where no cloud has a normal to light; else empty.
std::string doubtOfLight(
  const StyleSheet& sheet, const std::vector<std::shared_ptr<const StoredCloud>>& clouds);

} // namespace pointfront
