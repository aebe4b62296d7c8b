#include "pointfront/Statistics/BatchScan.h"

#include "pointfront/Threads/ThreadCrew.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>
#include <vector>

namespace pointfront
{
namespace
{
/// Threads whose batches fit into the memory.
unsigned mostThreads(const PointSource& source, const ScanOptions& options)
{
  std::uint64_t largest = 1;
  for (std::uint64_t chunk = 0; chunk < source.chunkCount(); ++chunk)
  {
    largest = std::max(largest, source.chunkPoints(chunk));
  }
  // A reader has the values once more: as doubles, or as they lie in the file.
  const std::size_t point = 3 * (sizeof(glm::dvec3) + source.description().schema.pointBytes());
  const std::uint64_t fit = options.memoryBytes / point / largest;
  return static_cast<unsigned>(std::clamp<std::uint64_t>(fit, 1, crewOf(options).threads()));
}
} // namespace

ThreadCrew& crewOf(const ScanOptions& options)
{
  return options.crew != nullptr ? *options.crew : ThreadCrew::ofProcess();
}

Result<void> scanBatches(const PointSource& source, const ScanOptions& options,
  const std::function<void(const PointBatch& batch, unsigned thread)>& work)
{
  const auto chunks = static_cast<std::size_t>(source.chunkCount());
  std::vector<PointBatch> batches(crewOf(options).threads());
  std::atomic<std::size_t> broken{ chunks }; // the first chunk that cannot be read
  std::mutex mutex; // guards `error`
  std::optional<Error> error;
  const auto piece = [&](std::size_t chunk, unsigned thread)
  {
    if (chunk > broken)
    {
      return; // chunks before it are with other threads: theirs may be the first error
    }
    PointBatch& batch = batches[thread];
    if (Result<void> read = source.read(chunk, batch); !read)
    {
      const std::lock_guard<std::mutex> lock(mutex);
      if (chunk < broken)
      {
        broken = chunk;
        error = read.error();
      }
      return;
    }
    work(batch, thread);
  };
  crewOf(options).run(chunks, piece, mostThreads(source, options));
  return error ? Result<void>(*error) : Result<void>();
}

} // namespace pointfront
