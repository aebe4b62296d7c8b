#include "pointfront/Build/BuildStorage.h"

#include "pointfront/Build/TreeConstruction.h"
#include "pointfront/Records/RecordLayout.h"
#include "pointfront/Threads/WorkerThread.h"

#include <algorithm>
#include <filesystem>
#include <unistd.h>

namespace pointfront
{
namespace
{
using Sources = std::vector<std::unique_ptr<PointSource>>;

std::uint64_t machineMemory()
{
  return std::uint64_t(sysconf(_SC_PHYS_PAGES)) * std::uint64_t(sysconf(_SC_PAGESIZE));
}

std::string folderOf(const std::string& path)
{
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

BuildSize demandOf(
  const Sources& sources, const AttributeSchema& pooled, const BuildOptions& options)
{
  BuildSize demand;
  for (const auto& source : sources)
  {
    for (std::uint64_t chunk = 0; chunk < source->chunkCount(); ++chunk)
    {
      demand.points += source->chunkPoints(chunk);
      demand.largestChunk = std::max(demand.largestChunk, source->chunkPoints(chunk));
    }
    demand.sourceBytes = std::max(demand.sourceBytes, source->description().schema.pointBytes());
  }
  demand.recordBytes = RecordLayout(pooled).bytes();
  demand.partBytes = constructionBytes(options, pooled);
  demand.blockBytes = constructionBlockBytes(options);
  demand.tableBytes = constructionTableBytes(options, demand.points);
  demand.wholePart = constructionPart(options);
  demand.nodePoints = options.nodePoints;
  demand.threads = threadsOr(options.threads);
  demand.memoryBytes = options.memoryBytes > 0 ? options.memoryBytes : machineMemory() / 2;
  return demand;
}
} // namespace

Result<BuildStorage> reserveStorage(
  const Sources& sources, const AttributeSchema& pooled, const BuildOptions& options)
{
  const BuildSize demand = demandOf(sources, pooled, options);
  const auto plan = planMemory(demand);
  if (!plan)
  {
    return plan.error();
  }
  BuildStorage storage;
  storage.plan = *plan;
  DiskEstimate& disk = storage.disk;
  disk.outputFolder = folderOf(options.outputPath);
  estimateStore(disk, demand.points, demand.recordBytes);
  disk.spillFolder = options.temporaryFolder.empty() ? disk.outputFolder : options.temporaryFolder;
  disk.spillBytes = plan->spill ? demand.points * demand.recordBytes : 0;
  if (Result<void> enough = checkDiskSpace(disk); !enough)
  {
    return enough.error();
  }
  storage.diskWarning = diskSpaceWarning(disk);
  if (!plan->spill)
  {
    storage.pool = RecordPool::inMemory(demand.points, demand.recordBytes);
    return storage;
  }
  auto spilled = RecordPool::spilled(disk.spillFolder, demand.points, demand.recordBytes);
  if (!spilled)
  {
    return spilled.error();
  }
  storage.pool = std::move(*spilled);
  return storage;
}

} // namespace pointfront
