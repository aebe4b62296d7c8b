#include "MapGeometry.h"

#include "GeoJSON.h"
#include "KnownSystems.h"

#include "pointfront/Query/WellKnownText.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <locale>
#include <sstream>
#include <utility>

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

/// Half the way around the globe in longitudes of the system; infinite where x is a length.
double halfTurn(const CoordinateSystem& system)
{
  return system.geographic ? glm::pi<double>() / system.unitLength
                           : std::numeric_limits<double>::infinity();
}

/// Whether an edge is longer than half the way around the globe, without being the edge of all of
/// it. Whoever drew it meant the short way, across the antimeridian, or drew few vertices.
bool takesTheLongWay(double fromX, double toX, double half)
{
  constexpr double slack = 1e-9;
  const double length = std::abs(toX - fromX);
  return length > half * (1.0 + slack) && length < 2.0 * half * (1.0 - slack);
}

Result<void> checkAntimeridian(PlanarGeometry& geometry, const CoordinateSystem& system)
{
  Result<void> sound;
  const double half = halfTurn(system);
  forEachLine(geometry,
    [&](const PlanarLine& line)
    {
      for (std::size_t i = 1; sound && i < line.size(); ++i)
      {
        if (takesTheLongWay(line[i - 1].x, line[i].x, half))
        {
          std::ostringstream text;
          text.imbue(std::locale::classic());
          text << "an edge goes from longitude " << line[i - 1].x << " to " << line[i].x
               << ", more than half around the globe: if it crosses the antimeridian, cut it there "
                  "into two parts, as RFC 7946 says (3.1.9); if not, add a vertex between";
          sound = makeError(Error::Kind::BadArgument, text.str());
        }
      }
    });
  return sound;
}

/// Longitudes that a transformation brought back to the other end of its range go on instead.
void unwind(PlanarGeometry& geometry, double half)
{
  forEachLine(geometry,
    [half](PlanarLine& line)
    {
      for (std::size_t i = 1; i < line.size(); ++i)
      {
        const double step = line[i].x - line[i - 1].x;
        line[i].x -=
          std::abs(step) < 2.0 * half ? 2.0 * half * std::round(step / (2.0 * half)) : 0.0;
      }
    });
}

/// A longitude and the same after a turn are one place: adds what lies in the store's longitudes
/// after a turn to either side.
void addTurns(PlanarGeometry& geometry, const Bounds& store, double half)
{
  const auto moved = [&store](PlanarLine line, double turn)
  {
    Bounds bounds;
    for (glm::dvec2& v : line)
    {
      v.x += turn;
      bounds.add(glm::dvec3(v, 0.0));
    }
    const bool meets =
      !bounds.empty() && bounds.low.x <= store.high.x && bounds.high.x >= store.low.x;
    return meets ? line : PlanarLine();
  };
  PlanarGeometry added;
  for (const double turn : { -2.0 * half, 2.0 * half })
  {
    for (const PlanarLine& line : geometry.lines)
    {
      added.lines.push_back(moved(line, turn));
    }
    for (const PlanarPolygon& polygon : geometry.polygons)
    {
      PlanarPolygon& copy = added.polygons.emplace_back();
      for (const PlanarLine& ring : polygon.rings)
      {
        copy.rings.push_back(moved(ring, turn));
      }
    }
  }
  for (PlanarLine& line : added.lines)
  {
    if (!line.empty())
    {
      geometry.lines.push_back(std::move(line));
    }
  }
  for (PlanarPolygon& polygon : added.polygons)
  {
    auto& rings = polygon.rings;
    if (!rings.empty() && !rings.front().empty())
    {
      rings.erase(std::remove_if(rings.begin(), rings.end(),
                    [](const PlanarLine& ring) { return ring.empty(); }),
        rings.end());
      geometry.polygons.push_back(std::move(polygon));
    }
  }
}

Result<void> apply(const CoordinateTransform& transform, PlanarGeometry& geometry)
{
  Result<void> done;
  forEachLine(geometry,
    [&](PlanarLine& line)
    {
      std::vector<glm::dvec3> vertices;
      std::transform(line.begin(), line.end(), std::back_inserter(vertices),
        [](const glm::dvec2& v) { return glm::dvec3(v, 0.0); });
      Result<void> moved = transform.apply(vertices.data(), vertices.size());
      done = done ? moved : done;
      std::transform(vertices.begin(), vertices.end(), line.begin(),
        [](const glm::dvec3& v) { return glm::dvec2(v); });
    });
  return done;
}

Result<void> transformTo(
  const StoreDescription& store, PlanarGeometry& geometry, std::vector<std::string>& notes)
{
  const std::shared_ptr<const CoordinateSystems> known = knownSystems();
  const Result<CoordinateSystem> to = known->parse(store.crsWkt);
  const Result<CoordinateSystem> from = geometry.crs.empty() ? to : known->parse(geometry.crs);
  if (!from || !to)
  {
    return geometry.crs.empty() ? Result<void>() : !from ? from.error() : to.error();
  }
  if (Result<void> sound = checkAntimeridian(geometry, *from); !sound)
  {
    return sound;
  }
  if (!known->equivalent(*from, *to, true))
  {
    const auto transform = known->transform(*from, *to, boundsOf(geometry));
    if (!transform)
    {
      return transform.error();
    }
    if (Result<void> done = apply(**transform, geometry); !done)
    {
      return done;
    }
    const std::vector<std::string>& doubts = (*transform)->warnings();
    notes.insert(notes.end(), doubts.begin(), doubts.end());
    if (to->geographic)
    {
      unwind(geometry, halfTurn(*to));
    }
  }
  if (to->geographic)
  {
    addTurns(geometry, store.bounds, halfTurn(*to));
  }
  return {};
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
  if (!store.crsWkt.empty())
  {
    if (Result<void> done = transformTo(store, *geometry, notes); !done)
    {
      return makeError(done.error().kind, path + ": " + done.error().what);
    }
  }
  return geometry;
}

} // namespace pointfront
