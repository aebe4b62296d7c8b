#include "ExportCommand.h"

#include "CancelSignal.h"
#include "COPCMemory.h"
#include "EpochOption.h"
#include "FarOptions.h"
#include "KnownWords.h"
#include "PeakMemory.h"
#include "ProgressDisplay.h"
#include "SinkFormats.h"
#include "Values.h"
#include "WholeFile.h"

#include "pointfront/Tiles/StoredCloudFormats.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace pointfront
{

void ExportCommand::declare(CLI::App& program)
{
  app_ = program.add_subcommand("export", "Write points of a store to a point file");
  app_->add_option("store", storePath_, "The store")->required()->type_name("STORE");
  declareEpoch(*app_, storePath_);
  app_->add_option("-o,--output", outputPath_, "The file to write")->check(sinkExtension());
  declareCOPC();
  arguments_.declare(*app_);
  app_
    ->add_option(
      "--crs", sinkChoice_.crs, "Transform into this coordinate reference system (the store's own)")
    ->type_name("EPSG:N|WKTFILE");
  app_->add_flag("--double", sinkChoice_.doubleCoordinates,
    "PCD: coordinates as float64, which PCL's readers of points do not take");
  app_->final_callback([this] { checkOptions(); });
  app_
    ->add_option("--color-depth", sinkChoice_.colourBits,
      "Bits of 16-bit colours to write: 8 or 16 (8 in PLY and PCD, else 16)")
    ->type_name("BITS")
    ->check(CLI::IsMember({ 8U, 16U }));
  app_->add_flag("--force", replace_, "Replace an existing file of the same kind");
  app_->add_option("--progress", progress_, "On stderr: auto, plain, json or none (auto)")
    ->check(knownWords({ "auto", "plain", "json", "none" }));
  app_->add_option("--stats", statisticsPath_, "Write what was done as JSON")
    ->type_name("FILE.json");
}

void ExportCommand::declareCOPC()
{
  app_->add_option("--copc", copcPath_, "The file to write, as COPC: as -o with that name")
    ->type_name("OUT.copc.laz")
    ->excludes("--output");
  addByteSize(*app_, "--memory", memoryBytes_,
    "COPC: most memory for points; beyond it they are spilled to disk (512M)");
  app_
    ->add_option(
      "--temp", sinkChoice_.temporaryFolder, "COPC: folder of temporary files (the output's own)")
    ->type_name("DIR")
    ->check(CLI::ExistingDirectory);
}

void ExportCommand::checkOptions()
{
  if (!copcPath_.empty() && !isCOPCName(copcPath_))
  {
    throw CLI::ValidationError("--copc", copcPath_ + ": the name of COPC ends in .copc.laz");
  }
  outputPath_ = copcPath_.empty() ? outputPath_ : copcPath_;
  if (outputPath_.empty())
  {
    throw CLI::RequiredError("--output");
  }
  const FileKind kind = sinkKind(outputPath_);
  if (sinkChoice_.doubleCoordinates && kind != FileKind::PCD)
  {
    throw CLI::ValidationError("--double",
      "is for PCD, whose coordinates are float32 without it; other formats keep every digit");
  }
  if (kind != FileKind::COPC && (memoryBytes_ != 0 || !sinkChoice_.temporaryFolder.empty()))
  {
    throw CLI::ValidationError(memoryBytes_ != 0 ? "--memory" : "--temp",
      "is for COPC, whose points are sorted; other formats are written as points come");
  }
  if (memoryBytes_ != 0)
  {
    sinkChoice_.memoryBytes = memoryBytes_;
  }
}

Result<void> ExportCommand::checkTarget(const StoredCloud& store) const
{
  std::vector<std::string> reads = store.files();
  reads.push_back(sinkChoice_.crs); // may be a file
  for (const std::string& file : arguments_.files())
  {
    reads.push_back(file);
  }
  if (Result<void> checked =
        checkOutputTarget({ outputPath_, sinkKind(outputPath_), replace_ }, reads);
      !checked || statisticsPath_.empty())
  {
    return checked;
  }
  reads.push_back(outputPath_);
  return checkOutputTarget({ statisticsPath_, FileKind::Statistics, true }, reads);
}

Result<void> ExportCommand::shareMemory(const StoredCloud& store, ExportSelection& selection)
{
  if (sinkKind(outputPath_) != FileKind::COPC)
  {
    return {};
  }
  const Result<std::size_t> least = leastExportBytes(store, selection);
  if (!least)
  {
    return least.error();
  }
  sinkChoice_.readBytes = *least;
  selection.memoryBytes = static_cast<std::size_t>(
    std::min<std::uint64_t>(selection.memoryBytes, COPCMemory::ofReading(sinkChoice_.memoryBytes)));
  return {};
}

Result<std::uint64_t> ExportCommand::write(
  const StoredCloud& store, const ExportSelection& selection)
{
  std::optional<ProgressDisplay> shown(std::in_place, *ProgressDisplay::styleOf(progress_));
  SinkChoice choice = sinkChoice_;
  choice.progress = shown->function();
  const Result<std::unique_ptr<PointSink>> made = makeSink(outputPath_, choice);
  if (!made)
  {
    return made.error();
  }
  PointSink& sink = **made;
  std::uint64_t written = 0;
  {
    const Result<ExportReport> report = exportStore(store, selection, sink, choice.progress);
    if (!report)
    {
      return report.error();
    }
    written = report->pointsWritten;
  }
  shown.reset(); // its line ends before warnings begin
  for (const std::string& finding : sink.findings())
  {
    warn(name(), outputPath_ + ": " + finding);
  }
  return written;
}

std::string ExportCommand::statistics(std::uint64_t points, double seconds) const
{
  nlohmann::ordered_json object;
  object["points_written"] = points;
  object["seconds"] = seconds;
  std::error_code failure;
  const std::uintmax_t bytes = std::filesystem::file_size(outputPath_, failure);
  object["bytes_written"] = failure ? 0 : bytes;
  object["peak_rss_bytes"] = peakResidentBytes();
  addTraffic(object);
  return object.dump(2) + "\n";
}

Result<void> ExportCommand::run()
{
  const auto begin = std::chrono::steady_clock::now();
  const CancelSignal signal(CancelSignal::Mode::Finish);
  Result<std::shared_ptr<const StoredCloud>> store =
    StoredCloudFormats::ofProcess().open(storePath_);
  if (!store)
  {
    return store.error();
  }
  const StoreDescription& description = (*store)->description();
  for (const std::string& warning : description.warnings)
  {
    warn(name(), storePath_ + ": " + warning);
  }
  if (Result<void> checked = checkTarget(**store); !checked)
  {
    return checked;
  }
  std::vector<std::string> notes;
  Result<PointQuery> query = arguments_.query(description, notes);
  if (!query)
  {
    return query.error();
  }
  for (const std::string& note : notes)
  {
    warn(name(), note);
  }
  ExportSelection selection{ std::move(*query), std::nullopt };
  if (Result<void> shared = shareMemory(**store, selection); !shared)
  {
    return shared;
  }
  const Result<std::uint64_t> points = write(**store, selection);
  if (!points)
  {
    return points.error();
  }
  if (*points == 0)
  {
    warn(name(), outputPath_ + ": no point of the store is selected; the file holds none");
  }
  std::printf("%s: %llu points\n", outputPath_.c_str(), static_cast<unsigned long long>(*points));
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  return statisticsPath_.empty()
    ? Result<void>()
    : writeWholeFile(statisticsPath_, statistics(*points, taken.count()));
}

} // namespace pointfront
