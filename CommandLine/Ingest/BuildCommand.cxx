#include "BuildCommand.h"

#include "BoxOption.h"
#include "ByteSize.h"
#include "CancelSignal.h"
#include "InputFaults.h"
#include "InputFiles.h"
#include "InputLists.h"
#include "KnownWords.h"
#include "PeakMemory.h"
#include "ProgressDisplay.h"
#include "Values.h"

#include "pointfront/Query/InputBox.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

namespace pointfront
{

void BuildCommand::declare(CLI::App& program)
{
  app_ = program.add_subcommand("build", "Build a store from point files and stores");
  app_->add_option("inputs", inputs_, "Files, glob patterns, folders; any mix")->type_name("IN...");
  app_->add_option("-o,--output", options_.outputPath, "The store to write")
    ->required()
    ->type_name("OUT.pfront");
  app_->add_option("--structure", structure_, "Shape of the hierarchy (octree)")
    ->check(knownWords({ "octree", "kdtree" }));
  app_->add_option("--refinement", refinement_, "Inner nodes hold a subset, or mean points (add)")
    ->check(knownWords({ "add", "replace" }));
  app_
    ->add_option("--layers", layers_,
      "One tree for all points, or for each class (class if any point is classified)")
    ->check(knownWords({ "none", "class" }));
  app_->add_option("--node-points", options_.nodePoints, "Most points of a leaf (16384)")
    ->transform(wholeNumber())
    ->check(CLI::Range(256u, 1u << 20))
    ->type_name("N");
  app_
    ->add_option(
      "--precision", precision_, "Step of the stored coordinates (the inputs' own: lossless)")
    ->check(positiveNumber())
    ->type_name("METRES");
  app_->add_option("--attributes", attributes_, "Attributes to store: all, or names (all)")
    ->check(someWords("write all, or names as intensity,rgb"))
    ->type_name("all|LIST");
  addByteSize(*app_, "--memory", options_.memoryBytes,
    "Most memory for points; beyond it they are spilled to disk (half of the machine's)");
  app_->add_option("--threads", options_.threads, "Threads (one a core)")
    ->check(CLI::Range(1u, 1024u))
    ->type_name("N");
  app_->add_option("--temp", options_.temporaryFolder, "Folder for spill files (the output's)")
    ->check(CLI::ExistingDirectory)
    ->type_name("DIR");
  app_->add_flag("--force", options_.overwrite, "Replace an existing output");
  app_->add_option("--progress", progress_, "On stderr: auto, plain, json or none (auto)")
    ->check(knownWords({ "auto", "plain", "json", "none" }));
  app_
    ->add_option("--preview", preview_,
      "A small store beside the output, to look at while it is built: auto or none (auto)")
    ->check(knownWords({ "auto", "none" }));
  app_->add_flag("--json", json_, "Print the report as one JSON object");
  declareBox(*app_, "Only points inside or on this box, in the inputs' coordinates",
    [this](const Bounds& box) { box_ = box; });
  declareTiles();
  addOnError(*app_, options_.onFault, &options_.wholeInputs);
  sourceChoice_.declare(*app_);
  passes_.declare(*app_);
  app_->final_callback(
    [this]
    {
      const std::vector<std::string> more = passes_.inputsAmongImages(SourceFormats().extensions());
      inputs_.insert(inputs_.end(), more.begin(), more.end());
      if (inputs_.empty())
      {
        throw CLI::RequiredError("inputs");
      }
    });
}

Result<OpenedInputs> BuildCommand::openSources() const
{
  const SourceOptions options = sourceChoice_.options(options_);
  const SourceFormats formats(options);
  const auto holdsPoints = [&formats](const std::string& path)
  { return formats.mayHoldPoints(path); };
  std::vector<InputFault> absent;
  Result<ListedInputs> named = withoutLists(inputs_, options_.box.get());
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
  files->warnings.insert(files->warnings.end(), named->warnings.begin(), named->warnings.end());
  for (const std::string& warning : files->warnings)
  {
    warn(name(), warning);
  }
  Result<OpenedInputs> inputs =
    openInputs(files->paths, formats, options_.onFault, options.survey, absent);
  if (!inputs)
  {
    return inputs;
  }
  if (Result<void> fits = sourceChoice_.checkAgainst(inputs->sources); !fits)
  {
    return fits.error();
  }
  if (Result<void> some = options_.box ? options_.box->keepInside(inputs->sources) : Result<void>();
      !some)
  {
    return some.error();
  }
  for (const std::unique_ptr<PointSource>& source : inputs->sources)
  {
    const SourceDescription& description = source->description();
    for (const std::string& warning : description.warnings)
    {
      warn(name(), description.path + ": " + warning);
    }
  }
  return inputs;
}

void BuildCommand::warnOfBuild(const PointSources& sources, const BuildReport& report) const
{
  std::set<std::string> told;
  for (const std::unique_ptr<PointSource>& source : sources)
  {
    const std::vector<std::string>& warnings = source->description().warnings;
    told.insert(warnings.begin(), warnings.end());
  }
  for (const std::string& warning : report.warnings)
  {
    if (told.count(warning) == 0)
    {
      warn(name(), warning);
    }
  }
}

Result<BuildReport> BuildCommand::buildFrom(PointSources& sources, const AttributePasses& passes)
{
  ProgressDisplay display(*ProgressDisplay::styleOf(progress_));
  PreviewOptions preview;
  preview.wanted = preview_ != "none";
  BuildRun run(options_, preview, [this](const std::string& finding) { warn(name(), finding); });
  return run.run(sources, passes, display.function());
}

Result<void> BuildCommand::takeOptions()
{
  if (precision_ > 0.0)
  {
    options_.precision = precision_;
  }
  options_.colourDepth = sourceChoice_.colourDepth();
  options_.structure = structure_ == "kdtree" ? Structure::KdTree : Structure::Octree;
  options_.layering = layers_.empty() ? Layering::Automatic
    : layers_ == "class"              ? Layering::ObjectClass
                                      : Layering::None;
  options_.refinement = refinement_ == "replace" ? Refinement::Replace : Refinement::Add;
  if (attributes_ != "all")
  {
    options_.attributes = splitList(attributes_);
  }
  if (box_)
  {
    Result<std::shared_ptr<InputBox>> box = InputBox::make(*box_);
    if (!box)
    {
      return makeError(box.error().kind, "--box: " + box.error().what);
    }
    options_.box = std::move(*box);
  }
  return {};
}

Result<void> BuildCommand::run()
{
  const CancelSignal signal(CancelSignal::Mode::Finish);
  if (Result<void> right = takeOptions(); !right)
  {
    return right;
  }
  if (tiles_)
  {
    return buildTiles();
  }
  Result<OpenedInputs> inputs = openSources();
  if (!inputs)
  {
    return inputs.error();
  }
  PointSources& sources = inputs->sources;
  const Result<AttributePasses> passes = passes_.passes();
  if (!passes)
  {
    return passes.error();
  }
  Result<BuildReport> built = buildFrom(sources, *passes);
  if (!built)
  {
    return built.error();
  }
  BuildReport* report = &built.value();
  report->inputsSkipped.insert(
    report->inputsSkipped.begin(), inputs->skipped.begin(), inputs->skipped.end());
  warnOfBuild(sources, *report);
  tell(*report);
  return {};
}

void BuildCommand::tell(const BuildReport& report) const
{
  if (json_)
  {
    const bool skips = options_.onFault == OnFault::Skip;
    const std::string text = buildReportJson(report, peakResidentBytes(), skips, box_.has_value());
    std::printf("%s\n", text.c_str());
    return;
  }
  const std::string rejected = rejectionText(report);
  const std::string leftOut = (rejected.empty() ? "" : "; left out: " + rejected) +
    (report.pointsOutside > 0 ? "; outside of the box: " + std::to_string(report.pointsOutside)
                              : "") +
    skippedText(report.inputsSkipped);
  std::printf("%s: %llu points in %llu nodes, %s, %.1f s (%.2f M points/s)%s\n",
    options_.outputPath.c_str(), static_cast<unsigned long long>(report.pointsStored),
    static_cast<unsigned long long>(report.nodes), byteSizeText(report.bytesWritten).c_str(),
    report.seconds,
    report.seconds > 0.0 ? static_cast<double>(report.pointsStored) / report.seconds * 1e-6 : 0.0,
    leftOut.c_str());
}

std::string buildReportJson(
  const BuildReport& report, std::uint64_t peakBytes, bool skips, bool boxed)
{
  nlohmann::ordered_json object;
  object["points_read"] = report.pointsRead;
  object["points_stored"] = report.pointsStored;
  object["points_rejected"] = nlohmann::ordered_json::object();
  for (const auto& [reason, count] : report.pointsRejected)
  {
    object["points_rejected"][reason] = count;
  }
  if (boxed)
  {
    object["points_outside"] = report.pointsOutside;
  }
  if (skips)
  {
    object["inputs_skipped"] = skippedJson(report.inputsSkipped);
  }
  object["seconds"] = report.seconds;
  object["points_per_second"] = report.seconds > 0.0
    ? std::llround(static_cast<double>(report.pointsStored) / report.seconds)
    : 0;
  object["peak_rss_bytes"] = peakBytes;
  object["bytes_written"] = report.bytesWritten;
  object["spilled_bytes"] = report.spilledBytes;
  object["cpu_seconds"] = report.phaseSeconds;
  object["cpu_seconds"]["total"] = report.cpuSeconds;
  return object.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

} // namespace pointfront
