#include "ChosenPasses.h"
#include "InputIdentity.h"
#include "TilesBuild.h"

#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Ingest/CommonSchema.h"
#include "pointfront/Ingest/GridChoice.h"
#include "pointfront/Ingest/ReferenceSystem.h"
#include "pointfront/Mosaic/EmptySource.h"
#include "pointfront/Neighbourhood/PointTiles.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

namespace pointfront
{
namespace
{
namespace fs = std::filesystem;

/// Whether a folder has more than what a build of tiles makes first.
bool holdsOthers(const std::string& folder)
{
  std::error_code failure;
  for (const auto& entry : fs::directory_iterator(folder, failure))
  {
    if (entry.path().filename() != "work" && entry.path().filename() != "tiles")
    {
      return true;
    }
  }
  return false;
}

/// The largest of 1, 2, 5, 10 ... that is not more.
double roundDown(double edge)
{
  const double power = std::pow(10.0, std::floor(std::log10(edge)));
  return power * (edge >= 5.0 * power ? 5.0 : edge >= 2.0 * power ? 2.0 : 1.0);
}

std::string absolutePath(const std::string& path)
{
  return isAddress(path) ? path : fs::absolute(path).lexically_normal().string();
}
} // namespace

TilesBuild::TilesBuild(TilesRequest request)
  : request_(std::move(request))
{
}

std::string TilesBuild::surveyPath(std::size_t input) const
{
  return work("survey-" + std::to_string(input) + ".json");
}

Result<void> TilesBuild::loadPlan()
{
  if (plan_)
  {
    return {};
  }
  plan_ = loadRecord<MosaicPlan>(work("plan.json"));
  if (!plan_)
  {
    return makeError(Error::Kind::NotFound,
      request_.folder +
        ": no build of tiles was planned there; run without --only, or with "
        "--only plan first");
  }
  if (plan_->settings != request_.settings)
  {
    return makeError(Error::Kind::BadArgument,
      request_.folder + ": was begun with other options: " + plan_->settings.dump() +
        "; repeat them, or begin anew with --force or in another folder");
  }
  return {};
}

Result<double> TilesBuild::chosenEdge(const PointSources& sources) const
{
  if (request_.edge > 0.0)
  {
    return request_.edge;
  }
  constexpr double pointsOfTile = 5e7;
  Bounds bounds;
  double points = 0.0;
  for (const auto& source : sources)
  {
    bounds.add(source->description().declaredBounds);
    points += static_cast<double>(source->description().pointCount);
  }
  const glm::dvec3 size = bounds.empty() ? glm::dvec3(0.0) : bounds.size();
  const double edge = std::sqrt(size.x * size.y * pointsOfTile / std::max(1.0, points));
  if (!(edge > 0.0) || !std::isfinite(edge))
  {
    return makeError(Error::Kind::BadArgument,
      "the inputs do not say how far they extend; say how large a tile is (--tile METRES)");
  }
  return roundDown(std::min(edge, 1e9));
}

Result<std::vector<PlannedInput>> TilesBuild::plannedInputs(const PointSources& sources) const
{
  std::vector<PlannedInput> inputs;
  std::set<std::string> kinds;
  std::vector<Error> cut;
  for (const auto& source : sources)
  {
    const SourceDescription& description = source->description();
    const Result<std::string> identity = identityOfInput(description);
    if (!identity)
    {
      return identity.error();
    }
    PlannedInput input{ absolutePath(description.path), *identity, kindOf(description) };
    input.representative = kinds.insert(input.kind).second;
    const std::uint64_t promised = description.headerPointCount.value_or(description.pointCount);
    input.missing = promised - std::min(promised, description.pointCount);
    if (input.missing > 0)
    {
      cut.push_back(makeError(Error::Kind::Truncated,
        description.path + ": " + std::to_string(input.missing) + " of the " +
          std::to_string(promised) +
          " points that its header promises are missing; get a whole copy"));
    }
    inputs.push_back(std::move(input));
  }
  if (!cut.empty() && request_.options.wholeInputs)
  {
    return faultyInputs(cut, sources.size());
  }
  return inputs;
}

Result<MosaicPlan> TilesBuild::planned(
  PointSources sources, const std::vector<InputFault>& skipped) const
{
  MosaicPlan plan;
  plan.settings = request_.settings;
  Result<std::vector<PlannedInput>> inputs = plannedInputs(sources);
  if (!inputs)
  {
    return inputs.error();
  }
  plan.inputs = std::move(*inputs);
  for (const InputFault& fault : skipped)
  {
    plan.skipped.emplace_back(fault.path, fault.why);
  }
  const Result<AttributePasses> passes = this->passes();
  if (!passes)
  {
    return passes.error();
  }
  Result<PointSources> placed = passes->front()->apply(std::move(sources), {});
  if (!placed)
  {
    return placed.error();
  }
  const auto system = commonReferenceSystem(*placed);
  const auto schema = commonSchema(*placed, std::nullopt);
  const auto grid = chooseGrid(*placed, request_.options.precision);
  const Result<double> edge = chosenEdge(*placed);
  if (!system || !schema || !grid || !edge)
  {
    return !system ? system.error()
      : !schema    ? schema.error()
      : !grid      ? grid.error()
                   : edge.error();
  }
  for (const auto* warnings : { &system->warnings, &schema->warnings, &grid->warnings })
  {
    std::for_each(warnings->begin(), warnings->end(), request_.warn);
  }
  const auto& wanted = request_.options.attributes;
  const auto classes = schema->schema.find("classification");
  plan.classes = classes && schema->schema[*classes].bytes() == 1 &&
    (!wanted || std::find(wanted->begin(), wanted->end(), "classification") != wanted->end());
  plan.steps = grid->grid;
  plan.grid.edge = *edge;
  return plan;
}

Result<bool> TilesBuild::plan()
{
  std::error_code failure;
  std::optional<MosaicPlan> before = loadRecord<MosaicPlan>(work("plan.json"));
  if (before && before->settings != request_.settings)
  {
    if (!request_.force)
    {
      return loadPlan().error();
    }
    before.reset();
  }
  else if (!before && fs::exists(request_.folder, failure) && holdsOthers(request_.folder) &&
    !request_.force)
  {
    return makeError(Error::Kind::Unwritable,
      request_.folder +
        ": is there, and holds no build of tiles; choose an empty folder, or "
        "--force to take this one");
  }
  Result<OpenedInputs> inputs = request_.openAll();
  if (!inputs)
  {
    return inputs.error();
  }
  Result<MosaicPlan> plan = planned(std::move(inputs->sources), inputs->skipped);
  if (!plan)
  {
    return plan.error();
  }
  if (before && request_.edge == 0.0)
  {
    plan->grid = before->grid; // tiles stay where they are, though there are more points
  }
  fs::create_directories(request_.folder + "/work", failure);
  fs::create_directories(request_.folder + "/tiles", failure);
  plan_ = std::move(*plan);
  const std::string text = plan_->json().dump(1);
  if (before && before->json().dump(1) == text)
  {
    return false;
  }
  const Result<void> written = replaceFile(work("plan.json"), text);
  return written ? Result<bool>(true) : Result<bool>(written.error());
}

std::string TilesBuild::surveyKey(std::size_t input) const
{
  std::string text = plan_->settings.dump() + plan_->inputs[input].path +
    plan_->inputs[input].identity + plan_->inputs.front().kind + std::to_string(plan_->grid.edge);
  for (const std::vector<std::string>* images :
    { &request_.passes.colourFrom, &request_.passes.attributeFrom })
  {
    for (const std::string& image : *images)
    {
      const std::size_t name = image.find('=');
      const std::string path = name == std::string::npos ? image : image.substr(name + 1);
      const Result<std::string> identity = identityOfFile(path);
      text += image + (identity ? *identity : "");
    }
  }
  return hex(hashOfText(text));
}

bool TilesBuild::surveyed(std::size_t input) const
{
  const auto record = loadRecord<SurveyRecord>(surveyPath(input));
  return record && record->key == surveyKey(input);
}

Result<InputSurvey> TilesBuild::readSurvey(
  std::size_t input, const ProgressFunction& progress) const
{
  PointSources sources;
  std::size_t place = 0;
  for (std::size_t i = 0; i < plan_->inputs.size(); ++i)
  {
    if (i != input && !plan_->inputs[i].representative)
    {
      continue;
    }
    Result<std::unique_ptr<PointSource>> source = request_.formats->open(plan_->inputs[i].path);
    if (!source)
    {
      return source.error();
    }
    place = i == input ? sources.size() : place;
    sources.push_back(
      i == input ? std::move(*source) : std::make_unique<EmptySource>((*source)->description()));
  }
  const Result<AttributePasses> passes = this->passes();
  if (!passes)
  {
    return passes.error();
  }
  PassResources resources;
  resources.memoryBytes = request_.options.memoryBytes;
  resources.threads = request_.options.threads;
  resources.temporaryFolder = request_.options.temporaryFolder.empty()
    ? request_.folder + "/work"
    : request_.options.temporaryFolder;
  resources.progress = progress;
  for (const auto& pass : *passes)
  {
    if (pass->reach() > 0.0)
    {
      break;
    }
    Result<PointSources> next = pass->apply(std::move(sources), resources);
    if (!next)
    {
      return next.error();
    }
    sources = std::move(*next);
  }
  WorkCrew crew(threadsOf(resources), progress);
  crew.beginPhase("surveying", sources[place]->description().pointCount, 1.0);
  return surveyInput(*sources[place], plan_->grid, crew);
}

Result<void> TilesBuild::surveyNow(std::size_t input, const ProgressFunction& progress) const
{
  Result<InputSurvey> read = readSurvey(input, progress);
  if (!read)
  {
    return read.error();
  }
  const SurveyRecord record{ surveyKey(input), std::move(*read) };
  return replaceFile(surveyPath(input), record.json().dump());
}

Result<bool> TilesBuild::survey(std::size_t input)
{
  if (Result<void> ready = loadPlan(); !ready)
  {
    return ready.error();
  }
  if (input >= plan_->inputs.size())
  {
    return makeError(Error::Kind::BadArgument,
      "--only survey:" + std::to_string(input) + ": there are " +
        std::to_string(plan_->inputs.size()) + " inputs, from 0 on");
  }
  if (surveyed(input))
  {
    return false;
  }
  const Result<void> done = surveyNow(input, request_.progress);
  return done ? Result<bool>(true) : Result<bool>(done.error());
}

/// One input adds its part to what all tiles have in common.
Result<void> TilesBuild::addToTiles(std::size_t input, const InputSurvey& survey,
  MosaicTiles& tiles, std::vector<Error>& faults) const
{
  std::uint64_t rejected = 0;
  for (const auto& [reason, points] : survey.rejected)
  {
    rejected += points;
    tiles.rejected[reason] += points;
  }
  if (survey.read > 0 && rejected == survey.read)
  {
    const std::string why = "none of its " + std::to_string(survey.read) + " points can be stored";
    tiles.skipped.emplace_back(plan_->inputs[input].path, why);
    faults.push_back(makeError(Error::Kind::BadFormat, plan_->inputs[input].path + ": " + why));
  }
  if (plan_->inputs[input].missing > 0)
  {
    tiles.rejected["missing"] += plan_->inputs[input].missing;
  }
  tiles.read += survey.read;
  const bool byFile = request_.options.colourDepth == ColourDepth::ByFile;
  const bool deep = survey.largestColour > 255;
  tiles.wideColours = tiles.wideColours || (byFile && deep);
  tiles.inputs.push_back({ survey.bounds(), byFile && deep });
  for (const auto& [tile, points] : survey.tiles)
  {
    tiles.tiles[tile] += points;
  }
  return {};
}

Result<bool> TilesBuild::settle()
{
  if (Result<void> ready = loadPlan(); !ready)
  {
    return ready.error();
  }
  MosaicTiles tiles;
  tiles.skipped = plan_->skipped;
  std::vector<Error> faults;
  std::bitset<256> classes;
  Bounds all;
  for (std::size_t i = 0; i < plan_->inputs.size(); ++i)
  {
    const auto record = loadRecord<SurveyRecord>(surveyPath(i));
    if (!record || record->key != surveyKey(i))
    {
      return makeError(Error::Kind::NotFound,
        plan_->inputs[i].path + ": has not been surveyed; run --only survey:" + std::to_string(i) +
          " first");
    }
    if (Result<void> added = addToTiles(i, record->survey, tiles, faults); !added)
    {
      return added.error();
    }
    classes |= record->survey.classes;
    all.add(tiles.inputs.back().bounds);
  }
  if (!faults.empty() && (request_.options.onFault == OnFault::Stop || tiles.tiles.empty()))
  {
    return faultyInputs(faults, plan_->inputs.size());
  }
  if (tiles.tiles.empty())
  {
    return makeError(Error::Kind::BadArgument, "the inputs have no points to store");
  }
  constexpr std::size_t unclassifiedCodes = 2; // 0 and 1
  tiles.layers = request_.automaticLayers ? plan_->classes && (classes >> unclassifiedCodes).any()
                                          : request_.options.layering == Layering::ObjectClass;
  tiles.ground = classes.test(2);
  const glm::dvec3 size = all.size();
  tiles.extent = size.x + size.y + plan_->grid.edge;
  tiles_ = tiles;
  const std::string text = tiles.json().dump();
  if (const auto before = loadRecord<MosaicTiles>(work("tiles.json"));
      before && before->json().dump() == text)
  {
    return false;
  }
  const Result<void> written = replaceFile(work("tiles.json"), text);
  return written ? Result<bool>(true) : Result<bool>(written.error());
}

} // namespace pointfront
