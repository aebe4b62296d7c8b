#include "BuildThread.h"

#include "pointfront/Points/PointFileOpener.h"

#include <chrono>
#include <new>
#include <thread>

namespace pointfront
{

namespace
{
Result<OpenedInputs> openFiles(const std::vector<std::string>& files, OnFault onFault)
{
  const auto opener = PointFileOpener::ofProcess();
  if (!opener)
  {
    return makeError(Error::Kind::Unsupported,
      "this program carries no readers of point files; link PointFront::SourceFormats");
  }
  return openInputs(files, *opener, onFault);
}
} // namespace

bool BuildThread::report(const Progress& progress)
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    news_.progress = progress;
  }
  changed_.notify_one();
  return !cancelled_;
}

Result<BuildReport> BuildThread::build(const Order& order)
{
  const auto maker = AttributePassMaker::ofProcess();
  if (!maker)
  {
    return makeError(Error::Kind::Unsupported,
      "this program carries no attribute passes; link PointFront::AttributePasses");
  }
  const Result<AttributePasses> passes = maker->passes(order.passes);
  if (!passes)
  {
    return passes.error();
  }
  Result<OpenedInputs> inputs =
    order.made ? OpenedInputs{ order.made(), {} } : openFiles(order.files, order.options.onFault);
  if (!inputs)
  {
    return inputs.error();
  }
  PreviewOptions preview = order.preview;
  preview.shown = [this](const std::string&)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    news_.preview = true;
  };
  std::vector<std::string> findings;
  BuildRun run(order.options, preview,
    [&findings](const std::string& finding) { findings.push_back(finding); });
  Result<BuildReport> built =
    run.run(inputs->sources, *passes, [this](const Progress& state) { return report(state); });
  if (built)
  {
    std::vector<InputFault>& skipped = built->inputsSkipped;
    skipped.insert(skipped.begin(), inputs->skipped.begin(), inputs->skipped.end());
    built->warnings.insert(built->warnings.end(), findings.begin(), findings.end());
  }
  return built;
}

Result<BuildReport> BuildThread::run(const Order& order, const Watch& watch)
{
  std::thread worker(
    [&]
    {
      Result<BuildReport> done = makeError(Error::Kind::NoMemory,
        "the system gave no more memory to the build; use a lower memory limit");
      try
      {
        done = build(order);
      }
      catch (const std::bad_alloc&)
      {
      }
      const std::lock_guard<std::mutex> lock(mutex_);
      outcome_ = std::move(done);
      changed_.notify_one();
    });
  constexpr std::chrono::milliseconds betweenLooks{ 100 }; // an abort is seen without news too
  std::unique_lock<std::mutex> lock(mutex_);
  while (!outcome_)
  {
    changed_.wait_for(lock, betweenLooks);
    const News last = news_;
    news_.preview = false;
    lock.unlock();
    if (!cancelled_ && !watch(last))
    {
      cancelled_ = true;
    }
    lock.lock();
  }
  lock.unlock();
  worker.join();
  return std::move(*outcome_);
}

} // namespace pointfront
