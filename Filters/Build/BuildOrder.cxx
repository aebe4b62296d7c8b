#include "BuildOrder.h"

#include "ChosenPasses.h"
#include "InputFiles.h"
#include "SourceFormats.h"

namespace pointfront
{
namespace
{

Result<OpenedInputs> opened(const BuildOrder& order, std::vector<std::string>& findings)
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

Result<BuildReport> carryOut(const BuildOrder& order, const ProgressFunction& progress)
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
  BuildRun run(order.options, order.preview,
    [&findings](const std::string& finding) { findings.push_back(finding); });
  Result<BuildReport> built = run.run(inputs->sources, *passes, progress);
  if (built)
  {
    std::vector<InputFault>& skipped = built->inputsSkipped;
    skipped.insert(skipped.begin(), inputs->skipped.begin(), inputs->skipped.end());
    built->warnings.insert(built->warnings.end(), findings.begin(), findings.end());
  }
  return built;
}

} // namespace pointfront
