#include "ExportCommand.h"

#include "CancelSignal.h"
#include "ProgressDisplay.h"
#include "SinkFormats.h"
#include "Unavailable.h"
#include "Values.h"

#include "pointfront/Store/StoredCloudFormats.h"

#include <cstdio>
#include <memory>

namespace pointfront
{

void ExportCommand::declare(CLI::App& program)
{
  app_ = program.add_subcommand("export", "Write points of a store to a point file");
  app_->add_option("store", storePath_, "The store")->required()->type_name("STORE");
  app_->add_option("-o,--output", outputPath_, "The file to write")
    ->required()
    ->check(sinkExtension());
  const auto box = [this](const CLI::results_t& words)
  {
    const auto numbers = parseNumbers<6>(words.back());
    if (!numbers || (*numbers)[0] > (*numbers)[3] || (*numbers)[1] > (*numbers)[4] ||
      (*numbers)[2] > (*numbers)[5])
    {
      throw CLI::ParseError("--box: '" + words.back() +
          "' is not a box: write x0,y0,z0,x1,y1,z1 with lower before upper corner", 2);
    }
    const auto& n = *numbers;
    selection_.box = Bounds{ { n[0], n[1], n[2] }, { n[3], n[4], n[5] } };
    return true;
  };
  app_->add_option("--box", box, "Only points inside or on this box")
    ->type_name("x0,y0,z0,x1,y1,z1")
    ->expected(1);
  const auto classes = [this](const CLI::results_t& words)
  {
    const auto codes = parseClasses(words.back());
    if (!codes)
    {
      throw CLI::ParseError(
        "--classes: '" + words.back() + "' is not a list of class codes: write 2,6", 2);
    }
    selection_.classes = *codes;
    return true;
  };
  app_->add_option("--classes", classes, "Only points of these classes")
    ->type_name("LIST")
    ->expected(1);
  app_->add_option("--spacing", selection_.spacing,
        "Thin out: levels until the points are at least this dense")
    ->check(positiveNumber())
    ->type_name("METRES");
  app_->add_option("--crs", sinkChoice_.crs,
        "Transform into this coordinate reference system (the store's own)")
    ->type_name("EPSG:N|WKTFILE");
  app_->add_flag("--double", sinkChoice_.doubleCoordinates,
    "PCD: coordinates as float64, which PCL's readers of points do not take");
  app_->add_flag("--force", replace_, "Replace an existing file of the same kind");
  app_->add_option("--progress", progress_, "On stderr: auto, plain, json or none (auto)")
    ->check(availableValues({ "auto", "plain", "json", "none" }, {}));
}

Result<void> ExportCommand::run()
{
  const CancelSignal signal(CancelSignal::Mode::Finish);
  Result<std::shared_ptr<const StoredCloud>> store =
    StoredCloudFormats::ofProcess().open(storePath_);
  if (!store)
  {
    return store.error();
  }
  std::vector<std::string> reads = (*store)->files();
  reads.push_back(sinkChoice_.crs); // may be a file
  Result<void> checked =
    checkOutputTarget({ outputPath_, sinkKind(outputPath_), replace_ }, reads);
  if (!checked)
  {
    return checked;
  }
  const std::unique_ptr<PointSink> sink = makeSink(outputPath_, sinkChoice_);
  ExportReport report;
  {
    ProgressDisplay display(*ProgressDisplay::styleOf(progress_));
    Result<ExportReport> exported = exportStore(**store, selection_, *sink, display.function());
    if (!exported)
    {
      return exported.error();
    }
    report = *exported;
  }
  for (const std::string& finding : sink->findings())
  {
    warn(name(), outputPath_ + ": " + finding);
  }
  if (report.pointsWritten == 0)
  {
    warn(name(), outputPath_ + ": no point of the store is selected; the file holds none");
  }
  std::printf("%s: %llu points\n", outputPath_.c_str(),
    static_cast<unsigned long long>(report.pointsWritten));
  return {};
}

} // namespace pointfront
