#include "pointfront/Table/ParallelChunks.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <new>
#include <optional>
#include <thread>
#include <vector>

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
  std::atomic<std::uint64_t> next{ 0 };
  std::atomic<bool> stop{ false };
  std::mutex mutex; // guards `error`
  std::optional<Error> error;
  const auto run = [&]
  {
    for (std::uint64_t chunk = next++; chunk < count && !stop; chunk = next++)
    {
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
    }
  };
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  const std::uint64_t threads =
    std::min<std::uint64_t>(options.threads > 0 ? options.threads : cores, count);
  std::vector<std::thread> crew;
  for (std::uint64_t t = 1; t < threads; ++t)
  {
    crew.emplace_back(run);
  }
  run();
  for (std::thread& thread : crew)
  {
    thread.join();
  }
  return error ? Result<void>(*error) : Result<void>();
}

} // namespace pointfront
