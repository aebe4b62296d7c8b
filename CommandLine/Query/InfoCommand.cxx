#include "InfoCommand.h"

#include "CancelSignal.h"
#include "EpochOption.h"
#include "FarOptions.h"
#include "InputFiles.h"
#include "SourceFormats.h"
#include "SourceInfo.h"
#include "StatisticsReport.h"
#include "StoreInfo.h"
#include "Values.h"

#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Disk/Epoch.h"
#include "pointfront/Query/StoredPoints.h"
#include "pointfront/Tiles/StoredCloudFormats.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>

namespace pointfront
{

namespace
{
/// Says why it does not open as a store even if nothing in it looks like one.
bool namedLikeStore(const std::string& path)
{
  const std::string extension = std::filesystem::path(path).extension().string();
  return extension == ".pfront" || extension == ".pfindex" || extension == ".pfronts" ||
    extension == ".pfcollection" || extension == ".vpc";
}

/// The hierarchy of a point file that has one: COPC, EPT.
struct SourceTree
{
  std::string structure;
  std::uint32_t nodes = 0;
  std::uint32_t levels = 0;
  std::string text;
  std::string fault; ///< why it cannot be used
};

std::optional<SourceTree> treeOf(const std::string& path)
{
  const StoredCloudFormats& formats = StoredCloudFormats::ofProcess();
  if (!formats.accepts(path))
  {
    return std::nullopt;
  }
  SourceTree tree;
  const auto cloud = formats.openWhole(path); // a file here, whose points are looked at, too
  if (!cloud)
  {
    tree.fault = cloud.error().what;
    return tree;
  }
  const StoreDescription& description = (*cloud)->description();
  tree.structure = description.structure;
  tree.nodes = (*cloud)->hierarchy()->nodeCount();
  tree.levels = description.levels;
  tree.text = "\n  hierarchy   " + tree.structure + ", " + std::to_string(tree.nodes) +
    " nodes in " + std::to_string(tree.levels) + " levels";
  return tree;
}

void print(const std::string& text)
{
  std::printf("%s\n", text.c_str());
}

/// The faults of some of several inputs; the others were told.
Error faultsOf(const std::vector<Error>& faults, std::size_t inputs)
{
  if (inputs == 1)
  {
    return faults.front();
  }
  std::string what =
    std::to_string(faults.size()) + " of " + std::to_string(inputs) + " inputs cannot be read";
  const char* before = ": ";
  for (const Error& fault : faults)
  {
    what += before + fault.what;
    before = "; ";
  }
  return makeError(faults.front().kind, what);
}
} // namespace

void InfoCommand::declare(CLI::App& program)
{
  app_ = program.add_subcommand("info", "Describe stores and point files");
  app_->add_option("inputs", inputs_, "Stores, point files, glob patterns, folders")
    ->required()
    ->type_name("FILE...");
  declareEpoch(*app_, inputs_);
  app_->add_flag("--json", json_, "Print one JSON object");
  app_->add_flag("--together", together_,
    "Describe what a folder or a list of stores holds as one cloud, not file by file");
  CLI::Option* const statistics = app_->add_flag("--stats", statistics_,
    "Read all points: ranges, means and histograms of attributes and classes, density");
  app_->add_option("--bins", options_.bins, "Bins of a histogram (32)")
    ->check(CLI::Range(1u, 4096u))
    ->needs(statistics)
    ->type_name("N");
  addByteSize(*app_, "--memory", memoryBytes_, "--stats: most memory for points read (256M)")
    ->needs(statistics);
}

Result<void> InfoCommand::run()
{
  const CancelSignal signal(CancelSignal::Mode::Leave);
  options_.scan.memoryBytes = static_cast<std::size_t>(memoryBytes_);
  const SourceFormats formats;
  std::vector<std::string> extensions = formats.extensions();
  extensions.insert(extensions.end(), { "pfront", "pfindex", "pfcollection" });
  const auto holdsPoints = [&formats](const std::string& path)
  { return formats.mayHoldPoints(path); };
  std::vector<Error> faults;
  std::size_t inputs = 0;
  auto reports = nlohmann::ordered_json::array();
  for (const std::string& input : inputs_) // in the order of the arguments
  {
    if (together_ || EpochAddress::of(input).epoch)
    {
      ++inputs;
      if (Result<void> told = tellStore(input, reports); !told)
      {
        faults.push_back(told.error());
      }
      continue;
    }
    const Result<InputFileList> files = findInputFiles({ input }, extensions, holdsPoints);
    if (!files)
    {
      ++inputs;
      faults.push_back(files.error());
      continue;
    }
    for (const std::string& path : files->paths)
    {
      ++inputs;
      if (Result<void> told = tell(path, formats, reports); !told)
      {
        faults.push_back(told.error());
      }
    }
  }
  const bool several = inputs > 1 && estimates_.inputs() > 1;
  if (!json_ && several)
  {
    print(std::to_string(estimates_.inputs()) + " inputs as one" + estimates_.text());
  }
  if (json_ && !reports.empty())
  {
    nlohmann::ordered_json object =
      inputs == 1 ? reports[0] : nlohmann::ordered_json{ { "files", reports } };
    if (several)
    {
      object["estimate"] = estimates_.json();
    }
    // A name from a file need not be UTF-8: what is not becomes the replacement character.
    print(object.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  }
  return faults.empty() ? Result<void>() : faultsOf(faults, inputs);
}

StoreEstimate InfoCommand::estimate(const EstimatedInput& input)
{
  estimates_.add(input);
  StoreEstimate own;
  own.add(input);
  return own;
}

Result<void> InfoCommand::tell(
  const std::string& path, const PointFileOpener& opener, nlohmann::ordered_json& reports)
{
  const bool store = isAddress(path) || SourceFormats::isStore(path) || namedLikeStore(path);
  return store ? tellStore(path, reports) : tellSource(path, opener, reports);
}

Result<void> InfoCommand::tellStore(const std::string& path, nlohmann::ordered_json& reports)
{
  const TrafficCounts before = ByteTraffic::ofProcess().counts();
  Result<std::shared_ptr<const StoredCloud>> store = StoredCloudFormats::ofProcess().open(path);
  if (!store)
  {
    return store.error();
  }
  const StoreDescription& description = (*store)->description();
  const Hierarchy& hierarchy = *(*store)->hierarchy();
  std::optional<PointStatistics> statistics;
  if (statistics_)
  {
    const Result<std::unique_ptr<PointSource>> points = StoredPoints::open(*store);
    if (!points)
    {
      return points.error();
    }
    Result<PointStatistics> gathered = gatherStatistics(**points, options_);
    if (!gathered)
    {
      return gathered.error();
    }
    statistics = std::move(*gathered);
  }
  for (const std::string& warning : description.warnings)
  {
    warn(name(), path + ": " + warning);
  }
  const TrafficCounts traffic = ByteTraffic::ofProcess().counts().since(before);
  const bool far = traffic.any() || isAddress(path);
  const std::optional<StoreEstimate> built = description.version == 0
    ? std::optional<StoreEstimate>(estimate(EstimatedInput::of(description)))
    : std::nullopt;
  if (!json_)
  {
    print(storeText(description, hierarchy) + (built ? built->text() : "") +
      (far ? trafficText(traffic) : "") + (statistics ? statisticsText(*statistics) : ""));
    return {};
  }
  reports.push_back(storeJson(description, hierarchy));
  reports.back()["path"] = path;
  if (built)
  {
    reports.back()["estimate"] = built->json();
  }
  if (far)
  {
    addTraffic(reports.back()["traffic"], traffic);
  }
  if (statistics)
  {
    reports.back()["stats"] = statisticsJson(*statistics);
  }
  return {};
}

Result<void> InfoCommand::tellSource(
  const std::string& path, const PointFileOpener& opener, nlohmann::ordered_json& reports)
{
  Result<std::unique_ptr<PointSource>> source = opener.open(path);
  if (!source)
  {
    return source.error();
  }
  std::optional<PointStatistics> statistics;
  if (statistics_)
  {
    Result<PointStatistics> gathered = gatherStatistics(**source, options_);
    if (!gathered)
    {
      return gathered.error();
    }
    statistics = std::move(*gathered);
  }
  const Result<SourceInfo> info = statistics
    ? Result<SourceInfo>(SourceInfo::of(**source, *statistics))
    : SourceInfo::of(**source, options_.scan);
  if (!info)
  {
    return info.error();
  }
  for (const std::string& warning : info->warnings())
  {
    warn(name(), path + ": " + warning);
  }
  std::vector<std::unique_ptr<PointSource>> only;
  only.push_back(std::move(*source));
  const StoreEstimate built = estimate(look_.of(info->points(), only));
  const std::optional<SourceTree> tree = treeOf(path);
  if (tree && !tree->fault.empty())
  {
    warn(name(), path + ": its octree cannot be used: " + tree->fault);
  }
  if (!json_)
  {
    print(sourceText(*info) + (tree ? tree->text : "") + built.text() +
      (statistics ? statisticsText(*statistics) : ""));
    return {};
  }
  reports.push_back(sourceJson(*info));
  reports.back()["estimate"] = built.json();
  if (tree && tree->fault.empty())
  {
    reports.back()["structure"] = tree->structure;
    reports.back()["refinement"] = "add";
    reports.back()["nodes"] = tree->nodes;
    reports.back()["levels"] = tree->levels;
  }
  if (statistics)
  {
    reports.back()["stats"] = statisticsJson(*statistics);
  }
  return {};
}

} // namespace pointfront
