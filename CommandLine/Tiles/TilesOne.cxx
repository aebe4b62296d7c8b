#include "ChosenPasses.h"
#include "InputIdentity.h"
#include "TilesBuild.h"

#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Mosaic/EmptySource.h"
#include "pointfront/Mosaic/KnownColours.h"

#include <algorithm>
#include <filesystem>

namespace pointfront
{
namespace
{
namespace fs = std::filesystem;

/// Findings of those passes that find something of inputs, or of all others.
std::vector<std::string> findingsOf(const AttributePasses& passes, bool ofInputs)
{
  std::vector<std::string> all;
  for (const auto& pass : passes)
  {
    if (pass->findsInputs() == ofInputs)
    {
      const std::vector<std::string> found = pass->findings();
      all.insert(all.end(), found.begin(), found.end());
    }
  }
  return all;
}

/// The most that the tile or one of the eight beside it has.
std::uint64_t mostPointsAround(const MosaicTiles& tiles, const TileIndex& tile)
{
  std::uint64_t most = 0;
  for (const std::int64_t x : { tile.x - 1, tile.x, tile.x + 1 })
  {
    for (const std::int64_t y : { tile.y - 1, tile.y, tile.y + 1 })
    {
      const auto found = tiles.tiles.find({ x, y });
      most = std::max(most, found != tiles.tiles.end() ? found->second : 0);
    }
  }
  return most;
}

std::optional<TileIndex> tileNamed(const MosaicTiles& tiles, const std::string& name)
{
  for (const auto& [tile, points] : tiles.tiles)
  {
    if (tile.name() == name)
    {
      return tile;
    }
  }
  return std::nullopt;
}
} // namespace

std::string TilesBuild::tilePath(const TileIndex& tile) const
{
  return work("tile-" + tile.name() + ".json");
}

/// Path or address of a store that is done.
std::string TilesBuild::storePath(const std::string& file) const
{
  std::string place = request_.published.empty() ? request_.folder : request_.published;
  while (isAddress(place) && place.back() == '/') // that of a whole bucket is "s3://NAME/"
  {
    place.pop_back();
  }
  return place + "/tiles/" + file;
}

Result<void> TilesBuild::loadTiles()
{
  if (Result<void> ready = loadPlan(); !ready || tiles_)
  {
    return ready;
  }
  tiles_ = loadRecord<MosaicTiles>(work("tiles.json"));
  if (!tiles_ || tiles_->inputs.size() != plan_->inputs.size())
  {
    return makeError(Error::Kind::NotFound,
      request_.folder +
        ": the surveys of the inputs were not put together; run --only settle "
        "first");
  }
  return {};
}

Result<AttributePasses> TilesBuild::passes() const
{
  PassChoice choice = request_.passes;
  if (tiles_)
  {
    choice.groundClassified = tiles_->ground;
  }
  return chosenPasses(choice);
}

/// The lowest points of cells are right where the whole cell is known.
double TilesBuild::rim() const
{
  return request_.passes.heightAboveGround && !tiles_->ground ? 2.0 * request_.passes.groundCell
                                                              : 0.0;
}

Result<std::vector<std::pair<std::size_t, SurveyRecord>>> TilesBuild::surveysIn(
  const Bounds& box) const
{
  std::vector<std::pair<std::size_t, SurveyRecord>> surveys;
  for (std::size_t i = 0; i < plan_->inputs.size(); ++i)
  {
    if (tiles_->inputs[i].bounds.empty() || !tiles_->inputs[i].bounds.overlaps(box))
    {
      continue;
    }
    auto record = loadRecord<SurveyRecord>(surveyPath(i));
    if (!record)
    {
      return makeError(Error::Kind::NotFound, surveyPath(i) + ": is not there; run again");
    }
    surveys.emplace_back(i, std::move(*record));
  }
  return surveys;
}

Result<TileInputs> TilesBuild::inputsIn(const Bounds& box) const
{
  const auto surveys = surveysIn(box);
  if (!surveys)
  {
    return surveys.error();
  }
  TileInputs inputs;
  auto next = surveys->begin();
  for (std::size_t i = 0; i < plan_->inputs.size(); ++i)
  {
    const bool here = next != surveys->end() && next->first == i;
    if (!here && !plan_->inputs[i].representative)
    {
      continue;
    }
    Result<std::unique_ptr<PointSource>> source = request_.formats->open(plan_->inputs[i].path);
    if (!source)
    {
      return source.error();
    }
    std::vector<std::uint64_t> chunks;
    std::vector<std::uint64_t> hashes;
    if (here)
    {
      const std::vector<SurveyedChunk>& known = next->second.survey.chunks;
      if ((*source)->chunkCount() != known.size())
      {
        return makeError(Error::Kind::Corrupt,
          plan_->inputs[i].path +
            ": has changed since it was surveyed; run the same command again");
      }
      for (std::size_t chunk = 0; chunk < known.size(); ++chunk)
      {
        if (!known[chunk].bounds.empty() && known[chunk].bounds.overlaps(box))
        {
          chunks.push_back(chunk);
          hashes.push_back(known[chunk].hash);
        }
      }
      *source = fromKept(std::move(*source), keptPath(i), next->second.key);
      *source = std::make_unique<KnownColours>(std::move(*source), tiles_->inputs[i].ownColour);
      ++next;
    }
    inputs.sources.push_back(
      here ? std::move(*source) : std::make_unique<EmptySource>((*source)->description()));
    inputs.chunks.push_back(std::move(chunks));
    inputs.hashes.push_back(std::move(hashes));
    inputs.deepColours.push_back(tiles_->inputs[i].deep);
  }
  return inputs;
}

/// All that the bytes of a tile depend on, if no value of it looks farther than `margin`.
Result<std::string> TilesBuild::tileKey(const TileIndex& tile, double margin) const
{
  const QuantisationGrid& steps = plan_->steps;
  nlohmann::json facts = { plan_->settings, POINTFRONT_VERSION, plan_->grid.edge,
    { steps.scale.x, steps.scale.y, steps.scale.z, steps.offset.x, steps.offset.y, steps.offset.z },
    tiles_->layers, tiles_->wideColours, tiles_->ground, tile.name() };
  for (const PlannedInput& input : plan_->inputs)
  {
    if (input.representative)
    {
      facts.push_back(input.kind);
    }
  }
  const Bounds box = plan_->grid.box(tile, margin + rim());
  const auto surveys = surveysIn(box);
  if (!surveys)
  {
    return surveys.error();
  }
  for (const auto& [input, record] : *surveys)
  {
    nlohmann::json hashes;
    for (const SurveyedChunk& chunk : record.survey.chunks)
    {
      if (!chunk.bounds.empty() && chunk.bounds.overlaps(box))
      {
        hashes.push_back(chunk.hash);
      }
    }
    const SettledInput& settled = tiles_->inputs[input];
    facts.push_back({ plan_->inputs[input].kind, settled.deep, settled.ownColour > 255, hashes });
  }
  const std::string text = facts.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  return hex(hashOfText(text));
}

/// The record of a tile that is as it would be built now.
std::optional<TileRecord> TilesBuild::tileDone(const TileIndex& tile) const
{
  auto record = loadRecord<TileRecord>(tilePath(tile));
  if (!record)
  {
    return std::nullopt;
  }
  const Result<std::string> key = tileKey(tile, record->margin);
  std::error_code failure;
  const std::string path = storePath(record->file);
  const bool there = isAddress(path) || fs::exists(path, failure);
  if (!key || *key != record->key || !there)
  {
    return std::nullopt;
  }
  const Result<TileIdentity> identity = TileIdentity::of(path);
  return identity && *identity == record->identity ? record : std::nullopt;
}

Result<void> TilesBuild::buildNow(const TileIndex& tile, const ProgressFunction& progress) const
{
  const Result<AttributePasses> passes = this->passes();
  if (!passes)
  {
    return passes.error();
  }
  const std::string folder = request_.folder + "/tiles/";
  const std::string meanwhile = folder + tile.name() + "." + processName() + ".part.pfront";
  TileTask task;
  task.grid = plan_->grid;
  task.tile = tile;
  task.margin = firstMargin(*passes, plan_->grid.edge, mostPointsAround(*tiles_, tile));
  task.rim = rim();
  task.cloudExtent = tiles_->extent;
  task.inputs = [&](double margin) { return inputsIn(plan_->grid.box(tile, margin)); };
  task.passes = &*passes;
  task.options = request_.options;
  task.options.outputPath = meanwhile;
  task.options.overwrite = true;
  task.options.grid = plan_->steps;
  task.options.wideColours = tiles_->wideColours;
  task.options.layering = tiles_->layers ? Layering::ObjectClass : Layering::None;
  const Result<TileOutcome> outcome = buildTile(task, progress);
  if (!outcome)
  {
    return outcome.error();
  }
  TileRecord record;
  record.margin = outcome->margin;
  const Result<std::string> key = tileKey(tile, record.margin);
  const Result<TileIdentity> identity = TileIdentity::of(meanwhile);
  if (!key || !identity)
  {
    return key ? identity.error() : key.error();
  }
  record.key = *key;
  record.identity = *identity;
  record.file = tile.name() + "-" + key->substr(0, 8) + ".pfront";
  const BuildReport& report = outcome->report;
  record.points = report.pointsStored;
  record.nodes = report.nodes;
  record.bytes = report.bytesWritten;
  record.spilled = report.spilledBytes;
  record.cpuSeconds = report.cpuSeconds;
  record.rejected = report.pointsRejected;
  record.warnings = report.warnings;
  record.findings = findingsOf(*passes, false);
  record.ofInputs = findingsOf(*passes, true);
  std::error_code failure;
  fs::rename(meanwhile, folder + record.file, failure);
  if (failure)
  {
    return makeError(
      Error::Kind::Unwritable, "cannot rename '" + meanwhile + "': " + failure.message());
  }
  return replaceFile(tilePath(tile), record.json().dump(1));
}

Result<bool> TilesBuild::tile(const std::string& name)
{
  if (Result<void> ready = loadTiles(); !ready)
  {
    return ready.error();
  }
  const std::optional<TileIndex> tile = tileNamed(*tiles_, name);
  if (!tile)
  {
    return makeError(Error::Kind::BadArgument,
      "--only tile:" + name + ": there is no such tile; FOLDER/work/tiles.json lists them");
  }
  if (tileDone(*tile))
  {
    return false;
  }
  const Result<void> done = buildNow(*tile, request_.progress);
  return done
    ? Result<bool>(true)
    : Result<bool>(makeError(done.error().kind, "tile " + name + ": " + done.error().what));
}

} // namespace pointfront
