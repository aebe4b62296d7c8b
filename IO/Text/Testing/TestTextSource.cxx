#include "RealPoints.h"
#include "TextFormat.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

namespace pointfront::test
{
namespace
{
std::unique_ptr<PointSource> openText(
  const std::string& text, const std::vector<std::string>& columns = {})
{
  return openPoints(TextFormat(columns), writeFile("points.txt", text));
}

// Counts: MANIFEST.md beside the data.
const RealPoints realFiles[] = { { "text/ripple.txt", 10201, "rgb uint8x3, normal float32x3" },
  { "text/ripple.pts", 10201, "intensity uint16, rgb uint8x3" },
  { "text/ripple.ptx", 10201, "intensity uint16, rgb uint8x3" }, { "text/utm17_1.txt", 10, "" },
  { "text/utm17_2.txt", 10, "" }, { "text/utm17_3.txt", 11, "" },
  { "text/crlf_test.txt", 10, "intensity uint16" }, { "text/quoted.txt", 9, "" },
  { "text/numeric_dim.txt", 5, "Eigenvalue0 uint8" },
  { "text/missingheader.txt", 5, "intensity uint16" },
  { "text/autzen.pts", 10, "intensity int16, rgb uint8x3" },
  { "text/test.pts", 19, "intensity int16, rgb uint8x3" },
  { "text/1.2-with-color.ptx", 1065, "intensity float32, rgb uint8x3" },
  { "text/complex-transform.ptx", 12, "intensity float32, rgb uint8x3", 8 },
  { "text/data.xyz", 400, "" }, { "text/points_agisoft.xyz", 100, "rgb uint8x3" },
  { "text/diamond.xyz", 6, "normal float32x3" } };

TEST(RealTextFile, GivesItsPointsAndAttributes)
{
  const TextFormat format;
  for (const RealPoints& expected : realFiles)
  {
    SCOPED_TRACE(expected.path);
    ASSERT_TRUE(expectRealPoints(format, expected));
  }
}

TEST(RealTextFile, KeepsItsDecimalsOnAGrid)
{
  const auto source = openPoints(TextFormat(), shared("text/crlf_test.txt"));
  ASSERT_TRUE(source);
  ASSERT_TRUE(source->description().grid);
  EXPECT_EQ(source->description().grid->scale, glm::dvec3(0.01));
  EXPECT_EQ(readPoints(*source).positions[0], glm::dvec3(289814.15, 4320978.61, 170.76));
}

TEST(RealTextFile, WithAColumnNamedTwiceIsRefused)
{
  const auto source = TextFormat().open(shared("text/badheader.txt"));
  ASSERT_FALSE(source.ok());
  EXPECT_NE(source.error().what.find("'X' is named twice"), std::string::npos);
  const auto told = openPoints(TextFormat({ "x", "y", "-" }), shared("text/badheader.txt"));
  ASSERT_TRUE(told);
  EXPECT_EQ(readPoints(*told).positions[1], glm::dvec3(0.5, 0.5, 0.0));
}

TEST(TextSeparators, AreFound)
{
  const glm::dvec3 first(1.5, -2.25, 1000.0);
  for (const char* text : { "1.5 -2.25 1e3\n4 5 6\n", "1.5,-2.25,1.0E+3\n4,5,6\n",
         "1.5\t-2.25\t1000\n4\t5\t6\n", "1.5;-2.25;.1e4\n4;5;6\n", "1,5;-2,25;1000,\n4;5;6\n",
         "1,5 -2,25 1000\n4 5 6\n", "  1.5 , -2.25 ,  10D2  \r\n4,5,6", "+1.5\t-2.25 1000\n4 5 6",
         "\"1.5\",\"-2.25\",\"1000\"\n4,5,6\n", "1.5 -2.25 1000\r4 5 6\r" })
  {
    SCOPED_TRACE(text);
    const auto source = openText(text);
    ASSERT_TRUE(source);
    const PointBatch all = readPoints(*source);
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all.positions[0], first);
    EXPECT_EQ(all.positions[1], glm::dvec3(4, 5, 6));
    EXPECT_TRUE(source->description().warnings.empty());
  }
}

TEST(TextHeaders, NameColumnsInAnyOrder)
{
  for (const char* text : { "Classification,Z,Y,X,\"GPS time\"\n2,3,2,1,7.5\n",
         "# made by a program\n# classification z y x gps_time\n2 3 2 1 7.5\n",
         "//Class Z Y X GpsTime\n2 3 2 1 7.5\n", "1\nclass\tz\ty\tx\tgps_time\n2\t3\t2\t1\t7.5\n" })
  {
    SCOPED_TRACE(text);
    const auto source = openText(text);
    ASSERT_TRUE(source);
    const PointBatch all = readPoints(*source);
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all.positions[0], glm::dvec3(1, 2, 3));
    EXPECT_EQ(schemaText(*source), "classification uint8, gps_time float64");
    EXPECT_EQ(columnOf<double>(*source, all, "gps_time"), std::vector<double>{ 7.5 });
  }
}

TEST(TextColumnsOfTheUser, ComeFirst)
{
  const auto source =
    openText("a,b,c,d,e,f,g\n7,1,2,3,10,20,30\n", { "-", "x", "y", "z", "r", "g", "b" });
  ASSERT_TRUE(source);
  const PointBatch all = readPoints(*source);
  EXPECT_EQ(all.positions, std::vector<glm::dvec3>{ glm::dvec3(1, 2, 3) });
  EXPECT_EQ(columnOf<std::uint8_t>(*source, all, "rgb"), (std::vector<std::uint8_t>{ 10, 20, 30 }));
  const auto none = TextFormat({ "a", "b" }).open(writeFile("points.txt", "1 2 3\n"));
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().kind, Error::Kind::BadArgument);
  EXPECT_FALSE(TextFormat({ "x", "y", "z", "i" }).open(writeFile("p.txt", "1 2 3\n")).ok());
}

TEST(TextGuesses, AreToldAndFit)
{
  const std::pair<const char*, const char*> files[] = {
    { "1 2 3 77\n1 2 3 78\n", "intensity uint16" },
    { "1 2 3 10 20 30\n", "rgb uint8x3" },
    { "1 2 3 5 10 20 30\n", "intensity uint16, rgb uint8x3" },
    { "1 2 3 10 20 30 0.25\n", "rgb uint8x3, intensity float32" },
    { "1 2 3 0.6 0.8 0 10 20 300\n", "normal float32x3, rgb uint16x3" },
    { "1 2 3 0.2 0.4 1.0\n1 2 3 0.2 0.8 1.0\n", "rgb uint8x3" },
    { "1 2 3 -4 5\n", "column_4 int8, intensity uint16" },
    { "P1 1 2 3\nP2 1 2 4\n", "" },
  };
  for (const auto& [text, schema] : files)
  {
    SCOPED_TRACE(text);
    const auto source = openText(text);
    ASSERT_TRUE(source);
    EXPECT_EQ(schemaText(*source), schema);
    ASSERT_EQ(source->description().warnings.size(), 1u);
    EXPECT_NE(source->description().warnings[0].find("--columns"), std::string::npos);
    EXPECT_EQ(readPoints(*source).positions[0], glm::dvec3(1, 2, 3));
  }
}

TEST(TextCounts, OfSeveralScansAreNoPoints)
{
  const auto source = openText("2\n1 2 3 9 4 5 6\n1 2 4 9 4 5 6\n1\n1 2 5 9 4 5 6\n");
  ASSERT_TRUE(source);
  EXPECT_EQ(source->description().pointCount, 3u);
  EXPECT_EQ(source->description().warnings.size(), 1u); // the guess
  const auto lying = openText("X Y Z\n1 2 3\n");
  ASSERT_TRUE(lying);
  const auto short3 = openText("5\n1 2 3\n1 2 4\n");
  ASSERT_TRUE(short3);
  ASSERT_EQ(short3->description().warnings.size(), 1u);
  EXPECT_NE(short3->description().warnings[0].find("promise 5"), std::string::npos);
}

TEST(TextRowsThatAreNone, AreRejectedAndTold)
{
  const auto source = openText("# points\nx y z i\n\n1 2 3 4\n# between\n1 2 3\nnot at all\n"
                               "1 2 nan 4\n5 6 7 8\n9 9 9 9x\n");
  ASSERT_TRUE(source);
  const PointBatch all = readPoints(*source);
  ASSERT_EQ(all.size(), 6u);
  std::size_t finite = 0;
  for (const glm::dvec3& p : all.positions)
  {
    finite += std::isfinite(p.x + p.y + p.z) ? 1 : 0;
  }
  EXPECT_EQ(finite, 2u);
  ASSERT_EQ(source->description().warnings.size(), 1u);
  EXPECT_EQ(source->description().warnings[0],
    "3 of 6 lines are no points and are rejected; the first is line 6: '1 2 3'.");
}

TEST(TextWithoutPoints, IsRefused)
{
  EXPECT_FALSE(TextFormat().open(writeFile("none.txt", "2\n- _ -\n1 2 3\n")).ok());
  for (const char* text : { "", "\n\n", "hello\nworld\n", "1\n2\n3\n", "x,y\na,b\n",
         "# about x, y\n", "a,b,c\n", "2\nx y z\n" })
  {
    const std::string path = writeFile("none.txt", text);
    EXPECT_FALSE(TextFormat().accepts(path)) << text;
    const auto source = TextFormat().open(path);
    ASSERT_FALSE(source.ok()) << text;
    EXPECT_NE(source.error().what.find("none.txt"), std::string::npos);
  }
}

TEST(TextGrid, IsAsFineAsTheDecimalsOrNone)
{
  const auto millimetres = openText("4000000.123 5000000 1.5\n4000001 5000000.12 2\n");
  ASSERT_TRUE(millimetres && millimetres->description().grid);
  const QuantisationGrid grid = *millimetres->description().grid;
  EXPECT_EQ(grid.scale, glm::dvec3(0.001));
  for (const glm::dvec3& p : readPoints(*millimetres).positions)
  {
    EXPECT_LT(glm::length(grid.toWorld(grid.toGrid(p)) - p), 1e-9);
  }
  const auto whole = openText("1000 2000 3000\n1001 2000 3000\n");
  ASSERT_TRUE(whole && whole->description().grid);
  EXPECT_EQ(whole->description().grid->scale, glm::dvec3(1.0));
  const auto tooFine = openText("0.12345678901 0 0\n1 1 1\n");
  ASSERT_TRUE(tooFine);
  EXPECT_FALSE(tooFine->description().grid);
}

TEST(TextChunks, HoldTheSamePointsAsTheLines)
{
  // Some 4 MiB: several chunks, and a header, comments and bad lines between.
  constexpr int points = 150000;
  std::string text = "x,y,z,id\n";
  for (int i = 0; i < points; ++i)
  {
    char line[96];
    std::snprintf(line, sizeof line, "%.3f,%.3f,%d,%d\n", i * 0.001, i * 0.5, -i, i);
    text += line;
    text += i % 50000 == 7 ? "# a comment\nbad\n" : "";
  }
  const auto source = openText(text);
  ASSERT_TRUE(source);
  EXPECT_GT(source->chunkCount(), 2u);
  const PointBatch all = readPoints(*source);
  EXPECT_EQ(schemaText(*source), "id uint32");
  const auto ids = columnOf<std::uint32_t>(*source, all, "id");
  std::size_t at = 0;
  for (std::size_t row = 0; row < all.size(); ++row)
  {
    if (std::isnan(all.positions[row].x))
    {
      continue;
    }
    const int i = static_cast<int>(at++);
    ASSERT_EQ(ids[row], static_cast<std::uint32_t>(i));
    ASSERT_EQ(all.positions[row].z, -i);
    ASSERT_NEAR(all.positions[row].x, i * 0.001, 1e-12);
  }
  EXPECT_EQ(at, static_cast<std::size_t>(points));
  EXPECT_EQ(all.size(), static_cast<std::size_t>(points + 3));
}

TEST(TextScans, OfPTXAreTransformed)
{
  const std::string pose = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  const std::string text = "2\n1\n" + pose + "0 1 0 0\n-1 0 0 0\n0 0 1 0\n100 200 300 1\n" +
    "1 0 0 0.5\n0 0 0 0.5\n" + "1\n1\n" + pose + "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n" +
    "7 8 9 0.25\n";
  const auto source = openPoints(TextFormat(), writeFile("scans.ptx", text));
  ASSERT_TRUE(source);
  const PointBatch all = readPoints(*source);
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all.positions[0], glm::dvec3(100, 201, 300));
  EXPECT_TRUE(std::isnan(all.positions[1].x)) << "nothing came back";
  EXPECT_EQ(all.positions[2], glm::dvec3(7, 8, 9));
  EXPECT_EQ(columnOf<float>(*source, all, "intensity")[2], 0.25f);
  ASSERT_EQ(source->chunkCount(), 2u);
  EXPECT_EQ(*source->description().scanner(0), glm::dvec3(100, 200, 300));
  EXPECT_EQ(*source->description().scanner(1), glm::dvec3(0, 0, 0));
}

TEST(TextWithoutPoints, WithAHeaderIsAnEmptyCloud)
{
  for (const char* text : { "x,y,z,id,red,green,blue", "# x y z id red green blue\n",
         "\"x\";\"y\";\"z\";\"id\";\"red\";\"green\";\"blue\"\r\n\r\n" })
  {
    SCOPED_TRACE(text);
    EXPECT_TRUE(TextFormat().accepts(writeFile("points.txt", text)));
    const auto source = openText(text);
    ASSERT_TRUE(source);
    EXPECT_EQ(source->description().pointCount, 0u);
    EXPECT_EQ(source->description().schema.size(), 2u);
    EXPECT_TRUE(source->description().schema.find("rgb"));
    EXPECT_EQ(source->description().warnings, std::vector<std::string>{});
    EXPECT_EQ(readPoints(*source).size(), 0u);
  }
}

TEST(TextIntegers, AreExactWhereADoubleRoundsThem)
{
  const auto source = openText("x,y,z,a,b,gps_time,c[0],c[1]\n"
                               "1,2,3,9007199254740993,18446744073709551615,1234567890123456789,1,"
                               "-9223372036854775807\n"
                               "1,2,4,-9223372036854775808,0,1234567890123456788,2,5\n"
                               "1,2,bad,1,1,1,1,1\n"
                               "1,2,5,7,9223372036854775809,0,3,9223372036854775807\n");
  ASSERT_TRUE(source);
  EXPECT_EQ(schemaText(*source), "a int64, b uint64, gps_time int64, c int64x2");
  const PointBatch all = readPoints(*source);
  constexpr std::int64_t least = std::numeric_limits<std::int64_t>::min();
  EXPECT_EQ(columnOf<std::int64_t>(*source, all, "a"),
    (std::vector<std::int64_t>{ 9007199254740993, least, 0, 7 }));
  EXPECT_EQ(columnOf<std::uint64_t>(*source, all, "b"),
    (std::vector<std::uint64_t>{ 18446744073709551615u, 0, 0, 9223372036854775809u }));
  EXPECT_EQ(columnOf<std::int64_t>(*source, all, "gps_time"),
    (std::vector<std::int64_t>{ 1234567890123456789, 1234567890123456788, 0, 0 }));
  EXPECT_EQ(columnOf<std::int64_t>(*source, all, "c"),
    (std::vector<std::int64_t>{ 1, least + 1, 2, 5, 0, 0, 3, -1 - least }));
}

TEST(TextIntegers, ThatNoTypeHoldsAreToldWhenTheyAreRounded)
{
  for (const char* other : { "0.5", "nan", "1e300", "-1", "18446744073709551616" })
  {
    SCOPED_TRACE(other);
    const auto source =
      openText(std::string("x,y,z,id\n1,2,3,18446744073709551615\n1,2,4,") + other + "\n");
    ASSERT_TRUE(source);
    EXPECT_EQ(schemaText(*source), "id float64");
    ASSERT_EQ(source->description().warnings.size(), 1u);
    EXPECT_NE(source->description().warnings[0].find("'id' are rounded"), std::string::npos);
  }
  const auto sound = openText("x,y,z,a,b\n1,2,3,9007199254740992,1e300\n1,2,4,0.5,1\n");
  ASSERT_TRUE(sound);
  EXPECT_EQ(sound->description().warnings, std::vector<std::string>{});
}

TEST(TextHeaders, KeepQuotesThatAreDoubled)
{
  const auto source =
    openText("x,y,z,\"a \"\"b\"\"\",\"c, \"\"d\"\", e\",\"\"\"f\"\n1,2,3,4,5,6\n");
  ASSERT_TRUE(source);
  EXPECT_EQ(schemaText(*source), "a \"b\" uint8, c, \"d\", e uint8, \"f uint8");
  const auto skipped = openText("a,x,y,z\n\"1,\"\"2,3\",4,5,6\n", { "-", "x", "y", "z" });
  ASSERT_TRUE(skipped);
  EXPECT_EQ(readPoints(*skipped).positions, std::vector<glm::dvec3>{ glm::dvec3(4, 5, 6) });
}

TEST(CutTextFile, IsSoundAtEveryByte)
{
  for (const char* name : { "text/crlf_test.txt", "text/autzen.pts" })
  {
    expectSoundCutAnywhere(TextFormat(), bytesOfFile(shared(name)), "cut.txt");
  }
  expectSoundCutAnywhere(
    TextFormat(), bytesOfFile(shared("text/complex-transform.ptx")), "cut.ptx");
}
} // namespace
} // namespace pointfront::test
