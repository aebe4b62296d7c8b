#pragma once

#include "pointfront/Points/PointSource.h"
#include "pointfront/Store/StoredCloud.h"

#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// Some points of files as a cloud of one node, held in the memory of this process.
/// `source`  says whose they are; it has a grid. Its bounds are made those of the points.
/// Errors    those of ForeignTree::make().
Result<std::shared_ptr<const StoredCloud>> cloudOfPoints(
  SourceDescription source, PointBatch points, std::vector<std::string> files);

/// A first look at a source of any family: the points of some chunks, evenly taken from all of it.
/// Points that have no finite place are left out.
/// Errors  those of reading; NotFound: no point was found.
Result<std::shared_ptr<const StoredCloud>> firstLookAt(std::unique_ptr<PointSource> source);

} // namespace pointfront
