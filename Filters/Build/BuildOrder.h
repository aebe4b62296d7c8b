#pragma once

#include "pointfront/Base/Bounds.h"
#include "pointfront/Base/Progress.h"
#include "pointfront/Points/AttributePass.h"
#include "pointfront/Points/PassChoice.h"
#include "pointfront/Preview/BuildRun.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// An order to build, as VTK's builder and Python give it: the inputs, the output and the options.
struct BuildOrder
{
  std::vector<std::string> files; ///< and patterns and folders, as the tool takes them
  std::function<Result<PointSources>()> made; ///< instead of files; called once
  BuildOptions options; ///< but for its box, which is made of the following one
  std::optional<Bounds> box; ///< only points inside or on it, in the inputs' coordinates
  PassChoice passes;
  PreviewOptions preview;
};

/// Opens the files, makes the passes, builds. What files and passes find is among the report's
/// warnings.
/// Threads  called from one thread; BuildRun runs its own.
Result<BuildReport> carryOut(const BuildOrder& order, const ProgressFunction& progress);

} // namespace pointfront
