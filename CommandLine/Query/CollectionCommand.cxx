#include "CollectionCommand.h"

#include "ByteSize.h"
#include "CancelSignal.h"
#include "KnownSystems.h"
#include "KnownWords.h"
#include "ProgressDisplay.h"

#include "pointfront/Base/PrintableText.h"
#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Export/OutputTarget.h"
#include "pointfront/Tiles/CollectionCloud.h"
#include "pointfront/Tiles/TileFormat.h"

#include <nlohmann/json.hpp>

#include <glob.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

namespace pointfront
{
namespace
{
std::string dumped(const nlohmann::ordered_json& object)
{
  return object.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

bool sameSystem(const std::string& one, const std::string& other)
{
  const std::shared_ptr<const CoordinateSystems> known = knownSystems();
  const auto a = known->parse(one);
  const auto b = known->parse(other);
  return a && b && known->equivalent(*a, *b, false);
}

bool named(const std::string& path, const std::string& ending)
{
  return path.size() > ending.size() &&
    path.compare(path.size() - ending.size(), ending.size(), ending) == 0;
}

/// The tiles that an argument stands for: those of a folder, a list or a pattern, or itself; and
/// what a folder leaves out.
Result<std::vector<std::string>> tilesOf(
  const std::string& argument, std::vector<std::string>& warnings)
{
  std::error_code failure;
  if (named(argument, ".pfronts"))
  {
    return readTileList(argument);
  }
  const std::filesystem::path path(argument);
  if (!isAddress(argument) && std::filesystem::is_directory(path, failure) &&
    !std::filesystem::exists(path / "ept.json", failure))
  {
    Result<TileFolder> folder = TileFolder::of(argument);
    if (!folder)
    {
      return folder.error();
    }
    if (folder->files.empty())
    {
      return makeError(Error::Kind::NotFound, argument + ": the folder has no store");
    }
    for (const std::string& warning : folder->warnings)
    {
      warnings.push_back(argument + ": " + warning);
    }
    return std::move(folder->files);
  }
  if (!isAddress(argument) && !std::filesystem::exists(path, failure) &&
    argument.find_first_of("*?[") != std::string::npos)
  {
    glob_t matches = {};
    std::vector<std::string> found;
    if (::glob(argument.c_str(), 0, nullptr, &matches) == 0)
    {
      found.assign(matches.gl_pathv, matches.gl_pathv + matches.gl_pathc);
    }
    ::globfree(&matches);
    return found.empty() ? Result<std::vector<std::string>>(
                             makeError(Error::Kind::NotFound, "nothing matches '" + argument + "'"))
                         : Result<std::vector<std::string>>(std::move(found));
  }
  return std::vector<std::string>{ argument };
}

std::string reportJson(const CollectionReport& report, double seconds)
{
  nlohmann::ordered_json object;
  object["state"] = report.state;
  object["tiles"] = report.tiles;
  object["points"] = report.points;
  object["added"] = report.added;
  object["removed"] = report.removed;
  object["head_points"] = report.headPoints;
  object["bytes_written"] = report.bytesWritten;
  object["seconds"] = seconds;
  return dumped(object);
}

nlohmann::ordered_json tileJson(const CollectedTile& tile)
{
  nlohmann::ordered_json object;
  object["name"] = tile.is.name;
  object["address"] = tile.is.address;
  object["epoch"] =
    tile.is.epoch.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(tile.is.epoch);
  object["points"] = tile.pointCount;
  object["bytes"] = tile.fileBytes;
  object["nodes"] = tile.nodes;
  const Bounds& box = tile.bounds;
  object["bounds"] = { box.low.x, box.low.y, box.low.z, box.high.x, box.high.y, box.high.z };
  return object;
}
/// The faults of the file, and the tiles that are missing or others. Cancelled.
Result<std::vector<std::string>> faultsOf(const CollectionCloud& cloud, const std::string& progress)
{
  ProgressDisplay display(*ProgressDisplay::styleOf(progress));
  const Result<VerifyReport> heads = cloud.verifyHeads(display.function());
  if (!heads)
  {
    return heads.error();
  }
  std::vector<std::string> faults;
  if (!heads->ok)
  {
    faults.push_back(heads->firstError);
  }
  for (const std::size_t t : cloud.tileNumbers())
  {
    if (CancelSignal::requested())
    {
      return makeError(Error::Kind::Cancelled, "cancelled");
    }
    if (const auto tile = cloud.tiles().open(t); !tile)
    {
      faults.push_back(tile.error().what);
    }
  }
  return faults;
}
} // namespace

void CollectionCommand::declare(CLI::App& program)
{
  app_ = program.add_subcommand(
    "collection", "Thousands of stores as one file that opens at once, changed tile by tile");
  app_
    ->add_option("what", what_,
      "create: a collection of the tiles; add: take tiles in; replace: put a new file in the place "
      "of the tile of its name; remove: take tiles out; list: name tiles and changes; verify: "
      "check the file, and that each tile is there and what it was; undo: take the last change "
      "back; compact: make the heads anew and forget the changes")
    ->required()
    ->type_name("create|add|replace|remove|list|verify|undo|compact")
    ->check(
      knownWords({ "create", "add", "replace", "remove", "list", "verify", "undo", "compact" }));
  app_->add_option("collection", path_, "The collection")
    ->required()
    ->type_name("NAME.pfcollection");
  app_
    ->add_option("tiles", tiles_,
      "Stores, indices, COPC and EPT by path or address; folders, lists and patterns of them; with "
      "remove: names of tiles")
    ->type_name("STORE...");
  app_->add_option("--epoch", epoch_, "create, add, replace: a date or a name that the tiles get")
    ->type_name("NAME");
  app_->add_option("--name", name_, "add, replace: the name of one tile (that of its file)")
    ->type_name("NAME");
  app_->add_flag("--force", replace_, "create: replace an existing collection");
  app_->add_option("--progress", progress_, "On stderr: auto, plain, json or none (auto)")
    ->check(knownWords({ "auto", "plain", "json", "none" }));
  app_->add_flag("--json", json_, "Print one JSON object");
  app_->final_callback([this] { checkWords(); });
}

void CollectionCommand::checkWords() const
{
  const bool takes = what_ == "create" || what_ == "add" || what_ == "replace";
  const bool names = takes || what_ == "remove";
  const auto refuse = [](const std::string& why) { throw CLI::ValidationError(why); };
  if (names && tiles_.empty())
  {
    refuse("collection " + what_ + ": name at least one tile");
  }
  if (!names && !tiles_.empty())
  {
    refuse("collection " + what_ + " takes no tiles");
  }
  if (!takes && !epoch_.empty())
  {
    refuse("--epoch: collection " + what_ + " takes no tile in");
  }
  for (const char* option : { "--name", "--epoch" })
  {
    if (app_->count(option) > 0 && (option == std::string("--name") ? name_ : epoch_).empty())
    {
      refuse(std::string(option) + ": is empty");
    }
  }
  if ((what_ != "add" && what_ != "replace") && !name_.empty())
  {
    refuse("--name: only add and replace name a tile");
  }
  if (what_ != "list" && what_ != "verify" && isAddress(path_))
  {
    refuse("collection " + what_ + ": '" + publicForm(path_) +
      "' is an address, and this writes files of this machine only; write a file and upload that");
  }
  if (what_ != "create" && replace_)
  {
    refuse("--force: only create writes over another file");
  }
}

Result<std::vector<TileRequest>> CollectionCommand::requests(
  std::vector<std::string>& warnings) const
{
  std::vector<TileRequest> requests;
  for (const std::string& argument : tiles_)
  {
    const Result<std::vector<std::string>> paths = tilesOf(argument, warnings);
    if (!paths)
    {
      return paths.error();
    }
    for (const std::string& path : *paths)
    {
      requests.push_back({ path, name_, epoch_ });
    }
  }
  if (!name_.empty() && requests.size() != 1)
  {
    return makeError(
      Error::Kind::BadArgument, "--name names one tile, not " + std::to_string(requests.size()));
  }
  return requests;
}

Result<CollectionReport> CollectionCommand::change(const CollectionOptions& options) const
{
  if (what_ == "remove")
  {
    return removeTiles(path_, tiles_, options);
  }
  if (what_ == "undo")
  {
    return undoCollection(path_, options);
  }
  if (what_ == "compact")
  {
    return compactCollection(path_, options);
  }
  std::vector<std::string> warnings;
  const Result<std::vector<TileRequest>> tiles = requests(warnings);
  if (!tiles)
  {
    return tiles.error();
  }
  for (const std::string& warning : warnings)
  {
    warn("collection", warning);
  }
  if (what_ == "add")
  {
    return addTiles(path_, *tiles, options);
  }
  if (what_ == "replace")
  {
    return replaceTiles(path_, *tiles, options);
  }
  std::vector<std::string> reads;
  for (const TileRequest& tile : *tiles)
  {
    reads.push_back(tile.path);
  }
  if (Result<void> target = checkOutputTarget({ path_, FileKind::Collection, replace_ }, reads);
      !target)
  {
    return target.error();
  }
  return createCollection(path_, *tiles, options);
}

Result<void> CollectionCommand::list() const
{
  const Result<std::shared_ptr<const CollectionCloud>> cloud = CollectionCloud::open(path_);
  if (!cloud)
  {
    return cloud.error();
  }
  const CollectionRecord& record = (*cloud)->record();
  const std::vector<std::size_t> shown = (*cloud)->tileNumbers();
  if (json_)
  {
    nlohmann::ordered_json object;
    object["state"] = record.state;
    object["points"] = (*cloud)->description().pointCount;
    object["tiles"] = nlohmann::ordered_json::array();
    for (const std::size_t t : shown)
    {
      object["tiles"].push_back(tileJson(record.tiles[t]));
    }
    object["history"] = nlohmann::ordered_json::array();
    for (const CollectionChange& change : record.history)
    {
      object["history"].push_back(change.what);
    }
    std::printf("%s\n", dumped(object).c_str());
    return {};
  }
  for (const std::size_t t : shown)
  {
    const CollectedTile& tile = record.tiles[t];
    // One line a tile, whatever the folders of its address are called.
    std::printf("%s  %llu points  %s%s%s\n", printableText(tile.is.name).c_str(),
      static_cast<unsigned long long>(tile.pointCount), printableText(tile.is.address).c_str(),
      tile.is.epoch.empty() ? "" : "  ", printableText(tile.is.epoch).c_str());
  }
  std::printf(
    "%zu tiles, state %llu\n", shown.size(), static_cast<unsigned long long>(record.state));
  for (auto change = record.history.rbegin(); change != record.history.rend(); ++change)
  {
    std::printf("  can be undone: %s\n", printableText(change->what).c_str());
  }
  return {};
}

Result<void> CollectionCommand::verify() const
{
  constexpr std::size_t mostNamed = 10;
  const auto cloud = CollectionCloud::open(path_);
  const Result<std::vector<std::string>> found = cloud
    ? faultsOf(**cloud, progress_)
    : Result<std::vector<std::string>>(std::vector<std::string>{ cloud.error().what });
  if (!found)
  {
    return found.error();
  }
  const std::vector<std::string>& faults = *found;
  const std::size_t checked = cloud ? (*cloud)->tileNumbers().size() : 0;
  if (json_)
  {
    nlohmann::ordered_json object;
    object["ok"] = faults.empty();
    object["tiles_checked"] = checked;
    object["first_error"] =
      faults.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(faults.front());
    object["errors"] = faults;
    std::printf("%s\n", dumped(object).c_str());
  }
  if (faults.empty())
  {
    if (!json_)
    {
      std::printf(
        "%s: the file is sound, and %zu tiles are what they were\n", path_.c_str(), checked);
    }
    return {};
  }
  std::string all;
  for (std::size_t f = 0; f < std::min(faults.size(), mostNamed); ++f)
  {
    all += (f == 0 ? "" : "; ") + faults[f];
  }
  return makeError(Error::Kind::Corrupt,
    faults.size() > mostNamed ? std::to_string(faults.size()) + " faults: " + all : all);
}

Result<void> CollectionCommand::run()
{
  const CancelSignal signal(CancelSignal::Mode::Finish);
  if (what_ == "list")
  {
    return list();
  }
  if (what_ == "verify")
  {
    return verify();
  }
  const auto begin = std::chrono::steady_clock::now();
  CollectionOptions options;
  options.sameSystem = sameSystem;
  Result<CollectionReport> report = makeError(Error::Kind::Cancelled, "");
  {
    ProgressDisplay display(*ProgressDisplay::styleOf(progress_));
    options.progress = display.function();
    report = change(options);
  }
  if (!report)
  {
    return report.error();
  }
  for (const std::string& warning : report->warnings)
  {
    warn("collection", warning);
  }
  const double seconds =
    std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (json_)
  {
    std::printf("%s\n", reportJson(*report, seconds).c_str());
  }
  else
  {
    std::printf("%s: state %llu, %llu tiles, %llu points; %s written in %.2f s\n", path_.c_str(),
      static_cast<unsigned long long>(report->state),
      static_cast<unsigned long long>(report->tiles),
      static_cast<unsigned long long>(report->points), byteSizeText(report->bytesWritten).c_str(),
      seconds);
  }
  return {};
}

} // namespace pointfront
