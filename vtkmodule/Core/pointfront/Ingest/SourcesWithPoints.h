#pragma once

#include "pointfront/Points/PointSource.h"

#include <memory>
#include <vector>

namespace pointfront
{

std::vector<PointSource*> allSources(const std::vector<std::unique_ptr<PointSource>>& sources);

/// The sources that have points, in their order; all of them if none has any. The header of an
/// empty file must not choose grid or attributes for the points of others.
std::vector<PointSource*> sourcesWithPoints(
  const std::vector<std::unique_ptr<PointSource>>& sources);

} // namespace pointfront
