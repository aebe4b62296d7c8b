#include "BuildOrder.h"

#include "ChosenPasses.h"
#include "InputFiles.h"
#include "InputLists.h"
#include "SourceFormats.h"

#include "pointfront/Query/InputBox.h"

namespace pointfront
{
namespace
{

Result<OpenedInputs> opened(const BuildOrder& order, std::vector<std::string>& findings)
{
  SourceOptions sourceOptions;
  sourceOptions.box = order.options.box;
  const SourceFormats formats(sourceOptions);
  const auto holdsPoints = [&formats](const std::string& path)
  { return formats.mayHoldPoints(path); };
  std::vector<InputFault> absent;
  Result<ListedInputs> named = withoutLists(order.files, order.options.box.get());
  if (!named)
  {
    return named.error();
  }
  Result<InputFileList> files = findInputFiles(
    named->files, formats.extensions(), holdsPoints, &absent, SourceFormats::isStore);
  if (!files)
  {
    return files.error();
  }
  findings = std::move(named->warnings);
  findings.insert(findings.end(), files->warnings.begin(), files->warnings.end());
  return openInputs(files->paths, formats, order.options.onFault, {}, absent);
}

Result<OpenedInputs> made(const BuildOrder& order)
{
  Result<PointSources> sources = order.made();
  if (!sources)
  {
    return sources.error();
  }
  for (std::unique_ptr<PointSource>& source : *sources)
  {
    source = order.options.box ? order.options.box->cut(std::move(source)) : std::move(source);
  }
  return OpenedInputs{ std::move(*sources), {} };
}

} // namespace

Result<BuildReport> carryOut(const BuildOrder& request, const ProgressFunction& progress)
{
  BuildOrder order = request;
  if (order.box)
  {
    Result<std::shared_ptr<InputBox>> box = InputBox::make(*order.box);
    if (!box)
    {
      return box.error();
    }
    order.options.box = std::move(*box);
  }
  const Result<AttributePasses> passes = chosenPasses(order.passes);
  if (!passes)
  {
    return passes.error();
  }
  std::vector<std::string> findings;
  Result<OpenedInputs> inputs = order.made ? made(order) : opened(order, findings);
  if (!inputs)
  {
    return inputs.error();
  }
  if (const auto& box = order.options.box)
  {
    if (Result<void> some = box->keepInside(inputs->sources); !some)
    {
      return some.error();
    }
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
