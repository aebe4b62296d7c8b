#include "GeoJSON.h"

#include <gtest/gtest.h>

#include <string>

namespace pointfront
{
namespace
{

const std::string square = R"({"type": "Polygon", "coordinates":
  [[[0, 0], [4, 0], [4, 4.5, 9], [0, 0]], [[1, 1], [2, 1], [2, 2], [1, 1]]]})";

std::string faultOf(const std::string& text)
{
  const auto geometry = parseGeoJSON(text);
  EXPECT_FALSE(geometry) << text;
  return geometry ? "" : geometry.error().what;
}

} // namespace

TEST(GeoJSON, FeaturesAndGeometries)
{
  const auto geometry = parseGeoJSON(R"({"type": "FeatureCollection",
    "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}},
    "features": [{"type": "Feature", "properties": {"a": [1]}, "geometry": )" +
    square + R"(}, {"type": "Feature", "geometry": null}, {"type": "Feature", "geometry":
      {"type": "GeometryCollection", "geometries": [
        {"type": "MultiLineString", "coordinates": [[[1, 2], [3, 4]], [[5, 6], [7, 8]]]},
        {"type": "MultiPolygon", "coordinates": [[[[0, 0], [1, 0], [1, 1], [0, 0]]]]}]}}]})");
  ASSERT_TRUE(geometry) << geometry.error().what;
  EXPECT_EQ(geometry->crs, "urn:ogc:def:crs:EPSG::25832");
  ASSERT_EQ(geometry->polygons.size(), 2u);
  ASSERT_EQ(geometry->polygons[0].rings.size(), 2u);
  EXPECT_EQ(geometry->polygons[0].rings[0][2], glm::dvec2(4, 4.5));
  ASSERT_EQ(geometry->lines.size(), 2u);
  EXPECT_EQ(geometry->lines[1][1], glm::dvec2(7, 8));
}

TEST(GeoJSON, FaultsAreNamedWithTheirPlace)
{
  EXPECT_EQ(faultOf("{").rfind("not JSON: line 1, column ", 0), 0u);
  EXPECT_EQ(faultOf("{\"type\": \"Poligon\",\n\"coordinates\": []}"),
    "not GeoJSON of areas or lines: line 1: the document is a Poligon: neither an area nor a line; "
    "did you mean 'Polygon'?");
  EXPECT_EQ(faultOf("{\"type\": \"LineString\",\n\"coordinates\": [[0, 0],\n [1, \"2\"]]}"),
    "not GeoJSON of areas or lines: line 3: coordinates[1] is no position of two numbers");
  EXPECT_NE(faultOf("[]").find("type"), std::string::npos);
  EXPECT_NE(
    faultOf(R"({"type": "Point", "coordinates": [1, 2]})").find("Point"), std::string::npos);
  EXPECT_NE(faultOf(R"({"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1, 1]]]})")
              .find("coordinates[0]"),
    std::string::npos);
  EXPECT_NE(
    faultOf(R"({"type": "LineString", "coordinates": [[0, 0], [1, "2"]]})").find("coordinates[1]"),
    std::string::npos);
  EXPECT_NE(faultOf(R"({"type": "FeatureCollection"})").find("features"), std::string::npos);
  EXPECT_NE(faultOf(R"({"type": "LineString", "crs": 4, "coordinates": []})").find("crs"),
    std::string::npos);
  std::string deep;
  for (int i = 0; i < 100; ++i)
  {
    deep += R"({"type": "GeometryCollection", "geometries": [)";
  }
  deep += square;
  for (int i = 0; i < 100; ++i)
  {
    deep += "]}";
  }
  EXPECT_NE(faultOf(deep).find("deep"), std::string::npos);
}

TEST(GeoJSON, EveryBeginningIsRefused)
{
  for (std::size_t size = 0; size < square.size(); ++size)
  {
    EXPECT_FALSE(parseGeoJSON(square.substr(0, size))) << size;
  }
  EXPECT_TRUE(parseGeoJSON(square));
}

} // namespace pointfront
