#include "ChosenPasses.h"
#include "InputIdentity.h"
#include "TilesBuild.h"

#include "pointfront/Mosaic/EmptySource.h"
#include "pointfront/Mosaic/KnownColours.h"
#include "pointfront/Neighbourhood/PointTiles.h"

namespace pointfront
{
namespace
{
PassResources resourcesOf(const TilesRequest& request, const ProgressFunction& progress)
{
  PassResources resources;
  resources.memoryBytes = request.options.memoryBytes;
  resources.threads = request.options.threads;
  resources.temporaryFolder = request.options.temporaryFolder.empty()
    ? request.folder + "/work"
    : request.options.temporaryFolder;
  resources.progress = progress;
  return resources;
}

/// The sources after the passes whose values depend on one point alone.
Result<PointSources> withoutReach(
  const AttributePasses& passes, PointSources sources, const PassResources& resources)
{
  for (const auto& pass : passes)
  {
    if (pass->reach() > 0.0)
    {
      break;
    }
    Result<PointSources> next = pass->apply(std::move(sources), resources);
    if (!next)
    {
      return next;
    }
    sources = std::move(*next);
  }
  return sources;
}

} // namespace

std::string TilesBuild::surveyPath(std::size_t input) const
{
  return work("survey-" + std::to_string(input) + ".json");
}

std::string TilesBuild::keptPath(std::size_t input) const
{
  return work("points-" + std::to_string(input) + ".kept");
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

std::shared_ptr<PointKeeper> TilesBuild::keeperOf(
  std::size_t input, const PointSource& source) const
{
  if (!plan_->inputs[input].kept)
  {
    return nullptr;
  }
  Result<std::shared_ptr<PointKeeper>> keeper = PointKeeper::create(keptPath(input), source);
  if (!keeper)
  {
    tellNotKept(keeper.error(), input);
  }
  return keeper ? std::move(*keeper) : nullptr;
}

void TilesBuild::tellNotKept(const Error& why, std::size_t input) const
{
  request_.warn(plan_->inputs[input].path + ": its tiles decode it again: " + why.what);
}

Result<SurveyRecord> TilesBuild::readSurvey(
  std::size_t input, const ProgressFunction& progress) const
{
  PointSources sources;
  std::size_t place = 0;
  std::shared_ptr<PointKeeper> keeper;
  const auto largest = std::make_shared<std::atomic<std::uint16_t>>(0);
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
    if (i != input)
    {
      sources.push_back(std::make_unique<EmptySource>((*source)->description()));
      continue;
    }
    place = sources.size();
    keeper = keeperOf(input, **source);
    *source = keeper ? keeping(std::move(*source), keeper) : std::move(*source);
    sources.push_back(std::make_unique<KnownColours>(std::move(*source), largest));
  }
  const Result<AttributePasses> passes = this->passes();
  if (!passes)
  {
    return passes.error();
  }
  const PassResources resources = resourcesOf(request_, progress);
  const Result<PointSources> prepared = withoutReach(*passes, std::move(sources), resources);
  if (!prepared)
  {
    return prepared.error();
  }
  WorkCrew crew(threadsOf(resources), progress);
  crew.beginPhase("surveying", (*prepared)[place]->description().pointCount, 1.0);
  Result<InputSurvey> survey = surveyInput(*(*prepared)[place], plan_->grid, crew);
  if (!survey)
  {
    return survey.error();
  }
  SurveyRecord record{ surveyKey(input), std::move(*survey), 0, *largest };
  if (keeper)
  {
    const Result<std::uint64_t> bytes = keeper->finish(record.key);
    if (!bytes)
    {
      tellNotKept(bytes.error(), input);
    }
    record.keptBytes = bytes ? *bytes : 0;
  }
  return record;
}

Result<void> TilesBuild::surveyNow(std::size_t input, const ProgressFunction& progress) const
{
  const Result<SurveyRecord> record = readSurvey(input, progress);
  return record ? replaceFile(surveyPath(input), record->json().dump())
                : Result<void>(record.error());
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
Result<void> TilesBuild::addToTiles(std::size_t input, const SurveyRecord& record,
  MosaicTiles& tiles, std::vector<Error>& faults) const
{
  const InputSurvey& survey = record.survey;
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
  tiles.inputs.push_back({ survey.bounds(), byFile && deep, record.ownColour });
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
    if (Result<void> added = addToTiles(i, *record, tiles, faults); !added)
    {
      return added.error();
    }
    classes |= record->survey.classes;
    tiles.keptBytes += record->keptBytes;
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
