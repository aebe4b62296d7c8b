#include "IndexCommand.h"

#include "ByteSize.h"
#include "CancelSignal.h"
#include "ChosenPasses.h"
#include "InputFaults.h"
#include "InputFiles.h"
#include "KnownWords.h"
#include "PeakMemory.h"
#include "ProgressDisplay.h"
#include "Values.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>

namespace pointfront
{

namespace
{
double perSecond(const LASIndexReport& report)
{
  return report.seconds > 0.0 ? static_cast<double>(report.points) / report.seconds : 0.0;
}
/// Adds up the reports of several files.
void add(const LASIndexReport& report, LASIndexReport& all)
{
  all.points += report.points;
  all.nodes += report.nodes;
  all.runs += report.runs;
  all.bytesWritten += report.bytesWritten;
  all.spilledBytes += report.spilledBytes;
  all.seconds += report.seconds;
}

void printReport(const std::string& side, const LASIndexReport& report)
{
  std::printf("%s: %llu points in %llu nodes by %llu runs, %s, %.1f s (%.2f M points/s)\n",
    side.c_str(), static_cast<unsigned long long>(report.points),
    static_cast<unsigned long long>(report.nodes), static_cast<unsigned long long>(report.runs),
    byteSizeText(report.bytesWritten).c_str(), report.seconds, perSecond(report) * 1e-6);
}
} // namespace

void IndexCommand::declare(CLI::App& program)
{
  app_ = program.add_subcommand("index", "Make a LAS file drawable in place: a side file only");
  app_->add_option("inputs", inputs_, "LAS files, patterns, folders; they are not changed")
    ->required()
    ->type_name("IN.las...");
  app_
    ->add_option(
      "-o,--output", sidePath_, std::string("The side file (IN.las") + lasIndexSuffix + ")")
    ->type_name("SIDE");
  app_->add_option("--node-points", options_.leafPoints, "Most points of a leaf (16384)")
    ->transform(wholeNumber())
    ->check(CLI::Range(256u, 1u << 20))
    ->type_name("N");
  app_
    ->add_option("--normals", normals_,
      "Keep normals in the side file: from neighbours in the scan (scanline) or planes through "
      "neighbours (pca) (none: they are computed while nodes load)")
    ->check(knownWords({ "none", "scanline", "pca" }));
  neighboursOption_ = app_
                        ->add_option("--normals-k", normalsNeighbours_,
                          "Neighbours of a plane, with the point itself (16)")
                        ->check(CLI::Range(3u, 4096u))
                        ->type_name("N");
  addByteSize(*app_, "--memory", options_.memoryBytes,
    "Most memory for lists of runs, and for computing normals; beyond it they are spilled to disk "
    "(256M)");
  app_->add_option("--threads", options_.threads, "Threads (one a core)")
    ->check(CLI::Range(1u, 1024u))
    ->type_name("N");
  app_->add_option("--temp", options_.temporaryFolder, "Folder for spill files (the side file's)")
    ->check(CLI::ExistingDirectory)
    ->type_name("DIR");
  addOnError(*app_, onFault_);
  app_->add_flag("--force", options_.overwrite, "Replace an existing index");
  app_->add_option("--progress", progress_, "On stderr: auto, plain, json or none (auto)")
    ->check(knownWords({ "auto", "plain", "json", "none" }));
  app_->add_flag("--json", json_, "Print the report as one JSON object");
  app_->parse_complete_callback(
    [this]()
    {
      if (neighboursOption_->count() > 0 && normals_ != "pca")
      {
        throw CLI::ValidationError("--normals-k", "needs --normals pca");
      }
    });
}

Result<void> IndexCommand::chooseNormals()
{
  if (normals_ == "none")
  {
    return {};
  }
  const bool pca = normals_ == "pca";
  PassChoice choice;
  choice.normals = pca ? PassChoice::Normals::PCA : PassChoice::Normals::ScanLine;
  choice.normalsNeighbours = normalsNeighbours_;
  Result<AttributePasses> passes = chosenPasses(choice);
  if (!passes)
  {
    return passes.error();
  }
  options_.normals = std::move(passes->back());
  options_.normalsOrigin = pca
    ? "of planes through " + std::to_string(normalsNeighbours_) + " neighbours in the whole file"
    : "of triangles with scan-line neighbours";
  return {};
}

/// The family of files that are no point files is not asked for first: a LAS file may have
/// any name.
Result<std::vector<std::string>> IndexCommand::findFiles(std::vector<InputFault>& skipped) const
{
  const bool skip = onFault_ == OnFault::Skip;
  Result<InputFileList> files = findInputFiles(inputs_, { "las" }, {}, &skipped);
  if (!files)
  {
    return files.error();
  }
  if (!sidePath_.empty() && files->paths.size() > 1)
  {
    return makeError(Error::Kind::BadArgument,
      "-o names one side file, but there are " + std::to_string(files->paths.size()) +
        " inputs; leave it out");
  }
  std::vector<Error> faults;
  for (const InputFault& absent : skipped)
  {
    faults.push_back(errorOf(absent));
  }
  const std::size_t named = files->paths.size() + faults.size();
  std::vector<std::string> sound;
  for (const std::string& path : files->paths)
  {
    if (Result<void> can = checkIndexable(path); !can)
    {
      faults.push_back(can.error());
      skipped.push_back(inputFault(path, can.error()));
      continue;
    }
    sound.push_back(path);
  }
  if (!faults.empty() && (!skip || sound.empty()))
  {
    return faultyInputs(faults, named);
  }
  return sound;
}

Result<void> IndexCommand::run()
{
  const CancelSignal signal(CancelSignal::Mode::Finish);
  std::vector<InputFault> skipped;
  const Result<std::vector<std::string>> files = findFiles(skipped);
  if (!files)
  {
    return files.error();
  }
  if (Result<void> chosen = chooseNormals(); !chosen)
  {
    return chosen;
  }
  LASIndexReport all;
  std::size_t indexed = 0;
  for (const std::string& path : files.value())
  {
    const std::string side = sidePath_.empty() ? path + lasIndexSuffix : sidePath_;
    Result<LASIndexReport> report = makeError(Error::Kind::Cancelled, "cancelled");
    {
      ProgressDisplay display(*ProgressDisplay::styleOf(progress_));
      report = indexLASFile(path, side, options_, display.function());
    }
    if (!report)
    {
      if (onFault_ == OnFault::Stop || report.error().kind == Error::Kind::Cancelled)
      {
        return report.error();
      }
      skipped.push_back(inputFault(path, report.error()));
      continue;
    }
    for (const std::string& warning : report->warnings)
    {
      warn(name(), path + ": " + warning);
    }
    add(*report, all);
    ++indexed;
    if (!json_)
    {
      printReport(side, *report);
    }
  }
  if (json_)
  {
    const auto* const told = onFault_ == OnFault::Skip ? &skipped : nullptr;
    std::printf("%s\n", indexReportJson(all, told, peakResidentBytes()).c_str());
  }
  else if (!skipped.empty())
  {
    std::printf("%zu files indexed%s\n", indexed, skippedText(skipped).c_str());
  }
  return {};
}

std::string indexReportJson(
  const LASIndexReport& report, const std::vector<InputFault>* skipped, std::uint64_t peakBytes)
{
  nlohmann::ordered_json object;
  object["points_read"] = report.points;
  object["points_indexed"] = report.points;
  if (skipped != nullptr)
  {
    object["inputs_skipped"] = skippedJson(*skipped);
  }
  object["nodes"] = report.nodes;
  object["runs"] = report.runs;
  object["seconds"] = report.seconds;
  object["points_per_second"] = std::llround(perSecond(report));
  object["peak_rss_bytes"] = peakBytes;
  object["bytes_written"] = report.bytesWritten;
  object["spilled_bytes"] = report.spilledBytes;
  return object.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

} // namespace pointfront
