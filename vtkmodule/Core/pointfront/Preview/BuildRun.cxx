#include "pointfront/Preview/BuildRun.h"

#include "pointfront/Export/OutputTarget.h"
#include "pointfront/Store/PreviewRecord.h"

#include <algorithm>
#include <chrono>
#include <filesystem>

namespace pointfront
{

Result<BuildReport> BuildRun::run(
  PointSources& sources, const AttributePasses& passes, const ProgressFunction& progress)
{
  const auto begin = std::chrono::steady_clock::now();
  if (Result<void> free = checkOutput(sources, passes); !free)
  {
    return free.error();
  }
  const auto preview = BuildPreview::create(sources, options_, preview_);
  if (!preview)
  {
    return preview.error();
  }
  if (options_.memoryBytes > 0)
  {
    options_.memoryBytes -= (*preview)->heldBytes();
  }
  Result<PointSources> prepared = apply(std::move(sources), passes, **preview, progress);
  if (!prepared)
  {
    return prepared.error();
  }
  sources = std::move(*prepared);
  tellFindings(passes);
  Result<BuildReport> report = (*preview)->build(sources, options_, progress);
  if (report)
  {
    tellFindings(passes); // some are known only when all points are read
    const auto end = std::chrono::steady_clock::now();
    report->seconds = std::chrono::duration<double>(end - begin).count(); // passes and overview too
  }
  return report;
}

/// Before the preview takes its place, and with what only the passes read.
Result<void> BuildRun::checkOutput(const PointSources& sources, const AttributePasses& passes) const
{
  std::vector<std::string> reads = pathsOf(sources);
  for (const std::unique_ptr<AttributePass>& pass : passes)
  {
    const std::vector<std::string> more = pass->filesRead();
    reads.insert(reads.end(), more.begin(), more.end());
  }
  if (Result<void> apart = checkApart(previewPathOf(options_.outputPath), reads);
      preview_.wanted && !apart)
  {
    return apart;
  }
  return checkOutputTarget({ options_.outputPath, FileKind::Store, options_.overwrite }, reads);
}

/// Shows an overview before the first pass that takes long; the build gets the memory that they
/// leave.
Result<PointSources> BuildRun::apply(PointSources sources, const AttributePasses& passes,
  BuildPreview& preview, const ProgressFunction& progress)
{
  PassResources resources;
  resources.memoryBytes = options_.memoryBytes;
  resources.threads = options_.threads;
  resources.temporaryFolder = options_.temporaryFolder.empty()
    ? std::filesystem::absolute(options_.outputPath).parent_path().string()
    : options_.temporaryFolder;
  resources.progress = progress;
  std::uint64_t held = 0;
  bool shown = false;
  for (const std::unique_ptr<AttributePass>& pass : passes)
  {
    if (pass->readsPoints() && !shown)
    {
      preview.showOverview(sources, progress);
      shown = true;
    }
    Result<PointSources> next = pass->apply(std::move(sources), resources);
    if (!next)
    {
      return next.error();
    }
    sources = std::move(*next);
    held += pass->heldBytes(resources);
  }
  if (options_.memoryBytes > 0) // a limit; without one the build asks the machine
  {
    options_.memoryBytes -= std::min(held, options_.memoryBytes - 1);
  }
  if (!shown)
  {
    preview.showOverview(sources, progress);
  }
  return sources;
}

void BuildRun::tellFindings(const AttributePasses& passes)
{
  for (const std::unique_ptr<AttributePass>& pass : passes)
  {
    for (const std::string& finding : pass->findings())
    {
      if (tell_ && told_.insert(finding).second)
      {
        tell_(finding);
      }
    }
  }
}

} // namespace pointfront
