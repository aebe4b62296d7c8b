#include "GeoJSON.h"

#include "JSONText.h"

#include "pointfront/Base/NearestName.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <string>
#include <utility>

namespace pointfront
{
namespace
{

using nlohmann::json;

constexpr int deepestCollection = 16;

/// Reads a document; a function that meets something else than it expects notes the first fault
/// and gives false.
class Reader
{
public:
  bool object(const json& value, const std::string& place, int depth);
  PlanarGeometry geometry;
  std::string fault;
  const json* faulty = nullptr; ///< the value that the fault is of

private:
  bool fail(const json& value, const std::string& place, const std::string& what)
  {
    if (fault.empty())
    {
      faulty = &value;
      fault = (place.empty() ? std::string("the document") : place) + " " + what;
    }
    return false;
  }
  /// Calls item(value, place) for each entry of an array.
  template <typename Item>
  bool each(const json& list, const std::string& place, Item item)
  {
    if (!list.is_array())
    {
      return fail(list, place, "is no list");
    }
    for (std::size_t i = 0; i < list.size(); ++i)
    {
      if (!item(list[i], place + "[" + std::to_string(i) + "]"))
      {
        return false;
      }
    }
    return true;
  }
  bool member(const json& value, const std::string& place, const char* name, int depth);
  bool reference(const json& value, const std::string& place);
  bool line(const json& value, const std::string& place, PlanarLine& vertices);
  bool addLine(const json& value, const std::string& place);
  bool addPolygon(const json& value, const std::string& place);
};

bool Reader::line(const json& value, const std::string& place, PlanarLine& vertices)
{
  return each(value, place,
    [&](const json& position, const std::string& here)
    {
      if (!position.is_array() || position.size() < 2 || !position[0].is_number() ||
        !position[1].is_number())
      {
        return fail(position, here, "is no position of two numbers");
      }
      vertices.emplace_back(position[0].get<double>(), position[1].get<double>());
      return (std::isfinite(vertices.back().x) && std::isfinite(vertices.back().y)) ||
        fail(position, here, "is not finite");
    });
}

bool Reader::addLine(const json& value, const std::string& place)
{
  PlanarLine vertices;
  if (!line(value, place, vertices))
  {
    return false;
  }
  if (!vertices.empty())
  {
    geometry.lines.push_back(std::move(vertices));
  }
  return true;
}

bool Reader::addPolygon(const json& value, const std::string& place)
{
  PlanarPolygon polygon;
  const bool sound = each(value, place,
    [&](const json& ring, const std::string& here)
    {
      PlanarLine vertices;
      if (!line(ring, here, vertices))
      {
        return false;
      }
      if (vertices.size() < 4 || vertices.front() != vertices.back())
      {
        return fail(
          ring, here, "has fewer than four vertices, or does not return to its first one");
      }
      polygon.rings.push_back(std::move(vertices));
      return true;
    });
  geometry.polygons.push_back(std::move(polygon));
  return sound;
}

bool Reader::reference(const json& value, const std::string& place)
{
  // {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}}; null: not known.
  if (value.is_null())
  {
    return true;
  }
  const json::json_pointer name("/properties/name");
  if (!value.is_object() || !value.contains(name) || !value.at(name).is_string())
  {
    return fail(value, place, "names no coordinate reference system");
  }
  geometry.crs = value.at(name).get<std::string>();
  return true;
}

bool Reader::member(const json& value, const std::string& place, const char* name, int depth)
{
  const std::string here = place.empty() ? name : place + "." + name;
  if (!value.contains(name))
  {
    return fail(value, here, "is missing");
  }
  return value.at(name).is_array()
    ? each(value.at(name), here,
        [&](const json& one, const std::string& at) { return object(one, at, depth + 1); })
    : object(value.at(name), here, depth + 1);
}

bool Reader::object(const json& value, const std::string& place, int depth)
{
  if (!value.is_object() || !value.contains("type") || !value.at("type").is_string())
  {
    return fail(value, place, "is no GeoJSON object with a \"type\"");
  }
  if (depth > deepestCollection)
  {
    return fail(value, place, "lies too deep");
  }
  if (value.contains("crs") && !reference(value.at("crs"), place + "crs"))
  {
    return false;
  }
  const std::string type = value.at("type").get<std::string>();
  if (type == "FeatureCollection")
  {
    return member(value, place, "features", depth);
  }
  if (type == "Feature")
  {
    const bool unlocated = value.contains("geometry") && value.at("geometry").is_null();
    return unlocated || member(value, place, "geometry", depth);
  }
  if (type == "GeometryCollection")
  {
    return member(value, place, "geometries", depth);
  }
  const std::string here = place.empty() ? "coordinates" : place + ".coordinates";
  const json none = json::array();
  const json& coordinates = value.contains("coordinates") ? value.at("coordinates") : none;
  const auto lineOf = [this](const json& one, const std::string& at) { return addLine(one, at); };
  const auto polygonOf = [this](const json& one, const std::string& at)
  { return addPolygon(one, at); };
  return type == "Polygon"   ? addPolygon(coordinates, here)
    : type == "MultiPolygon" ? each(coordinates, here, polygonOf)
    : type == "LineString"   ? addLine(coordinates, here)
    : type == "MultiLineString"
    ? each(coordinates, here, lineOf)
    : fail(value, place,
        "is a " + type + ": neither an area nor a line" +
          didYouMean(type,
            { "FeatureCollection", "Feature", "GeometryCollection", "Polygon", "MultiPolygon",
              "LineString", "MultiLineString" }));
}

} // namespace

Result<PlanarGeometry> parseGeoJSON(const std::string& text)
{
  const Result<JSONText> document = JSONText::parse(text);
  if (!document)
  {
    return document.error();
  }
  Reader reader;
  if (!reader.object(document->value(), "", 0))
  {
    return makeError(Error::Kind::BadFormat,
      "not GeoJSON of areas or lines: " + document->lineOf(*reader.faulty) + reader.fault);
  }
  return std::move(reader.geometry);
}

} // namespace pointfront
