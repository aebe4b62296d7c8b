#pragma once

#include "pointfront/Base/Progress.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Build/StoreBuilder.h"
#include "pointfront/Points/AttributePass.h"
#include "pointfront/Preview/BuildPreview.h"

#include <functional>
#include <set>
#include <string>

namespace pointfront
{

/// From opened inputs to a store: passes, preview and build, one after another, within one limit of
/// memory.
/// Threads  called from one thread; runs its own.
class BuildRun
{
public:
  /// `tell` gets what the passes find, each sentence once, as early as it is known.
  BuildRun(
    BuildOptions options, PreviewOptions preview, std::function<void(const std::string&)> tell = {})
    : options_(std::move(options))
    , preview_(std::move(preview))
    , tell_(std::move(tell))
  {
  }

  /// `sources` becomes what the passes made of them. The report's seconds are those of all.
  /// Errors  of checkOutputTarget(), with the files of the passes too; those of the passes, of
  ///         PreviewFile::claim() and of buildStore().
  Result<BuildReport> run(
    PointSources& sources, const AttributePasses& passes, const ProgressFunction& progress = {});

private:
  Result<void> checkOutput(const PointSources& sources, const AttributePasses& passes) const;
  Result<PointSources> apply(PointSources sources, const AttributePasses& passes,
    BuildPreview& preview, const ProgressFunction& progress);
  void tellFindings(const AttributePasses& passes);

  BuildOptions options_; // the memory that is left, as it goes on
  PreviewOptions preview_;
  std::function<void(const std::string&)> tell_;
  std::set<std::string> told_;
};

} // namespace pointfront
