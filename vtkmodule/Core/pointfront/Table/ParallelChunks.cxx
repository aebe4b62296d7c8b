#include "pointfront/Table/ParallelChunks.h"

#include "pointfront/Threads/ThreadCrew.h"
#include "pointfront/Threads/WorkerThread.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <new>
#include <optional>

namespace pointfront
{
namespace
{
Result<void> guarded(const std::function<Result<void>(std::uint64_t)>& work, std::uint64_t chunk)
{
  try
  {
    return work(chunk);
  }
  catch (const std::bad_alloc&)
  {
    return makeError(Error::Kind::NoMemory, "not enough memory to look through the file");
  }
}
} // namespace

Result<void> forEachChunk(std::uint64_t count, const SurveyOptions& options,
  const std::function<Result<void>(std::uint64_t)>& work)
{
  std::atomic<bool> stop{ false };
  std::mutex mutex; // guards `error`
  std::optional<Error> error;
  ThreadCrew crew(
    static_cast<unsigned>(std::min<std::uint64_t>(threadsOr(options.threads), count)));
  crew.run(count,
    [&](std::size_t chunk, unsigned)
    {
      if (stop)
      {
        return;
      }
      const bool cancelled = options.cancelled && options.cancelled();
      const Result<void> done = cancelled
        ? Result<void>(makeError(Error::Kind::Cancelled, "cancelled"))
        : guarded(work, chunk);
      if (!done)
      {
        const std::lock_guard<std::mutex> lock(mutex);
        error = error ? error : done.error();
        stop = true;
      }
    });
  return error ? Result<void>(*error) : Result<void>();
}

} // namespace pointfront
