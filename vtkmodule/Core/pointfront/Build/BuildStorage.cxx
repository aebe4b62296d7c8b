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

BuildSize buildSizeOf(
  const Sources& sources, const AttributeSchema& pooled, const BuildOptions& options)
{
  BuildSize size;
  for (const auto& source : sources)
  {
    for (std::uint64_t chunk = 0; chunk < source->chunkCount(); ++chunk)
    {
      size.points += source->chunkPoints(chunk);
      size.largestChunk = std::max(size.largestChunk, source->chunkPoints(chunk));
    }
    size.sourceBytes = std::max(size.sourceBytes, source->description().schema.pointBytes());
  }
  size.recordBytes = RecordLayout(pooled).bytes();
  size.partBytes = constructionBytes(options, pooled);
  size.blockBytes = constructionBlockBytes(options);
  size.tableBytes = constructionTableBytes(options, size.points);
  size.wholePart = constructionPart(options);
  size.nodePoints = options.nodePoints;
  size.threads = threadsOr(options.threads);
  size.memoryBytes = options.memoryBytes > 0 ? options.memoryBytes : machineMemory() / 2;
  return size;
}
} // namespace

Result<BuildStorage> reserveStorage(
  const Sources& sources, const AttributeSchema& pooled, const BuildOptions& options)
{
  const BuildSize size = buildSizeOf(sources, pooled, options);
  const auto plan = planMemory(size);
  if (!plan)
  {
    return plan.error();
  }
  BuildStorage storage;
  storage.plan = *plan;
  DiskEstimate& disk = storage.disk;
  disk.outputFolder = folderOf(options.outputPath);
  estimateStore(disk, size.points, size.recordBytes);
  disk.spillFolder = options.temporaryFolder.empty() ? disk.outputFolder : options.temporaryFolder;
  disk.spillBytes = plan->spill ? size.points * size.recordBytes : 0;
  if (Result<void> enough = checkDiskSpace(disk); !enough)
  {
    return enough.error();
  }
  storage.diskWarning = diskSpaceWarning(disk);
  if (!plan->spill)
  {
    storage.pool = RecordPool::inMemory(size.points, size.recordBytes);
    return storage;
  }
  auto spilled = RecordPool::spilled(disk.spillFolder, size.points, size.recordBytes);
  if (!spilled)
  {
    return spilled.error();
  }
  storage.pool = std::move(*spilled);
  return storage;
}

} // namespace pointfront
