#include "MapGeometry.h"

#include "GeoJSON.h"
#include "KnownSystems.h"

#include "pointfront/Query/WellKnownText.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

namespace pointfront
{
namespace
{

constexpr const char* longitudeAndLatitude = "OGC:CRS84";

/// All lines of the geometry: rings too.
template <typename Function>
void forEachLine(PlanarGeometry& geometry, const Function& function)
{
  for (PlanarPolygon& polygon : geometry.polygons)
  {
    std::for_each(polygon.rings.begin(), polygon.rings.end(), function);
  }
  std::for_each(geometry.lines.begin(), geometry.lines.end(), function);
}

bool maybeDegrees(PlanarGeometry& geometry)
{
  bool degrees = true;
  forEachLine(geometry,
    [&degrees](const PlanarLine& line)
    {
      degrees = degrees &&
        std::all_of(line.begin(), line.end(),
          [](const glm::dvec2& v) { return std::abs(v.x) <= 180.0 && std::abs(v.y) <= 90.0; });
    });
  return degrees;
}

Bounds boundsOf(PlanarGeometry& geometry)
{
  Bounds bounds;
  forEachLine(geometry,
    [&bounds](const PlanarLine& line)
    {
      for (const glm::dvec2& v : line)
      {
        bounds.add(glm::dvec3(v, 0.0));
      }
    });
  return bounds;
}

Result<void> transformTo(
  const std::string& wkt, PlanarGeometry& geometry, std::vector<std::string>& notes)
{
  const std::shared_ptr<const CoordinateSystems> known = knownSystems();
  const Result<CoordinateSystem> from = known->parse(geometry.crs);
  const Result<CoordinateSystem> to = known->parse(wkt);
  if (!from || !to)
  {
    return !from ? from.error() : to.error();
  }
  if (known->equivalent(*from, *to, true))
  {
    return {};
  }
  const auto transform = known->transform(*from, *to, boundsOf(geometry));
  if (!transform)
  {
    return transform.error();
  }
  Result<void> done;
  forEachLine(geometry,
    [&](PlanarLine& line)
    {
      std::vector<glm::dvec3> vertices;
      std::transform(line.begin(), line.end(), std::back_inserter(vertices),
        [](const glm::dvec2& v) { return glm::dvec3(v, 0.0); });
      Result<void> moved = (*transform)->apply(vertices.data(), vertices.size());
      done = done ? moved : done;
      std::transform(vertices.begin(), vertices.end(), line.begin(),
        [](const glm::dvec3& v) { return glm::dvec2(v); });
    });
  const std::vector<std::string>& doubts = (*transform)->warnings();
  notes.insert(notes.end(), doubts.begin(), doubts.end());
  return done;
}

} // namespace

Result<PlanarGeometry> readMapGeometry(
  const std::string& path, const StoreDescription& store, std::vector<std::string>& notes)
{
  std::ifstream file(path, std::ios::binary);
  std::ostringstream content;
  if (!file || !(content << file.rdbuf()))
  {
    return makeError(Error::Kind::Unreadable, path + ": cannot read the file");
  }
  const std::string text = content.str();
  const std::size_t first = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  const bool json = first != std::string::npos && text[first] == '{';
  Result<PlanarGeometry> geometry = json ? parseGeoJSON(text) : parseWellKnownText(text);
  if (!geometry)
  {
    return makeError(geometry.error().kind, path + ": " + geometry.error().what);
  }
  if (json && geometry->crs.empty() && !store.crsWkt.empty() && maybeDegrees(*geometry))
  {
    geometry->crs = longitudeAndLatitude;
    notes.push_back(path +
      ": taken as longitudes and latitudes (WGS 84), as GeoJSON without a "
      "\"crs\" is");
  }
  if (!geometry->crs.empty() && !store.crsWkt.empty())
  {
    if (Result<void> done = transformTo(store.crsWkt, *geometry, notes); !done)
    {
      return makeError(done.error().kind, path + ": " + done.error().what);
    }
  }
  return geometry;
}

} // namespace pointfront
