#include "BuildThread.h"

#include "ChosenPasses.h"
#include "InputFiles.h"
#include "SourceFormats.h"

#include "pointfront/Threads/WorkerThread.h"

#include <chrono>
#include <new>
#include <utility>

namespace pointfront
{

bool BuildThread::report(const Progress& progress)
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    news_.progress = progress;
  }
  changed_.notify_one();
  return !cancelled_;
}

namespace
{
/// Of files, patterns and folders, as the tool takes them.
Result<OpenedInputs> opened(const BuildThread::Order& order, std::vector<std::string>& findings)
{
  const SourceFormats formats;
  const auto holdsPoints = [&formats](const std::string& path)
  { return formats.mayHoldPoints(path); };
  std::vector<InputFault> absent;
  Result<InputFileList> files =
    findInputFiles(order.files, formats.extensions(), holdsPoints, &absent, SourceFormats::isStore);
  if (!files)
  {
    return files.error();
  }
  findings = std::move(files->warnings);
  return openInputs(files->paths, formats, order.options.onFault, {}, absent);
}
} // namespace

Result<BuildReport> BuildThread::build(const Order& order)
{
  const Result<AttributePasses> passes = chosenPasses(order.passes);
  if (!passes)
  {
    return passes.error();
  }
  std::vector<std::string> findings;
  Result<OpenedInputs> inputs =
    order.made ? OpenedInputs{ order.made(), {} } : opened(order, findings);
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
  const auto work = [&]
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
  };
  WorkerThread worker;
  if (!worker.start(work))
  {
    work(); // the system gives no thread: nobody watches
  }
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
