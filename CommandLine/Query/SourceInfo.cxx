#include "SourceInfo.h"

#include "ByteSize.h"
#include "CloudFacts.h"
#include "SystemName.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace pointfront
{

namespace
{
SourceInfo described(const PointSource& source)
{
  SourceInfo info;
  info.description = source.description();
  std::error_code failure;
  const std::uintmax_t bytes = std::filesystem::file_size(info.description.path, failure);
  info.fileBytes = failure ? 0 : bytes;
  return info;
}

/// A header may round to its own step.
glm::dvec3 rounding(const Bounds& counted, const std::optional<QuantisationGrid>& grid)
{
  const glm::dvec3 reach = glm::max(glm::abs(counted.low), glm::abs(counted.high));
  return 1e-15 * reach + (grid ? 0.5 * grid->scale : glm::dvec3(0.0));
}

Bounds grown(const Bounds& bounds, const glm::dvec3& by)
{
  return { bounds.low - by, bounds.high + by };
}

bool inside(const Bounds& inner, const Bounds& outer)
{
  return outer.contains(inner.low) && outer.contains(inner.high);
}

const char* origin(bool header)
{
  return header ? " (from the header)" : " (counted)";
}

bool hasProjectionRecords(const SourceDescription& source)
{
  return std::any_of(source.metadata.begin(), source.metadata.end(),
    [](const MetadataRecord& record) { return record.owner == "LASF_Projection"; });
}
} // namespace

Result<SourceInfo> SourceInfo::of(const PointSource& source, const ScanOptions& options)
{
  SourceInfo info = described(source);
  if (!info.headerBounds())
  {
    const Result<PointCount> counted = countPoints(source, options);
    if (!counted)
    {
      return counted.error();
    }
    info.counted = *counted;
  }
  return info;
}

SourceInfo SourceInfo::of(const PointSource& source, const PointStatistics& statistics)
{
  SourceInfo info = described(source);
  info.counted = statistics.counted;
  return info;
}

std::uint64_t SourceInfo::points() const
{
  return counted ? counted->read : description.pointCount;
}

Bounds SourceInfo::bounds() const
{
  return counted ? counted->bounds : description.declaredBounds;
}

std::optional<Bounds> SourceInfo::headerBounds() const
{
  const Bounds& declared = description.declaredBounds;
  return description.boundsLookedUp || declared.empty() ? std::nullopt
                                                        : std::optional<Bounds>(declared);
}

bool SourceInfo::boundsDiffer() const
{
  const std::optional<Bounds> header = headerBounds();
  if (!counted || counted->points == 0 || !header)
  {
    return false;
  }
  const glm::dvec3 by = rounding(counted->bounds, description.grid);
  return !inside(counted->bounds, grown(*header, by)) ||
    !inside(*header, grown(counted->bounds, by));
}

bool SourceInfo::pointsFromHeader() const
{
  return !counted && description.headerPointCount == description.pointCount;
}

std::vector<std::string> SourceInfo::warnings() const
{
  std::vector<std::string> all = description.warnings;
  if (!counted)
  {
    return all;
  }
  if (counted->read != description.pointCount)
  {
    all.push_back(std::to_string(description.pointCount) + " points were announced, " +
      std::to_string(counted->read) + " were read.");
  }
  const std::optional<Bounds> header = headerBounds();
  if (header && counted->points > 0 &&
    !inside(counted->bounds, grown(*header, rounding(counted->bounds, description.grid))))
  {
    all.push_back("Points lie outside of the header's bounds, " + boundsText(*header) +
      ": those of the points are " + boundsText(counted->bounds) + ".");
  }
  if (!counted->rejected.empty())
  {
    all.push_back(
      "Some points are no positions, and a build leaves them out: " + rejectedText(*counted) + ".");
  }
  return all;
}

nlohmann::ordered_json sourceJson(const SourceInfo& info)
{
  const SourceDescription& source = info.description;
  const nlohmann::ordered_json none;
  nlohmann::ordered_json object;
  object["path"] = source.path;
  object["format"] = source.format;
  object["points"] = info.points();
  object["bounds"] = boundsJson(info.bounds());
  object["precision"] = source.grid
    ? nlohmann::ordered_json(
        std::max({ source.grid->scale.x, source.grid->scale.y, source.grid->scale.z }))
    : none;
  object["crs"] = source.crsWkt.empty() ? none : nlohmann::ordered_json(source.crsWkt);
  for (const char* key : { "structure", "refinement", "nodes", "levels" })
  {
    object[key] = none;
  }
  object["bytes"] = info.fileBytes;
  object["attributes"] = attributesJson(source.schema);
  object["layers"] = nlohmann::ordered_json::array();
  object["version"] = none;
  object["from_header"] = nlohmann::ordered_json::array();
  if (info.pointsFromHeader())
  {
    object["from_header"].push_back("points");
  }
  if (info.boundsFromHeader())
  {
    object["from_header"].push_back("bounds");
  }
  object["header"] = {
    { "points", source.headerPointCount ? nlohmann::ordered_json(*source.headerPointCount) : none },
    { "bounds", boundsJson(info.headerBounds().value_or(Bounds())) }
  };
  if (info.counted)
  {
    object["points_rejected"] = rejectedJson(*info.counted);
  }
  object["warnings"] = info.warnings();
  if (source.grid)
  {
    const QuantisationGrid& grid = *source.grid;
    object["grid"] = { { "scale", { grid.scale.x, grid.scale.y, grid.scale.z } },
      { "offset", { grid.offset.x, grid.offset.y, grid.offset.z } } };
  }
  return object;
}

std::string sourceText(const SourceInfo& info)
{
  const SourceDescription& source = info.description;
  std::ostringstream text;
  text.precision(15);
  const bool told = source.headerPointCount && *source.headerPointCount != info.points();
  text << source.path << "\n  format      " << source.format << "\n  points      " << info.points()
       << origin(info.pointsFromHeader());
  if (told)
  {
    text << "; the header claims " << *source.headerPointCount;
  }
  text << "\n  bounds      " << boundsText(info.bounds()) << origin(info.boundsFromHeader());
  if (info.boundsDiffer())
  {
    text << "; the header claims " << boundsText(*info.headerBounds());
  }
  text << "\n  precision   ";
  if (source.grid)
  {
    const glm::dvec3& scale = source.grid->scale;
    text << scale.x << ' ' << scale.y << ' ' << scale.z;
  }
  else
  {
    text << "floating point";
  }
  text << "\n  crs         "
       << (!source.crsWkt.empty()            ? systemName(source.crsWkt)
              : hasProjectionRecords(source) ? systemName(GeoKeys::parse(source.metadata))
                                             : "not known")
       << "\n  file        " << byteSizeText(info.fileBytes) << " (" << info.fileBytes
       << " bytes)\n  attributes  " << attributesText(source.schema);
  return text.str();
}

} // namespace pointfront
