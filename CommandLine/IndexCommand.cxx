#include "IndexCommand.h"

#include "ByteSize.h"
#include "CancelSignal.h"
#include "PeakMemory.h"
#include "ProgressDisplay.h"
#include "Unavailable.h"
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
} // namespace

void IndexCommand::declare(CLI::App& program)
{
  app_ = program.add_subcommand("index", "Make a LAS file drawable in place: a side file only");
  app_->add_option("input", inputPath_, "The LAS file; it is not changed")
    ->required()
    ->type_name("IN.las");
  app_->add_option("-o,--output", sidePath_,
        std::string("The side file (IN.las") + lasIndexSuffix + ")")
    ->type_name("SIDE");
  app_->add_option("--node-points", options_.leafPoints, "Most points of a leaf (16384)")
    ->check(CLI::Range(256u, 1u << 20))
    ->type_name("N");
  addByteSize(*app_, "--memory", options_.memoryBytes,
    "Most memory for lists of runs; beyond it they are spilled to disk (256M)");
  app_->add_option("--threads", options_.threads, "Threads (one a core)")
    ->check(CLI::Range(1u, 1024u))
    ->type_name("N");
  app_->add_option("--temp", options_.temporaryFolder, "Folder for spill files (the side file's)")
    ->check(CLI::ExistingDirectory)
    ->type_name("DIR");
  app_->add_flag("--force", options_.overwrite, "Replace an existing index");
  app_->add_option("--progress", progress_, "On stderr: auto, plain, json or none (auto)")
    ->check(availableValues({ "auto", "plain", "json", "none" }, {}));
  app_->add_flag("--json", json_, "Print the report as one JSON object");
}

Result<void> IndexCommand::run()
{
  const CancelSignal signal(CancelSignal::Mode::Finish);
  const std::string side = sidePath_.empty() ? inputPath_ + lasIndexSuffix : sidePath_;
  LASIndexReport report;
  {
    ProgressDisplay display(*ProgressDisplay::styleOf(progress_));
    Result<LASIndexReport> indexed =
      indexLASFile(inputPath_, side, options_, display.function());
    if (!indexed)
    {
      return indexed.error();
    }
    report = std::move(*indexed);
  }
  for (const std::string& warning : report.warnings)
  {
    warn(name(), inputPath_ + ": " + warning);
  }
  if (json_)
  {
    std::printf("%s\n", indexReportJson(report, peakResidentBytes()).c_str());
    return {};
  }
  std::printf("%s: %llu points in %llu nodes by %llu runs, %s, %.1f s (%.2f M points/s)\n",
    side.c_str(), static_cast<unsigned long long>(report.points),
    static_cast<unsigned long long>(report.nodes), static_cast<unsigned long long>(report.runs),
    byteSizeText(report.bytesWritten).c_str(), report.seconds, perSecond(report) * 1e-6);
  return {};
}

std::string indexReportJson(const LASIndexReport& report, std::uint64_t peakBytes)
{
  nlohmann::ordered_json object;
  object["points_read"] = report.points;
  object["points_indexed"] = report.points;
  object["nodes"] = report.nodes;
  object["runs"] = report.runs;
  object["seconds"] = report.seconds;
  object["points_per_second"] = std::llround(perSecond(report));
  object["peak_rss_bytes"] = peakBytes;
  object["bytes_written"] = report.bytesWritten;
  object["spilled_bytes"] = report.spilledBytes;
  return object.dump(2);
}

} // namespace pointfront
