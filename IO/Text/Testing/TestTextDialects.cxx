#include "PointValues.h"
#include "TextFormat.h"

#include <gtest/gtest.h>
#include <zlib.h>

namespace pointfront::test
{
namespace
{
std::unique_ptr<PointSource> openDialect(const std::string& text, const TextChoice& choice = {})
{
  return openPoints(TextFormat({}, {}, choice), writeFile("points.txt", text));
}

std::string refusalOf(const std::string& text)
{
  const auto source = TextFormat().open(writeFile("points.txt", text));
  return source ? "" : source.error().what;
}

const std::vector<glm::dvec3> threePoints = { { 1.5, -2.25, 10 }, { 4, 5.5, 6 }, { 7.25, 8, 9.5 } };

void expectThreePoints(const PointSource* source)
{
  ASSERT_TRUE(source != nullptr);
  const PointBatch all = readPoints(*source);
  EXPECT_EQ(all.positions, threePoints);
}

TEST(TextDialect, DecimalCommasStandWithAnySeparator)
{
  for (const char* separator : { " ", "\t", ";", "  ", " ; " })
  {
    SCOPED_TRACE(separator);
    const std::string s = separator;
    const std::string rows =
      "1,5" + s + "-2,25" + s + "10\n4" + s + "5,5" + s + "6\n7,25" + s + "8" + s + "9,5\n";
    expectThreePoints(openDialect(rows).get());
    expectThreePoints(openDialect("X" + s + "Y" + s + "Z\n" + rows).get());
  }
  expectThreePoints(
    openDialect("\"1,5\",\"-2,25\",\"10\"\n\"4\",\"5,5\",\"6\"\n\"7,25\",\"8\",\"9,5\"\n").get());
}

TEST(TextDialect, IsWhatTheUserSays)
{
  const std::string both = "1,5 2,5 3,5\n4,5 5,5 6,5\n"; // with commas between: 1 and "5 2" ...
  EXPECT_EQ(readPoints(*openDialect(both)).positions[0], glm::dvec3(1.5, 2.5, 3.5));
  TextChoice choice;
  choice.decimalPoint = ',';
  EXPECT_EQ(
    readPoints(*openDialect("1,2;3,4;5,6\n", choice)).positions[0], glm::dvec3(1.2, 3.4, 5.6));
  choice = {};
  choice.separator = ';';
  EXPECT_FALSE(TextFormat({}, {}, choice).open(writeFile("points.txt", "1 2 3\n")));
  choice = {};
  choice.skip = 2;
  const auto skipped = openDialect("9 9 9\n8 8 8\nx y z\n1 2 3\n", choice);
  ASSERT_TRUE(skipped);
  ASSERT_EQ(skipped->description().pointCount, 1u);
  EXPECT_EQ(readPoints(*skipped).positions[0], glm::dvec3(1, 2, 3));
}

TEST(TextEncoding, IsOneOfThoseThatSpreadsheetsWrite)
{
  const std::string text = "X;Y;Z;H\xf6he\n1,5;-2,25;10;1\n4;5,5;6;2\n7,25;8;9,5;3\n"; // latin-1
  const auto latin = openDialect(text);
  expectThreePoints(latin.get());
  EXPECT_EQ(schemaText(*latin), "H\xc3\xb6he uint8");
  const std::string utf8 = "X;Y;Z;H\xc3\xb6he\n1,5;-2,25;10;1\n4;5,5;6;2\n7,25;8;9,5;3\n";
  const auto marked = openDialect("\xef\xbb\xbf" + utf8);
  expectThreePoints(marked.get());
  EXPECT_EQ(schemaText(*marked), "H\xc3\xb6he uint8");
  for (const bool big : { false, true })
  {
    for (const bool mark : { false, true })
    {
      std::string utf16;
      const auto put = [&](unsigned unit)
      {
        const char low = static_cast<char>(unit & 0xff);
        const char high = static_cast<char>(unit >> 8);
        utf16 += big ? std::string{ high, low } : std::string{ low, high };
      };
      if (mark)
      {
        put(0xfeff);
      }
      for (const char c : text)
      {
        put(static_cast<unsigned char>(c));
      }
      const auto wide = openDialect(utf16);
      expectThreePoints(wide.get());
      EXPECT_EQ(schemaText(*wide), "H\xc3\xb6he uint8");
      EXPECT_TRUE(TextFormat().accepts(writeFile("points.txt", utf16)));
    }
  }
}

TEST(TextEncoding, OfGzipIsUnpacked)
{
  const std::string path = writeFile("points.xyz.gz", "");
  const std::string text = "1.5 -2.25 10\n4 5.5 6\n7.25 8 9.5\n";
  gzFile packed = ::gzopen(path.c_str(), "wb");
  ::gzwrite(packed, text.data(), static_cast<unsigned>(text.size()));
  ::gzclose(packed);
  EXPECT_TRUE(TextFormat().accepts(path));
  expectThreePoints(openPoints(TextFormat(), path).get());
  const std::string bytes = bytesOfFile(path);
  for (std::size_t cut = 3; cut < bytes.size(); ++cut)
  {
    const auto part = TextFormat().open(writeFile("part.xyz.gz", bytes.substr(0, cut)));
    EXPECT_FALSE(part) << cut;
  }
  const auto nowhere = TextFormat({}, {}, {}, "/no/such/folder").open(path);
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().kind, Error::Kind::Unwritable);
}

TEST(TextNames, AreThoseThatPeopleWrite)
{
  for (const char* header :
    { "lon,lat,height", "Lon,Lat,H", "E,N,H", "e,n,elev", "POINT_X,POINT_Y,POINT_Z",
      "Points:0,Points:1,Points:2", "X (m),Y (m),Z (m)", "X[m],Y[m],Z[m]", "x_m,y_m,z_m",
      "Easting(m),Northing(m),Elevation (ft)", "Longitude [deg],Latitude [deg],Altitude [m]",
      "\"X\",\"Y\",\"Z\"", "Rechtswert,Hochwert,H", "x_coord,y_coord,z_coord" })
  {
    SCOPED_TRACE(header);
    const auto source = openDialect(std::string(header) +
      ",Intensity\n1.5,-2.25,10,1\n4,5.5,6,2\n"
      "7.25,8,9.5,3\n");
    expectThreePoints(source.get());
    EXPECT_EQ(schemaText(*source), "intensity uint16");
    EXPECT_TRUE(source->description().warnings.empty());
  }
  const auto lat = openDialect("lat,lon,h\n-2.25,1.5,10\n5.5,4,6\n8,7.25,9.5\n");
  expectThreePoints(lat.get());
  // The surest name is the coordinate; what else may be one stays an attribute.
  const auto both = openDialect("x,y,z,height,n\n1.5,-2.25,10,5,1\n4,5.5,6,5,1\n7.25,8,9.5,5,1\n");
  expectThreePoints(both.get());
  EXPECT_EQ(schemaText(*both), "height uint8, n uint8");
}

TEST(TextRowsThatAreNone, ShiftNoColumns)
{
  const auto first = openDialect("n/a 2 3 4\n1.5 -2.25 10 1\n4 5.5 6 2\n7.25 8 9.5 3\n");
  ASSERT_TRUE(first);
  const PointBatch all = readPoints(*first);
  ASSERT_EQ(all.size(), 4u);
  EXPECT_TRUE(std::isnan(all.positions[0].x));
  EXPECT_EQ(all.positions[1], threePoints[0]);
  const auto inside = openDialect("1.5,-2.25,10\n,,\n4,5.5,6\nno,data,here\n7.25,8,9.5\n");
  ASSERT_TRUE(inside);
  EXPECT_EQ(inside->description().pointCount, 5u);
  ASSERT_EQ(inside->description().warnings.size(), 1u);
  EXPECT_NE(inside->description().warnings[0].find("2 of 5"), std::string::npos);
  EXPECT_NE(refusalOf("1 2 3\n1 2 3\nx\nx\nx\ny\n"), "");
}

TEST(TextHeight, IsNotLeftOut)
{
  const std::string said = refusalOf("x,y,depth\n1,2,3\n");
  EXPECT_NE(said.find("'depth'"), std::string::npos) << said;
  EXPECT_NE(said.find("--columns"), std::string::npos);
  const auto flat = openDialect("x,y,intensity\n1,2,3\n");
  ASSERT_TRUE(flat);
  EXPECT_NE(flat->description().warnings[0].find("no z"), std::string::npos);
}

TEST(TextGrid, HasAStepForEachAxis)
{
  const auto source = openDialect(
    "lon,lat,h\n7.123456789,50.1,450.25\n8.5,51.123456789,1.5\n7.000000001,50.5,3000.75\n");
  ASSERT_TRUE(source);
  const auto& grid = source->description().grid;
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->scale, glm::dvec3(1e-9, 1e-9, 0.01));
}

TEST(TextGrid, DoesNotSeeWhatIsNoPosition)
{
  const auto source = openDialect("1.25 2 3\n1e300 2 3\n4 5 6.125\n");
  ASSERT_TRUE(source);
  EXPECT_EQ(source->description().declaredBounds.high, glm::dvec3(4, 5, 6.125));
  EXPECT_EQ(source->description().grid->scale, glm::dvec3(0.001));
  const auto far = openDialect("0.001 2 3\n1e12 2 3\n4 5 6.125\n"); // no step of 32 bits
  ASSERT_TRUE(far);
  EXPECT_FALSE(far->description().grid);
}
} // namespace
} // namespace pointfront::test
