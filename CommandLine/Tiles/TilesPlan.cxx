#include "ChosenPasses.h"
#include "InputIdentity.h"
#include "OwnFiles.h"
#include "TilesBuild.h"

#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Disk/DiskEstimate.h"
#include "pointfront/Ingest/CommonSchema.h"
#include "pointfront/Ingest/GridChoice.h"
#include "pointfront/Ingest/ReferenceSystem.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>
#include <utility>

namespace pointfront
{
namespace
{
namespace fs = std::filesystem;

/// Smaller ones would hold a point each, and be millions of files.
Result<void> checkEdge(double edge, const QuantisationGrid& grid)
{
  const double smallest = 10.0 * std::max(grid.scale.x, grid.scale.y);
  if (edge >= smallest * (1.0 - 1e-9))
  {
    return {};
  }
  std::ostringstream text;
  text << "tiles of " << edge << " units are too small: 10 steps of the coordinates (--tile "
       << smallest << ") are the smallest";
  return makeError(Error::Kind::BadArgument, text.str());
}

/// The largest of 1, 2, 5, 10 ... that is not more.
double roundDown(double edge)
{
  const double power = std::pow(10.0, std::floor(std::log10(edge)));
  return power * (edge >= 5.0 * power ? 5.0 : edge >= 2.0 * power ? 2.0 : 1.0);
}

/// The folder, or the nearest above it that is there.
std::string existing(const std::string& folder)
{
  fs::path path = fs::absolute(folder).lexically_normal();
  std::error_code failure;
  while (!fs::exists(path, failure) && path.has_relative_path())
  {
    path = path.parent_path();
  }
  return path.string();
}

/// Whether to read the points again takes little more than to read them from a copy.
bool decodesFast(const SourceDescription& source)
{
  const auto begins = [&](const char* name) { return source.format.rfind(name, 0) == 0; };
  return !isAddress(source.path) &&
    (begins("LAS ") || begins("PLY binary") || source.format == "PCD binary");
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

/// By input. The points of all, not yet coded, may take half of what is free: the tiles need room,
/// too.
std::vector<bool> TilesBuild::keptInputs(const PointSources& sources) const
{
  std::vector<bool> kept(sources.size(), request_.decoding == Decoding::Once);
  double bytes = 0.0;
  for (std::size_t s = 0; request_.decoding == Decoding::Automatic && s < sources.size(); ++s)
  {
    const SourceDescription& source = sources[s]->description();
    kept[s] = !decodesFast(source);
    const std::size_t position = source.grid ? sizeof(glm::ivec3) : sizeof(glm::dvec3);
    bytes += kept[s] ? static_cast<double>(source.pointCount) *
        static_cast<double>(position + source.schema.pointBytes())
                     : 0.0;
  }
  const auto free = static_cast<double>(diskSpaceOf(existing(request_.folder)).freeBytes);
  return bytes <= 0.5 * free ? kept : std::vector<bool>(sources.size(), false);
}

Result<std::vector<PlannedInput>> TilesBuild::plannedInputs(const PointSources& sources) const
{
  std::vector<PlannedInput> inputs;
  std::set<std::string> kinds;
  std::vector<Error> cut;
  const std::vector<bool> kept = keptInputs(sources);
  for (const auto& source : sources)
  {
    const SourceDescription& description = source->description();
    const Result<std::string> identity = identityOfInput(description);
    if (!identity)
    {
      return identity.error();
    }
    PlannedInput input{ absolutePath(description.path), *identity, kindOf(description) };
    // An empty input chooses nothing for others' points; with nothing but such there are no tiles.
    input.representative = description.pointCount > 0 && kinds.insert(input.kind).second;
    input.kept = kept[inputs.size()];
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
  auto system = commonReferenceSystem(*placed);
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
  if (Result<void> large = checkEdge(*edge, grid->grid); request_.edge > 0.0 && !large)
  {
    return large.error();
  }
  system->keepTimes(
    *placed, [&](std::size_t input) { return (*placed)[input]->description().pointCount > 0; });
  for (const auto* warnings :
    { &std::as_const(*system).warnings, &schema->warnings, &grid->warnings })
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
  const std::string foreign = before || request_.force ? "" : foreignEntry(request_.folder);
  if (!foreign.empty())
  {
    return makeError(Error::Kind::Unwritable,
      request_.folder + ": holds '" + foreign +
        "' and no build of tiles; choose an empty folder, or --force to take this one");
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

} // namespace pointfront
