#include "pointfront/Query/WellKnownText.h"

#include <gtest/gtest.h>

#include <string>

namespace pointfront
{
namespace
{

PlanarGeometry parsed(const std::string& text)
{
  const auto geometry = parseWellKnownText(text);
  EXPECT_TRUE(geometry) << geometry.error().what;
  return geometry ? *geometry : PlanarGeometry{};
}

std::string faultOf(const std::string& text)
{
  const auto geometry = parseWellKnownText(text);
  EXPECT_FALSE(geometry) << text;
  return geometry ? "" : geometry.error().what;
}

} // namespace

TEST(WellKnownText, AreasWithHolesInAnySpelling)
{
  const PlanarGeometry geometry = parsed(
    "\xef\xbb\xbf polygon ((0 0, 4 0,4 4.5 , 0 0),\n"
    "(1 1,2 1,2 2,1 1))\nMULTIPOLYGON Z (((0 0 7,1 0 7,1 1 7,0 0 7)),((5 5 1,6 5 1,6 6 1,5 5 1)))");
  ASSERT_EQ(geometry.polygons.size(), 3u);
  ASSERT_EQ(geometry.polygons[0].rings.size(), 2u);
  EXPECT_EQ(geometry.polygons[0].rings[0].size(), 4u);
  EXPECT_EQ(geometry.polygons[0].rings[0][2], glm::dvec2(4, 4.5));
  EXPECT_EQ(geometry.polygons[2].rings[0][1], glm::dvec2(6, 5));
  EXPECT_TRUE(geometry.lines.empty());
  EXPECT_TRUE(geometry.crs.empty());
}

TEST(WellKnownText, LinesCollectionsAndEmptyOnes)
{
  const PlanarGeometry geometry =
    parsed("SRID=25832;GEOMETRYCOLLECTION(LINESTRING(1e2 -2, 3 4),"
           "MULTILINESTRINGZM((0 0 1 2,1 1 1 2),EMPTY),POLYGON EMPTY);");
  EXPECT_EQ(geometry.crs, "EPSG:25832");
  ASSERT_EQ(geometry.lines.size(), 2u);
  EXPECT_EQ(geometry.lines[0][0], glm::dvec2(100, -2));
  EXPECT_EQ(geometry.polygons.size(), 1u);
  EXPECT_TRUE(geometry.polygons[0].rings.empty());
  EXPECT_TRUE(parsed("MULTIPOLYGON EMPTY").polygons.empty());
}

TEST(WellKnownText, FaultsAreNamedWithTheirPlace)
{
  EXPECT_NE(faultOf("").find("no geometry at byte 0"), std::string::npos);
  EXPECT_NE(faultOf("POINT (1 2)").find("'POINT'"), std::string::npos);
  EXPECT_NE(faultOf("CIRCULARSTRING (1 2, 3 4, 5 6)").find("'CIRCULARSTRING'"), std::string::npos);
  EXPECT_NE(faultOf("POLYGON ((0 0, 1 0, 1 nan, 0 0))").find("finite"), std::string::npos);
  EXPECT_NE(faultOf("POLYGON ((0 0, 1 0, 1 1e999, 0 0))").find("finite"), std::string::npos);
  EXPECT_NE(faultOf("POLYGON ((0 0, 1 0, 1 1))").find("first one"), std::string::npos);
  EXPECT_NE(faultOf("POLYGON ((0 0, 1 0, 0 0))").find("four"), std::string::npos);
  EXPECT_NE(faultOf("POLYGON (0 0, 1 0, 0 0)").find("'('"), std::string::npos);
  EXPECT_NE(faultOf("LINESTRING (1 2, 3 4").find("')'"), std::string::npos);
  EXPECT_NE(faultOf("LINESTRING (1 2, 3 4) and more").find("'AND'"), std::string::npos);
  EXPECT_NE(faultOf("SRID=1;LINESTRING(1 2,3 4);SRID=2;LINESTRING(1 2,3 4)").find("second SRID"),
    std::string::npos);
  faultOf("SRID=nonsense;LINESTRING(1 2,3 4)");
  std::string deep;
  for (int i = 0; i < 100000; ++i)
  {
    deep += "GEOMETRYCOLLECTION(";
  }
  EXPECT_NE(faultOf(deep).find("GEOMETRYCOLLECTION"), std::string::npos);
}

TEST(WellKnownText, EveryBeginningIsRefusedOrSound)
{
  const std::string text = "SRID=4326;MULTIPOLYGON Z (((0 0 7,1 0 7,1 1 7,0 0 7)),EMPTY)";
  for (std::size_t size = 0; size < text.size(); ++size)
  {
    EXPECT_FALSE(parseWellKnownText(text.substr(0, size))) << size;
  }
  EXPECT_TRUE(parseWellKnownText(text));
}

} // namespace pointfront
