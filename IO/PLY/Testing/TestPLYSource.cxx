#include "PLYFormat.h"
#include "RealPoints.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>

namespace pointfront::test
{
namespace
{
// Counts: MANIFEST.md beside the data.
const RealPoints realFiles[] = { { "ply/simple_text.ply", 3, "" },
  { "ply/simple_binary.ply", 3, "" }, { "ply/sized_dims.ply", 1, "j int32, intensity float64" },
  { "ply/unsized_dims.ply", 1, "intensity float64, j int32" },
  { "ply/text_extradim.ply", 1, "normal float32x3, rgb uint8x3, alpha uint8, omg int32" },
  { "ply/platonic_shelf.ply", 50, "" }, { "ply/platonic_shelf_ascii.ply", 50, "" },
  { "ply/platonic_shelf_big_endian.ply", 50, "" },
  { "ply/standard_ply_points.ply", 20, "normal float32x3, rgb uint8x3, a float32x2" },
  { "ply/single_point.ply", 1, "" }, { "ply/diamond.ply", 6, "rgb uint8x3, normal float32x3" },
  { "ply/diamond_ascii.ply", 6, "normal float32x3, rgb uint8x3, alpha uint8" },
  { "ply/points_ascii.ply", 5, "" }, { "ply/points_bin.ply", 5, "" },
  { "ply/points_ascii_with_lists.ply", 5, "" }, { "ply/points_emptyface.ply", 1024, "" },
  { "ply/lidar_fields_all_double.ply", 3,
    "intensity uint16, classification uint8, flag_byte float64, scan_angle float64, "
    "user_data uint8, point_source_id uint16, return_number uint8" },
  { "ply/ripple_ascii.ply", 10201, "rgb uint8x3, normal float32x3" },
  { "ply/ripple_bin.ply", 10201, "rgb uint8x3, normal float32x3" },
  { "ply/rgb_then_normals_ascii.ply", 4, "rgb uint8x3, normal float32x3" },
  { "ply/float_colour.ply", 3, "rgb uint8x3, alpha float32" },
  { "ply/two_elements_ascii.ply", 3, "return int32" }, { "ply/int_point_cloud.ply", 16, "" },
  { "normals/unit_sphere_642.ply", 642, "" },
  { "normals/pond_pmvs_rgb_normals_70k.ply", 70051,
    "normal float32x3, rgb uint8x3, psz float32" } };

TEST(RealPLYFile, GivesItsPointsAndAttributes)
{
  const PLYFormat format;
  for (const RealPoints& expected : realFiles)
  {
    SCOPED_TRACE(expected.path);
    ASSERT_TRUE(expectRealPoints(format, expected));
  }
}

TEST(RealPLYFile, HoldsTheSamePointsInThreeEncodings)
{
  const PLYFormat format;
  const auto little = openPoints(format, shared("ply/platonic_shelf.ply"));
  const auto big = openPoints(format, shared("ply/platonic_shelf_big_endian.ply"));
  const auto text = openPoints(format, shared("ply/platonic_shelf_ascii.ply"));
  ASSERT_TRUE(little && big && text);
  const PointBatch a = readPoints(*little);
  EXPECT_EQ(a.positions, readPoints(*big).positions);
  const PointBatch c = readPoints(*text);
  ASSERT_EQ(a.size(), c.size());
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    EXPECT_LT(glm::length(a.positions[i] - c.positions[i]), 1e-5);
  }
}

TEST(RealPLYFile, HoldsTheSameRippleInTextAndBinary)
{
  const PLYFormat format;
  const auto text = openPoints(format, shared("ply/ripple_ascii.ply"));
  const auto binary = openPoints(format, shared("ply/ripple_bin.ply"));
  ASSERT_TRUE(text && binary);
  const PointBatch a = readPoints(*text);
  const PointBatch b = readPoints(*binary);
  EXPECT_EQ(columnOf<std::uint8_t>(*text, a, "rgb"), columnOf<std::uint8_t>(*binary, b, "rgb"));
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    EXPECT_LT(glm::length(a.positions[i] - b.positions[i]), 1e-5);
  }
}

TEST(RealPLYFile, OfSpherePointsKeepsItsDecimals)
{
  const auto source = openPoints(PLYFormat(), shared("normals/unit_sphere_642.ply"));
  ASSERT_TRUE(source);
  ASSERT_TRUE(source->description().grid) << "decimals fit into 32 bits of steps";
  for (const glm::dvec3& p : readPoints(*source).positions)
  {
    EXPECT_NEAR(glm::length(p), 1.0, 7e-7);
    const auto& grid = *source->description().grid;
    EXPECT_LT(glm::length(grid.toWorld(grid.toGrid(p)) - p), 1e-12);
  }
}

TEST(RealPLYFile, WithoutPointsIsRefused)
{
  for (const char* name : { "ply/no_vertex.ply" })
  {
    const auto source = PLYFormat().open(shared(name));
    ASSERT_FALSE(source.ok());
    EXPECT_EQ(source.error().kind, Error::Kind::Unsupported);
    EXPECT_NE(source.error().what.find("no element 'vertex'"), std::string::npos);
  }
}

TEST(CutPLYFile, GivesItsWholePointsAndSaysWhatIsMissing)
{
  const auto source = openPoints(PLYFormat(), shared("derived_hostile/ply_binary_truncated.ply"));
  ASSERT_TRUE(source);
  EXPECT_EQ(source->description().pointCount, 2u);
  ASSERT_EQ(source->description().warnings.size(), 1u);
  EXPECT_EQ(source->description().warnings[0].rfind("1 of 3 points are missing", 0), 0u);
}

TEST(CutPLYFile, IsSoundAtEveryByte)
{
  for (const char* name : { "ply/simple_binary.ply", "ply/diamond_ascii.ply", "ply/diamond.ply" })
  {
    expectSoundCutAnywhere(PLYFormat(), bytesOfFile(shared(name)), "cut.ply");
  }
}

std::string header(const std::string& format, const std::string& body)
{
  return "ply\nformat " + format + " 1.0\nobj_info made for a test\n" + body + "end_header\n";
}

template <typename T>
void append(std::string& bytes, T value, bool reversed)
{
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof value);
  bytes += reversed
    ? std::string(std::reverse_iterator<char*>(raw + sizeof raw), std::reverse_iterator<char*>(raw))
    : std::string(raw, sizeof raw);
}

/// Vertices with a list each, in front of and behind other elements with lists.
std::string listedFile(bool big, int points)
{
  std::string bytes = header(big ? "binary_big_endian" : "binary_little_endian",
    "element face 2\nproperty list uchar int vertex_index\nproperty short flags\n"
    "element vertex " +
      std::to_string(points) +
      "\nproperty double z\n"
      "property list ushort float weights\nproperty double y\nproperty uint id\n"
      "property double x\nelement tail 1\nproperty char c\n");
  for (int face = 0; face < 2; ++face)
  {
    append<std::uint8_t>(bytes, static_cast<std::uint8_t>(3 + face), false);
    for (int k = 0; k < 3 + face; ++k)
    {
      append<std::int32_t>(bytes, k, big);
    }
    append<std::int16_t>(bytes, -1, big);
  }
  for (int i = 0; i < points; ++i)
  {
    append<double>(bytes, i + 0.25, big);
    append<std::uint16_t>(bytes, static_cast<std::uint16_t>(i % 5), big);
    for (int k = 0; k < i % 5; ++k)
    {
      append<float>(bytes, 1.0f, big);
    }
    append<double>(bytes, 2.0 * i, big);
    append<std::uint32_t>(bytes, 4000000000u + static_cast<unsigned>(i), big);
    append<double>(bytes, -i, big);
  }
  append<std::int8_t>(bytes, 7, false);
  return bytes;
}

TEST(PLYLists, ArePassedOverInBothByteOrders)
{
  constexpr int points = 70001; // three chunks
  for (const bool big : { false, true })
  {
    const auto source = openPoints(PLYFormat(), writeFile("lists.ply", listedFile(big, points)));
    ASSERT_TRUE(source);
    EXPECT_EQ(schemaText(*source), "id uint32");
    EXPECT_EQ(source->chunkCount(), 3u);
    const PointBatch all = readPoints(*source);
    const std::vector<std::uint32_t> ids = columnOf<std::uint32_t>(*source, all, "id");
    ASSERT_EQ(ids.size(), static_cast<std::size_t>(points));
    for (int i = 0; i < points; ++i)
    {
      const glm::dvec3 expected(-i, 2.0 * i, i + 0.25);
      ASSERT_EQ(all.positions[static_cast<std::size_t>(i)], expected) << i;
      ASSERT_EQ(ids[static_cast<std::size_t>(i)], 4000000000u + static_cast<unsigned>(i));
    }
  }
}

TEST(PLYLists, AreSoundWhereverTheFileEnds)
{
  expectSoundCutAnywhere(PLYFormat(), listedFile(true, 7), "lists.ply");
}

TEST(PLYLists, InTextArePassedOver)
{
  const std::string text =
    header("ascii",
      "element vertex 2\nproperty float x\nproperty list uchar int n\nproperty float y\n"
      "property float z\n") +
    "1 2 8 9 4 5\n6 0 7 8\n";
  const auto source = openPoints(PLYFormat(), writeFile("lists.ply", text));
  ASSERT_TRUE(source);
  const PointBatch all = readPoints(*source);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all.positions[0], glm::dvec3(1, 4, 5));
  EXPECT_EQ(all.positions[1], glm::dvec3(6, 7, 8));
}

TEST(PLYColours, AreDecidedByAllValuesOfTheFile)
{
  const auto colour = [](const std::string& type, const std::string& rows)
  {
    std::string text = "element vertex 2\nproperty float x\nproperty float y\nproperty float z\n";
    for (const char* name : { "red", "green", "blue" })
    {
      text += "property " + type + " " + name + "\n";
    }
    return openPoints(PLYFormat(), writeFile("colour.ply", header("ascii", text) + rows));
  };
  const auto fractions = colour("float", "0 0 0 0.502 1 0\n0 0 0 0.2 0.4 0.6\n");
  ASSERT_TRUE(fractions);
  EXPECT_EQ(columnOf<std::uint8_t>(*fractions, readPoints(*fractions), "rgb"),
    (std::vector<std::uint8_t>{ 128, 255, 0, 51, 102, 153 }));
  const auto fine = colour("float", "0 0 0 0.50025 1 0\n0 0 0 0.2 0.4 0.6\n");
  ASSERT_TRUE(fine);
  EXPECT_EQ(columnOf<std::uint16_t>(*fine, readPoints(*fine), "rgb"),
    (std::vector<std::uint16_t>{ 32784, 65535, 0, 13107, 26214, 39321 }));
  const auto bytes = colour("double", "0 0 0 1 2 255\n0 0 0 0 0 0\n");
  ASSERT_TRUE(bytes);
  EXPECT_EQ(columnOf<std::uint8_t>(*bytes, readPoints(*bytes), "rgb"),
    (std::vector<std::uint8_t>{ 1, 2, 255, 0, 0, 0 }));
  const auto words = colour("ushort", "0 0 0 1 2 255\n0 0 0 0 0 65535\n");
  ASSERT_TRUE(words);
  EXPECT_EQ(columnOf<std::uint16_t>(*words, readPoints(*words), "rgb"),
    (std::vector<std::uint16_t>{ 1, 2, 255, 0, 0, 65535 }));
  const auto none = colour("float", "0 0 0 -1 2 255\n0 0 0 0 0 0\n");
  ASSERT_TRUE(none);
  EXPECT_EQ(schemaText(*none), "red float32, green float32, blue float32");
  EXPECT_EQ(none->description().warnings.size(), 1u);
}

TEST(PLYPositions, ThatAreNoNumbersGoThrough)
{
  const std::string text =
    header("ascii", "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n") +
    "1 2 3\nnan 0 0\n0 inf 0\nno point\n";
  const auto source = openPoints(PLYFormat(), writeFile("nan.ply", text));
  ASSERT_TRUE(source);
  const PointBatch all = readPoints(*source);
  ASSERT_EQ(all.size(), 4u);
  EXPECT_TRUE(std::isnan(all.positions[1].x));
  EXPECT_TRUE(std::isinf(all.positions[2].y));
  EXPECT_TRUE(std::isnan(all.positions[3].x));
  ASSERT_EQ(source->description().warnings.size(), 1u);
  EXPECT_NE(source->description().warnings[0].find("line 12: 'no point'"), std::string::npos)
    << source->description().warnings[0];
}

TEST(PLYHeaders, ThatLieOrAreNoneAreRefused)
{
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const std::array<std::pair<std::string, const char*>, 12> files{ {
    { "", "not a PLY file" },
    { "plyx\n", "not a PLY file" },
    { "ply\nformat ascii 1.0\nelement vertex 1\n", "does not end" },
    { "ply\nelement vertex 1\n" + xyz + "end_header\n1 2 3\n", "no format line" },
    { header("binary_middle_endian", ""), "unknown" },
    { header("ascii", "element vertex -1\n" + xyz), "'-1' is no count" },
    { header("ascii", "element vertex 99999999999999999999999\n" + xyz), "is no count" },
    { header("ascii", "property float x\nelement vertex 1\n" + xyz), "before the first" },
    { header("ascii", "element vertex 1\nproperty quux x\n"), "'quux' is no type" },
    { header("ascii", "element vertex 1\n"), "no properties" },
    { header("ascii", "element vertex 1\nproperty float a\n") + "1\n", "no x and y" },
    { header("ascii", "element vertex 1\nproperty list float int x\n"), "count of a list" },
  } };
  for (const auto& [bytes, reason] : files)
  {
    const auto source = PLYFormat().open(writeFile("broken.ply", bytes));
    ASSERT_FALSE(source.ok()) << bytes;
    EXPECT_NE(source.error().what.find(reason), std::string::npos) << source.error().what;
    EXPECT_NE(source.error().what.find("broken.ply"), std::string::npos) << source.error().what;
  }
}

TEST(PLYText, KeepsValuesThatTheTypeOfItsHeaderDoesNotHold)
{
  const auto points = openPoints(PLYFormat(),
    writeFile("wide.ply",
      header("ascii",
        "element vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
        "property uchar a\nproperty short b\nproperty int c\nproperty int d\nproperty char e\n") +
        "0 0 0 300 -40000 99999999999 1.5 -128\n1 1 1 7 7 7 7 127\n"));
  ASSERT_TRUE(points);
  const AttributeSchema& schema = points->description().schema;
  const std::array<ScalarType, 5> types = { ScalarType::UInt16, ScalarType::Int32,
    ScalarType::Int64, ScalarType::Float32, ScalarType::Int8 };
  for (std::size_t c = 0; c < types.size(); ++c)
  {
    EXPECT_EQ(schema[*schema.find(std::string(1, static_cast<char>('a' + c)))].type, types[c]);
  }
  const PointBatch batch = readPoints(*points);
  std::int64_t wide = 0;
  std::memcpy(&wide, batch.columns[*schema.find("c")].data(), sizeof wide);
  EXPECT_EQ(wide, 99999999999);
  EXPECT_EQ(points->description().warnings.size(), 4u);
}

TEST(PLYHeaders, WithCountsBeyondAllBytesEndAtOnce)
{
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  for (const char* format : { "ascii", "binary_little_endian" })
  {
    const std::string body = std::string(format) == "ascii" ? "1 2 3\n" : std::string(12, '\0');
    const auto points = openPoints(PLYFormat(),
      writeFile("many.ply", header(format, "element vertex 18446744073709551615\n" + xyz) + body));
    ASSERT_TRUE(points);
    EXPECT_EQ(points->description().pointCount, 1u);
    const auto before = PLYFormat().open(writeFile("many.ply",
      header(format,
        "element face 18446744073709551615\nproperty list uint int i\n"
        "element vertex 1\n" +
          xyz) +
        body));
    ASSERT_FALSE(before.ok());
    EXPECT_EQ(before.error().kind, Error::Kind::Truncated);
  }
}
} // namespace
} // namespace pointfront::test
