#include "ProjectionPass.h"

#include "ReferencedSource.h"
#include "TransformedExtent.h"

#include "pointfront/Disk/SmallFile.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

namespace pointfront
{
namespace
{
const char* const utm = "utm";

void dropProjectionRecords(std::vector<MetadataRecord>& records)
{
  records.erase(std::remove_if(records.begin(), records.end(),
                  [](const MetadataRecord& r) { return r.owner == "LASF_Projection"; }),
    records.end());
}

/// Angles in a file that does not say so: inside the globe, far from the origin for their extent,
/// with heights that dwarf it, or whose steps are far coarser. A scanned object of some metres is
/// none.
bool looksLikeDegrees(const SourceDescription& source)
{
  const Bounds& b = source.declaredBounds;
  if (b.empty() || b.low.x < -180.0 || b.high.x > 180.0 || b.low.y < -90.0 || b.high.y > 90.0)
  {
    return false;
  }
  const double extent = std::max(b.size().x, b.size().y);
  if (std::abs(b.centre().x) + std::abs(b.centre().y) <= 10.0 * extent)
  {
    return false;
  }
  const bool dwarfed = b.size().z > 10.0 * extent;
  if (source.grid)
  {
    constexpr double micrometre = 1e-6;
    const glm::dvec3& scale = source.grid->scale;
    return scale.x <= micrometre && (scale.z >= 10.0 * scale.x || dwarfed);
  }
  return extent < 1.0 && dwarfed;
}

/// The bounds and the scanners' places, as they are in another system.
Result<void> moveDescription(SourceDescription& description, const CoordinateTransform& transform)
{
  if (!description.declaredBounds.empty())
  {
    Result<Bounds> moved = transformedBounds(description.declaredBounds, transform);
    if (!moved)
    {
      return moved.error();
    }
    description.declaredBounds = *moved;
  }
  for (ScannerPlace& scanner : description.scanners)
  {
    if (Result<void> done = transform.apply(&scanner.position, 1); !done)
    {
      return done;
    }
  }
  return {};
}
} // namespace

Result<CoordinateSystem> ProjectionPass::defined(const std::string& definition) const
{
  std::error_code failure;
  if (!std::filesystem::is_regular_file(definition, failure))
  {
    return known_.parse(definition);
  }
  const Result<std::string> text = readSmallText(definition, mostDefinitionBytes);
  if (!text)
  {
    return text.error();
  }
  Result<CoordinateSystem> system = known_.parse(*text);
  if (!system)
  {
    return makeError(system.error().kind, definition + ": " + system.error().what);
  }
  return system;
}

ProjectionPass::Known ProjectionPass::systemOf(const SourceDescription& source) const
{
  const GeoKeys keys = GeoKeys::parse(source.metadata);
  std::string reason;
  if (!source.crsWkt.empty())
  {
    Result<CoordinateSystem> system = known_.parse(source.crsWkt);
    if (system)
    {
      return StatedSystem{ *system, false };
    }
    reason = system.error().what;
  }
  if (!keys.empty())
  {
    std::vector<std::string> warnings;
    Result<CoordinateSystem> system = known_.fromGeoKeys(keys, warnings);
    for (const std::string& warning : warnings)
    {
      findings_.push_back(source.path + ": " + warning);
    }
    if (system)
    {
      return StatedSystem{ *system, false };
    }
    reason = reason.empty() ? system.error().what : reason;
  }
  if (!reason.empty())
  {
    findings_.push_back(source.path + ": its coordinate reference system is not known: " + reason +
      (options_.assumed.empty() ? ". Name it with " + options_.assumedName + "."
                                : ". It is taken to be what is assumed."));
  }
  return std::nullopt;
}

Result<std::vector<ProjectionPass::Known>> ProjectionPass::systemsOf(
  const PointSources& sources) const
{
  Known assumed;
  if (!options_.assumed.empty())
  {
    Result<CoordinateSystem> system = defined(options_.assumed);
    if (!system)
    {
      return system.error();
    }
    assumed = StatedSystem{ *system, true };
  }
  std::vector<Known> systems;
  for (const std::unique_ptr<PointSource>& source : sources)
  {
    Known own = systemOf(source->description());
    systems.push_back(own ? std::move(own) : assumed);
  }
  return systems;
}

Result<CoordinateSystem> ProjectionPass::utmZone(
  const SourceDescription& source, const CoordinateSystem& system) const
{
  constexpr double halfTurn = 3.14159265358979;
  const Bounds& where = source.declaredBounds;
  if (where.empty())
  {
    return makeError(Error::Kind::BadArgument,
      source.path +
        ": does not say where it is before it is read, so no UTM zone can be chosen; "
        "name the zone");
  }
  if (system.geographic && where.size().x * system.unitLength > halfTurn)
  {
    return makeError(Error::Kind::BadArgument,
      source.path + ": its points have longitudes from " + std::to_string(where.low.x) + " to " +
        std::to_string(where.high.x) +
        ", so they surround the globe or lie on both sides of the antimeridian, and no UTM zone "
        "can be chosen; name the zone");
  }
  return known_.utmZone(system, where.centre());
}

Result<std::optional<CoordinateSystem>> ProjectionPass::chooseTarget(
  const PointSources& sources, const std::vector<Known>& systems) const
{
  std::size_t first = 0;
  while (first < systems.size() && !systems[first])
  {
    ++first;
  }
  if (options_.target.empty())
  {
    return first < systems.size() ? std::optional<CoordinateSystem>(*systems[first]) : std::nullopt;
  }
  for (std::size_t s = 0; s < sources.size(); ++s)
  {
    if (!systems[s])
    {
      return makeError(Error::Kind::BadArgument,
        sources[s]->description().path + ": names no coordinate reference system, so its points " +
          "cannot be transformed to " + options_.target + "; say with " + options_.assumedName +
          " what they are in");
    }
  }
  Result<CoordinateSystem> target = [&]() -> Result<CoordinateSystem>
  {
    if (options_.target != utm)
    {
      return defined(options_.target);
    }
    return utmZone(sources[first]->description(), *systems[first]);
  }();
  if (!target)
  {
    return target.error();
  }
  const bool allUpright = std::all_of(
    systems.begin(), systems.end(), [](const Known& system) { return system->vertical; });
  if (!target->vertical && !target->geocentric && allUpright)
  {
    target = known_.compound(*target, *systems[first]);
    if (!target)
    {
      return target.error();
    }
  }
  return std::optional<CoordinateSystem>(*target);
}

void ProjectionPass::warnOfHeights(const std::string& path, const CoordinateSystem& from,
  const CoordinateSystem& to, bool transformed) const
{
  if (from.vertical && !to.vertical)
  {
    findings_.push_back(path + ": its heights, those of " + from.name + ", stay as they are; " +
      to.name + " names none.");
  }
  else if (!from.vertical && to.vertical)
  {
    findings_.push_back(path + ": " + from.name + " names no system of heights; they stay as " +
      "they are and are taken to be those of " + to.name + ".");
  }
  else if (transformed && !from.vertical && !from.geographic && !to.geographic &&
    std::abs(from.unitLength / to.unitLength - 1.0) > 1e-3)
  {
    findings_.push_back(path + ": " + from.name + " names no system of heights; they stay as " +
      "they are, although x and y get another unit. A compound system (EPSG:a+b) converts them.");
  }
}

Result<ProjectionPass::Way> ProjectionPass::wayFrom(const std::string& path,
  const CoordinateSystem& from, const CoordinateSystem& to, const Bounds& where) const
{
  Way way;
  way.same = known_.equivalent(from, to, !from.vertical || !to.vertical);
  if (way.same)
  {
    return way;
  }
  Result<std::unique_ptr<CoordinateTransform>> made = known_.transform(from, to, where);
  if (!made)
  {
    return makeError(made.error().kind, path + ": " + made.error().what);
  }
  way.transform = std::move(*made);
  const std::vector<std::string>& doubts = way.transform->warnings();
  findings_.insert(findings_.end(), doubts.begin(), doubts.end());
  return way;
}

Result<std::vector<ProjectionPass::Way>> ProjectionPass::waysTo(const CoordinateSystem& target,
  const PointSources& sources, const std::vector<Known>& systems) const
{
  std::map<std::string, Bounds> extents; // box of all points of each system: one choice for all
  for (std::size_t s = 0; s < sources.size(); ++s)
  {
    if (systems[s])
    {
      extents[systems[s]->wkt].add(sources[s]->description().declaredBounds);
    }
  }
  std::map<std::string, Way> found;
  std::vector<Way> ways(sources.size());
  for (std::size_t s = 0; s < sources.size(); ++s)
  {
    if (!systems[s])
    {
      continue;
    }
    const std::string& path = sources[s]->description().path;
    auto known = found.find(systems[s]->wkt);
    if (known == found.end())
    {
      Result<Way> way = wayFrom(path, *systems[s], target, extents[systems[s]->wkt]);
      if (!way)
      {
        return way.error();
      }
      known = found.emplace(systems[s]->wkt, std::move(*way)).first;
    }
    ways[s] = known->second;
    warnOfHeights(path, *systems[s], target, !ways[s].same);
  }
  return ways;
}

Result<PointSources> ProjectionPass::inOneSystem(
  PointSources sources, const std::vector<Known>& systems, const CoordinateSystem& target) const
{
  const Result<std::vector<Way>> ways = waysTo(target, sources, systems);
  if (!ways)
  {
    return ways.error();
  }
  std::vector<SourceDescription> descriptions;
  std::optional<QuantisationGrid> resident; // grid of the first input that is in the target already
  Bounds extent;
  for (std::size_t s = 0; s < sources.size(); ++s)
  {
    descriptions.push_back(sources[s]->description());
    SourceDescription& description = descriptions[s];
    const Way& way = ways.value()[s];
    if (way.same && !resident)
    {
      resident = description.grid;
    }
    if (!way.transform)
    {
      continue;
    }
    if (Result<void> done = moveDescription(description, *way.transform); !done)
    {
      return makeError(done.error().kind, description.path + ": " + done.error().what);
    }
    if (!description.declaredBounds.empty())
    {
      extent.add(description.declaredBounds);
    }
  }
  for (std::size_t s = 0; s < sources.size(); ++s)
  {
    SourceDescription& description = descriptions[s];
    const Way& way = ways.value()[s];
    if (!systems[s])
    {
      continue;
    }
    description.crsWkt = target.wkt;
    if (way.transform)
    {
      description.grid = transformedGrid(description, *systems[s], target, extent, resident);
    }
    else if (!description.grid && target.geographic)
    {
      description.grid = QuantisationGrid{ { angularStep, angularStep, lengthStep }, {} };
    }
    if (way.transform || systems[s]->assumed) // the records tell another system
    {
      dropProjectionRecords(description.metadata);
    }
    sources[s] = std::make_unique<ReferencedSource>(
      std::move(sources[s]), std::move(description), way.transform);
  }
  return sources;
}

void ProjectionPass::warnOfDegrees(const PointSources& sources, const std::vector<Known>& systems,
  const std::optional<CoordinateSystem>& target) const
{
  if (target && target->geographic)
  {
    findings_.push_back("The coordinates are longitudes and latitudes (" + target->name +
      "): distances and levels of detail mix degrees with heights. " + options_.targetName +
      " utm transforms them to metres, as does " + options_.targetName +
      " with any projected system.");
    return;
  }
  for (std::size_t s = 0; s < sources.size(); ++s)
  {
    if (!systems[s] && looksLikeDegrees(sources[s]->description()))
    {
      findings_.push_back(sources[s]->description().path +
        ": the coordinates look like longitudes "
        "and latitudes. If they are, " +
        options_.assumedName + " EPSG:4326 and " + options_.targetName +
        " utm transform them to metres.");
    }
  }
}

Result<PointSources> ProjectionPass::apply(PointSources sources, const PassResources&) const
{
  findings_.clear();
  if (sources.empty())
  {
    return sources;
  }
  Result<std::vector<Known>> systems = systemsOf(sources);
  if (!systems)
  {
    return systems.error();
  }
  const Result<std::optional<CoordinateSystem>> target = chooseTarget(sources, *systems);
  if (!target)
  {
    return target.error();
  }
  warnOfDegrees(sources, *systems, *target);
  if (!*target)
  {
    if (findings_.empty() && options_.inputsMayName)
    {
      findings_.push_back("No input says which coordinate reference system it is in, so the store "
                          "says none either. Name it with " +
        options_.assumedName + " if you know it.");
    }
    return sources;
  }
  return inOneSystem(std::move(sources), *systems, **target);
}

} // namespace pointfront
