// The part of `pointfront build` that is about tiles.
#include "BuildCommand.h"
#include "ByteSize.h"
#include "ChosenPasses.h"
#include "InputFaults.h"
#include "PeakMemory.h"
#include "ProgressDisplay.h"
#include "Values.h"

#include <algorithm>
#include <cstdio>
#include <set>

namespace pointfront
{
namespace
{
/// The fault of a step of --only; empty: none.
std::string checkStep(const std::string& text)
{
  const std::string number = text.rfind("survey:", 0) == 0 ? text.substr(7) : "";
  const bool survey = !number.empty() && number.size() < 10 &&
    number.find_first_not_of("0123456789") == std::string::npos;
  const bool tile = text.rfind("tile:", 0) == 0 && text.size() > 5;
  return text == "plan" || text == "settle" || text == "collect" || survey || tile
    ? std::string()
    : "'" + text + "' is no step: plan, survey:N, settle, tile:NAME or collect";
}

/// The plan keeps the names of images: those that cannot be read are refused before it is written.
Result<void> checkTilePasses(const PassChoice& choice)
{
  if (choice.normalsEps > 0.0)
  {
    return makeError(Error::Kind::BadArgument,
      "--tiles with --normals-eps: neighbours of an approximate search depend on what else is "
      "searched, so tiles would have seams; leave --normals-eps out");
  }
  return checkImages(choice);
}
} // namespace

void BuildCommand::declareTiles()
{
  CLI::Option* tiles = app_->add_flag("--tiles", tiles_,
    "Build a collection of tiles in the folder OUT, each a store of its own, with the values that "
    "one store would have; goes on where it was stopped");
  app_->add_option("--tile", tileEdge_, "Edge of a tile (auto: 50 million points in each, about)")
    ->check([](const std::string& text)
      { return text == "auto" ? std::string() : positiveNumber()(text); })
    ->type_name("METRES|auto")
    ->needs(tiles);
  app_
    ->add_option("--decode", decode_,
      "once: points wait decoded below OUT/work until the tiles are built; twice: inputs are read "
      "for the survey and for the tiles; auto: once where decoding is slow and the disk has room")
    ->check(CLI::IsMember({ "auto", "once", "twice" }))
    ->needs(tiles);
  app_
    ->add_option(
      "--only", only_, "One step of a build of tiles, for programs that run them in many processes")
    ->check([](const std::string& text) { return checkStep(text); })
    ->type_name("plan|survey:N|settle|tile:NAME|collect")
    ->needs(tiles);
  app_
    ->add_option("--published", published_,
      "With --only: tiles that are done lie below this address, in tiles/, and not below OUT")
    ->type_name("ADDRESS")
    ->needs("--only");
}

nlohmann::json BuildCommand::tileSettings() const
{
  // These do not decide about the bytes, or are told apart otherwise.
  static const std::set<std::string> free = { "--output", "--memory", "--threads", "--temp",
    "--force", "--progress", "--preview", "--json", "--tiles", "--only", "--published", "--decode",
    "--help", "--on-error" };
  nlohmann::json settings = nlohmann::json::object();
  for (const CLI::Option* option : app_->get_options())
  {
    const std::string name = option->get_name();
    if (option->count() > 0 && name.rfind("--", 0) == 0 && free.count(name) == 0)
    {
      settings[name] = option->results();
    }
  }
  return settings;
}

Result<void> BuildCommand::buildTiles()
{
  const auto refuse = [](const std::string& why)
  { return makeError(Error::Kind::BadArgument, why); };
  if (options_.refinement == Refinement::Replace)
  {
    return refuse("--tiles with --refinement replace: a collection of means would show means of "
                  "means; build one store, or leave --refinement out");
  }
  if (box_)
  {
    return refuse("--tiles with --box: tiles are of whole inputs; build one store of the box, or "
                  "export the box and build tiles of that");
  }
  const PassChoice choice = passes_.choice();
  if (Result<void> right = checkTilePasses(choice); !right)
  {
    return right;
  }
  const SourceFormats formats(sourceChoice_.options(options_));
  ProgressDisplay display(*ProgressDisplay::styleOf(progress_));
  TilesRequest request;
  request.folder = options_.outputPath;
  request.published = published_;
  request.edge = tileEdge_ == "auto" ? 0.0 : std::stod(tileEdge_);
  request.force = options_.overwrite;
  request.settings = tileSettings();
  request.options = options_;
  request.automaticLayers = options_.layering == Layering::Automatic;
  request.decoding = decode_ == "once" ? Decoding::Once
    : decode_ == "twice"               ? Decoding::Twice
                                       : Decoding::Automatic;
  request.passes = choice;
  request.formats = &formats;
  request.openAll = [this] { return openSources(); };
  request.warn = [this](const std::string& text) { warn(name(), text); };
  request.progress = display.function();
  TilesBuild build(std::move(request));
  const Result<void> done = only_.empty() ? runAll(build) : runStep(build);
  if (!done && done.error().kind == Error::Kind::Cancelled)
  {
    return makeError(Error::Kind::Cancelled,
      "stopped; finished tiles, the plan and the surveys stay in '" + options_.outputPath +
        "', and the same command goes on" + (options_.overwrite ? " if it has no --force" : ""));
  }
  return done;
}

Result<void> BuildCommand::runAll(TilesBuild& build)
{
  const Result<TilesReport> report = build.all();
  return report ? tell(*report) : Result<void>(report.error());
}

Result<void> BuildCommand::runStep(TilesBuild& build)
{
  if (only_ == "collect")
  {
    const Result<TilesReport> report = build.collect();
    return report ? tell(*report) : Result<void>(report.error());
  }
  const std::string rest = only_.substr(std::min(only_.size(), only_.find(':') + 1));
  const Result<bool> done = only_ == "plan" ? build.plan()
    : only_ == "settle"                     ? build.settle()
    : only_.rfind("survey:", 0) == 0        ? build.survey(std::stoul(rest))
                                            : build.tile(rest);
  if (!done)
  {
    return done.error();
  }
  if (json_)
  {
    const nlohmann::ordered_json object = { { "step", only_ }, { "done_before", !*done } };
    std::printf("%s\n", object.dump().c_str());
  }
  else
  {
    std::printf("%s: %s\n", only_.c_str(), *done ? "done" : "was done before");
  }
  return {};
}

Result<void> BuildCommand::tell(const TilesReport& report) const
{
  const BuildReport& sums = report.sums;
  if (json_)
  {
    const bool skips = options_.onFault == OnFault::Skip;
    nlohmann::ordered_json object =
      nlohmann::ordered_json::parse(buildReportJson(sums, peakResidentBytes(), skips));
    object["collection"] = report.collection;
    object["tiles"] = report.tiles;
    object["tiles_built"] = report.built;
    std::printf(
      "%s\n", object.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
    return {};
  }
  const std::string rejected = rejectionText(sums);
  const std::string leftOut =
    (rejected.empty() ? "" : "; left out: " + rejected) + skippedText(sums.inputsSkipped);
  std::printf("%s: %llu points in %llu tiles (%llu built now), %s, %.1f s%s\n",
    report.collection.c_str(), static_cast<unsigned long long>(sums.pointsStored),
    static_cast<unsigned long long>(report.tiles), static_cast<unsigned long long>(report.built),
    byteSizeText(sums.bytesWritten).c_str(), sums.seconds, leftOut.c_str());
  return {};
}

} // namespace pointfront
