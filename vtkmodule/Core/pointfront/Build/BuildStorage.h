#pragma once

#include "pointfront/Build/StoreBuilder.h"
#include "pointfront/Disk/DiskEstimate.h"
#include "pointfront/Ingest/MemoryPlan.h"
#include "pointfront/Records/RecordPool.h"

#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// The memory and the disk of one build.
struct BuildStorage
{
  MemoryPlan plan;
  DiskEstimate disk;
  std::string diskWarning; ///< for the user, when the disk may be too small; or empty
  std::unique_ptr<RecordPool> pool; ///< for all points that the sources may give
};

/// Reserves memory and disk for records of `pooled`. Errors NoMemory, Unwritable, with the amount
/// that is needed.
Result<BuildStorage> reserveStorage(const std::vector<std::unique_ptr<PointSource>>& sources,
  const AttributeSchema& pooled, const BuildOptions& options);

} // namespace pointfront
