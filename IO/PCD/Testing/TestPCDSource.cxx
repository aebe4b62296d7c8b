#include "PCDFormat.h"
#include "RealPoints.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace pointfront::test
{
namespace
{
// Counts: MANIFEST.md and EXPECTED.md beside the data.
const RealPoints realFiles[] = { { "pcd/bunny.pcd", 397, "" }, { "pcd/milk.pcd", 13704, "" },
  { "pcd/milk_color.pcd", 13704, "rgb uint8x3" },
  { "pcd/office1.pcd", 307200, "rgb uint8x3", 52744 }, { "pcd/curve_close.pcd", 110, "" },
  { "pcd/octants.pcd", 8, "" }, { "pcd/nhood_test.pcd", 36, "intensity float32" },
  { "pcd/car6.pcd", 10031, "" },
  { "pcd/autzen-utm.pcd", 1065,
    "intensity uint16, return_number uint8, return_count uint8, scan_direction uint8, "
    "edge_of_flight_line uint8, classification uint8, scan_angle float32, user_data uint8, "
    "point_source_id uint16, gps_time float64, rgb uint16x3" },
  { "pcd/utm17_space.pcd", 10, "" }, { "pcd/utm17_tab.pcd", 10, "" },
  { "pcd/utm17_comma.pcd", 10, "" }, { "pcd/object_template_0.pcd", 1397, "" },
  { "pcd/Zaghetto.pcd", 59750, "" },
  { "normals/bun0.pcd", 397, "normal float32x3, curvature float32" },
  { "normals/colored_cloud.pcd", 1000, "rgb uint8x3, normal float32x3, curvature float32" },
  { "normals/chef.pcd", 5092, "normal float32x3" },
  { "classified/isprs_ground_truth/samp11-utm.pcd", 38010, "" } };

TEST(PCDIntegers, OfSixtyFourBitsAreExact)
{
  const std::vector<std::int64_t> signs{ 9007199254740993, -9223372036854775807 };
  const std::vector<std::uint64_t> plain{ 18446744073709551615u, 7 };
  const std::string header = "VERSION .7\nFIELDS x y z a b\nSIZE 4 4 4 8 8\nTYPE F F F I U\n"
                             "COUNT 1 1 1 1 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ";
  std::string rows;
  std::string records;
  const auto put = [&records](auto value)
  { records.append(reinterpret_cast<const char*>(&value), sizeof value); };
  for (std::size_t i = 0; i < 2; ++i)
  {
    rows += "1 2 3 " + std::to_string(signs[i]) + " " + std::to_string(plain[i]) + "\n";
    put(1.0F);
    put(2.0F);
    put(3.0F);
    put(signs[i]);
    put(plain[i]);
  }
  for (const std::string& text : { "ascii\n" + rows, "binary\n" + records })
  {
    const auto source = openPoints(PCDFormat(), writeFile("wholes.pcd", header + text));
    ASSERT_TRUE(source);
    EXPECT_EQ(schemaText(*source), "a int64, b uint64");
    const PointBatch all = readPoints(*source);
    EXPECT_EQ(columnOf<std::int64_t>(*source, all, "a"), signs);
    EXPECT_EQ(columnOf<std::uint64_t>(*source, all, "b"), plain);
  }
}

TEST(RealPCDFile, GivesItsPointsAndAttributes)
{
  const PCDFormat format;
  for (const RealPoints& expected : realFiles)
  {
    SCOPED_TRACE(expected.path);
    const auto source = expectRealPoints(format, expected);
    ASSERT_TRUE(source);
    EXPECT_TRUE(source->description().warnings.empty()) << source->description().warnings[0];
  }
}

TEST(RealPCDFile, OfTheBunnyHoldsTheSamePointsTwice)
{
  const auto bunny = openPoints(PCDFormat(), shared("pcd/bunny.pcd"));
  const auto bun0 = openPoints(PCDFormat(), shared("normals/bun0.pcd"));
  ASSERT_TRUE(bunny && bun0);
  const PointBatch a = readPoints(*bunny);
  const PointBatch b = readPoints(*bun0);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    EXPECT_LT(glm::length(a.positions[i] - b.positions[i]), 1e-7);
  }
}

TEST(RealPCDFile, OfOneCloudIsTheSameWithAnySeparator)
{
  const auto space = openPoints(PCDFormat(), shared("pcd/utm17_space.pcd"));
  ASSERT_TRUE(space);
  const PointBatch expected = readPoints(*space);
  EXPECT_EQ(expected.positions[0], glm::dvec3(289814.15, 4320978.61, 170.76));
  ASSERT_TRUE(space->description().grid);
  EXPECT_EQ(space->description().grid->scale, glm::dvec3(0.01));
  for (const char* name : { "pcd/utm17_tab.pcd", "pcd/utm17_comma.pcd" })
  {
    const auto other = openPoints(PCDFormat(), shared(name));
    ASSERT_TRUE(other);
    EXPECT_EQ(readPoints(*other).positions, expected.positions);
  }
}

TEST(RealPCDFile, OfMilkHasTheSamePointsWithAndWithoutColour)
{
  const auto plain = openPoints(PCDFormat(), shared("pcd/milk.pcd"));
  const auto coloured = openPoints(PCDFormat(), shared("pcd/milk_color.pcd"));
  ASSERT_TRUE(plain && coloured);
  const PointBatch points = readPoints(*coloured);
  EXPECT_EQ(readPoints(*plain).positions, points.positions);
  const auto rgb = columnOf<std::uint8_t>(*coloured, points, "rgb");
  EXPECT_GT(std::set<std::uint8_t>(rgb.begin(), rgb.end()).size(), 30u);
}

TEST(RealPCDFile, OfAutzenHasItsClasses)
{
  const auto source = openPoints(PCDFormat(), shared("pcd/autzen-utm.pcd"));
  ASSERT_TRUE(source);
  std::map<int, int> classes;
  for (const std::uint8_t c :
    columnOf<std::uint8_t>(*source, readPoints(*source), "classification"))
  {
    ++classes[c];
  }
  EXPECT_EQ(classes, (std::map<int, int>{ { 1, 789 }, { 2, 276 } })); // as las/real/autzen-utm.las
}

std::string header(const std::string& fields, std::uint64_t points, const std::string& data)
{
  return "# .PCD v0.7\nVERSION 0.7\n" + fields + "WIDTH " + std::to_string(points) +
    "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + std::to_string(points) + "\nDATA " + data +
    "\n";
}
const std::string xyz = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";

/// Two points, and where they were seen from.
SourceDescription seenFrom(const std::string& viewpoint, const std::string& points)
{
  std::string text = header(xyz, 2, "ascii");
  const std::string usual = "VIEWPOINT 0 0 0 1 0 0 0\n";
  text.replace(text.find(usual), usual.size(), viewpoint) += points;
  const auto source = openPoints(PCDFormat(), writeFile("viewpoint.pcd", text));
  return source ? source->description() : SourceDescription();
}

TEST(PCDViewpoint, IsWhereTheScannerStood)
{
  const std::string near = "1 0 2\n0 1 2\n";
  const std::string survey = "482000 5400000 2\n482100 5400100 3\n";
  const auto stated = seenFrom("VIEWPOINT 10 -20 1.5 0.5 0.5 0.5 0.5\n", near);
  ASSERT_NE(stated.scanner(0), nullptr);
  EXPECT_EQ(*stated.scanner(0), glm::dvec3(10, -20, 1.5));
  EXPECT_EQ(stated.declaredBounds.low, glm::dvec3(0, 0, 2)) << "points stay where they are";
  // Everybody's default: a camera's frame, or nobody thought of it.
  const auto camera = seenFrom("VIEWPOINT 0 0 0 1 0 0 0\n", near);
  ASSERT_NE(camera.scanner(0), nullptr);
  EXPECT_EQ(*camera.scanner(0), glm::dvec3(0.0));
  EXPECT_EQ(seenFrom("VIEWPOINT 0 0 0 1 0 0 0\n", survey).scanner(0), nullptr);
  EXPECT_NE(seenFrom("VIEWPOINT 1 0 0 1 0 0 0\n", survey).scanner(0), nullptr);
  EXPECT_EQ(seenFrom("", near).scanner(0), nullptr);
}

TEST(PCDViewpoint, ThatIsDamagedIsSaid)
{
  for (const char* line : { "VIEWPOINT 1 2 3\n", "VIEWPOINT 1 2 x 1 0 0 0\n",
         "VIEWPOINT 1 2 nan 1 0 0 0\n", "VIEWPOINT\n", "VIEWPOINT 1 2 3 1 0 0 0 0\n" })
  {
    const auto damaged = seenFrom(line, "1 0 2\n0 1 2\n");
    EXPECT_EQ(damaged.scanner(0), nullptr);
    EXPECT_EQ(damaged.warnings.size(), 1u) << line;
    EXPECT_EQ(damaged.pointCount, 2u);
  }
}

TEST(PCDFields, OfManyElementsAreArraysOrLeftOut)
{
  const std::string fields = "FIELDS x y z pair histogram _ rgb\nSIZE 8 8 8 2 4 1 4\n"
                             "TYPE F F F I F U U\nCOUNT 1 1 1 2 33 3 1\n";
  std::string bytes = header(fields, 2, "binary");
  std::string text = header(fields, 2, "ascii");
  const auto put = [&](auto value)
  {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
    text += std::to_string(+value) + " ";
  };
  for (int i = 0; i < 2; ++i)
  {
    put(1.5 + i);
    put(2.5);
    put(-3.5);
    put(std::int16_t(-7));
    put(std::int16_t(8));
    for (int k = 0; k < 33; ++k)
    {
      put(0.25f);
    }
    put(std::uint8_t(1));
    put(std::uint8_t(2));
    put(std::uint8_t(3));
    put(std::uint32_t(0xff102030u));
    text += "\n";
  }
  for (const std::string& file : { bytes, text })
  {
    const auto source = openPoints(PCDFormat(), writeFile("arrays.pcd", file));
    ASSERT_TRUE(source);
    EXPECT_EQ(schemaText(*source), "pair int16x2, rgb uint8x3");
    ASSERT_EQ(source->description().warnings.size(), 1u);
    EXPECT_NE(source->description().warnings[0].find("'histogram'"), std::string::npos);
    const PointBatch all = readPoints(*source);
    EXPECT_EQ(all.positions[1], glm::dvec3(2.5, 2.5, -3.5));
    EXPECT_EQ(
      columnOf<std::int16_t>(*source, all, "pair"), (std::vector<std::int16_t>{ -7, 8, -7, 8 }));
    EXPECT_EQ(columnOf<std::uint8_t>(*source, all, "rgb"),
      (std::vector<std::uint8_t>{ 16, 32, 48, 16, 32, 48 }));
  }
}

/// A block of literals only: valid LZF.
std::string literals(const std::string& bytes)
{
  std::string block;
  for (std::size_t at = 0; at < bytes.size(); at += 32)
  {
    const std::string run = bytes.substr(at, 32);
    block += static_cast<char>(run.size() - 1);
    block += run;
  }
  return block;
}

std::string sized(std::uint32_t packed, std::uint32_t unpacked, const std::string& block)
{
  std::string bytes;
  for (const std::uint32_t size : { packed, unpacked })
  {
    for (int i = 0; i < 4; ++i)
    {
      bytes += static_cast<char>(size >> (8 * i) & 255u);
    }
  }
  return bytes + block;
}

TEST(PCDBlocks, BeyondMemoryAreUnpackedToDisk)
{
  // 6 M points: 72 MB of columns, more than is kept in memory. Each axis is one run of zeros that
  // the encoder of this test writes as copies from one byte back.
  constexpr std::uint32_t points = 6000000;
  std::string block(2, '\0'); // one literal zero
  std::uint32_t left = points * 12 - 1;
  while (left > 0)
  {
    const std::uint32_t run = std::min(left, 264u);
    if (run < 9)
    {
      block += std::string(1, static_cast<char>(run - 1)) + std::string(run, '\0');
    }
    else
    {
      block += static_cast<char>(7 << 5);
      block += static_cast<char>(run - 9);
      block += '\0';
    }
    left -= run;
  }
  const auto source = openPoints(PCDFormat({}, testing::TempDir()),
    writeFile("large.pcd",
      header(xyz, points, "binary_compressed") +
        sized(static_cast<std::uint32_t>(block.size()), points * 12, block)));
  ASSERT_TRUE(source);
  EXPECT_EQ(source->description().pointCount, points);
  PointBatch batch;
  ASSERT_TRUE(source->read(source->chunkCount() - 1, batch).ok());
  EXPECT_EQ(batch.positions.back(), glm::dvec3(0.0));
}

TEST(PCDBlocks, ThatAreDamagedAreRefused)
{
  const std::string good = literals(std::string(24, '\0'));
  const auto n = static_cast<std::uint32_t>(good.size());
  const std::pair<std::string, const char*> blocks[] = {
    { sized(n, 24, good).substr(0, 20), "get a whole copy" },
    { sized(n, 24, good).substr(0, 5), "ends before the block" },
    { sized(n, 36, good), "cannot hold" },
    { sized(n, 4294967295u, good), "cannot hold" },
    { sized(n - 2, 24, good), "inside a run" },
    { sized(3, 24, std::string("\xe0\x01\x00", 3)), "before its beginning" },
    { sized(2, 24, std::string("\xe0\x01", 2)), "inside a reference" },
    { sized(5, 24, std::string("\x00\x00\xe0\xff\x00", 5)), "more than it says" },
    { sized(4, 24, std::string("\x02\x00\x00\x00", 4)), "less than it says" },
  };
  for (const auto& [block, reason] : blocks)
  {
    const auto source =
      PCDFormat().open(writeFile("damaged.pcd", header(xyz, 2, "binary_compressed") + block));
    ASSERT_FALSE(source.ok()) << reason;
    EXPECT_NE(source.error().what.find(reason), std::string::npos) << source.error().what;
  }
}

TEST(PCDHeaders, ThatAreMissingOrLieAreRefused)
{
  const auto refused = [](const std::string& bytes, const char* reason)
  {
    const auto source = PCDFormat().open(writeFile("lying.pcd", bytes));
    ASSERT_FALSE(source.ok()) << reason;
    EXPECT_NE(source.error().what.find(reason), std::string::npos) << source.error().what;
    EXPECT_NE(source.error().what.find("lying.pcd"), std::string::npos) << source.error().what;
  };
  refused("", "does not end");
  refused("1 2 3\n4 5 6\n", "'1' is no keyword");
  refused(header("FIELDS x y z\nSIZE 4 4\nTYPE F F F\n", 1, "ascii") + "1 2 3\n", "as many");
  refused(header("FIELDS x y z\nSIZE 4 4 3\nTYPE F F F\n", 1, "ascii") + "1 2 3\n", "no type");
  refused(header("FIELDS x y z\nSIZE 4 4 4\nTYPE F F Q\n", 1, "ascii") + "1 2 3\n", "no type");
  refused(header(xyz + "WIDTH -3\n", 1, "ascii") + "1 2 3\n", "no count");
  refused(header(xyz, 1, "ascii_or_so") + "1 2 3\n", "unknown");
  refused(xyz + "WIDTH 2\nHEIGHT 2\nPOINTS 5\nDATA ascii\n1 2 3\n", "contradicts itself");
  refused(xyz + "DATA ascii\n1 2 3\n", "neither POINTS nor WIDTH");
  refused(header("FIELDS a b c\nSIZE 4 4 4\nTYPE F F F\n", 1, "ascii") + "1 2 3\n", "no x and y");
  refused(bytesOfFile(shared("derived_hostile/pcd_points_4e9.pcd")), "4000000000 points");
  refused(header(xyz, 1ull << 47, "binary") + std::string(48, '\0'), "4 are there");
}

TEST(CutPCDFile, IsSoundAtEveryByte)
{
  for (const char* name : { "pcd/octants.pcd", "pcd/utm17_comma.pcd" })
  {
    expectSoundCutAnywhere(PCDFormat(), bytesOfFile(shared(name)), "cut.pcd");
  }
  expectSoundCutAnywhere(
    PCDFormat(), header(xyz, 20, "binary") + std::string(240, '\1'), "cut.pcd");
  const std::string block = literals(std::string(240, '\1'));
  const auto size = static_cast<std::uint32_t>(block.size());
  expectSoundCutAnywhere(
    PCDFormat(), header(xyz, 20, "binary_compressed") + sized(size, 240, block), "cut.pcd");
}
} // namespace
} // namespace pointfront::test
