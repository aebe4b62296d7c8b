#include "FilesInTheMaking.h"
#include "TextFormat.h"
#include "WriterCases.h"
#include "XYZWriter.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace pointfront
{
namespace
{
namespace fs = std::filesystem;

std::string contents(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// A path of this test's own, with nothing there.
std::string freshPath(const std::string& name)
{
  const std::string path = testing::TempDir() + "pointfront-" + name;
  fs::remove(path);
  return path;
}

SinkDescription twoPoints(PointBatch& batch)
{
  SinkDescription description;
  description.grid = { glm::dvec3(0.01, 0.01, 0.001), glm::dvec3(0.0) };
  description.schema.add({ "intensity", ScalarType::UInt16 });
  description.schema.add({ "rgb", ScalarType::UInt8, 3 });
  description.schema.add({ "wave length", ScalarType::Int16, 1, 0.1, 1000.0 });
  batch.resize(2, description.schema);
  batch.positions = { { 637012.24, 849028.31, 431.66 }, { -0.05, 0.0, 12.3456 } };
  const std::uint16_t intensity[2] = { 143, 65535 };
  const std::uint8_t rgb[6] = { 68, 77, 88, 0, 255, 1 };
  const std::int16_t scaled[2] = { 3, -10001 };
  std::memcpy(batch.columns[0].data(), intensity, sizeof intensity);
  std::memcpy(batch.columns[1].data(), rgb, sizeof rgb);
  std::memcpy(batch.columns[2].data(), scaled, sizeof scaled);
  return description;
}

TEST(XYZWriter, GivesColumnsNamesThatItsReaderTellsApart)
{
  const TextFormat format;
  for (const auto style : { XYZWriter::Style::Blanks, XYZWriter::Style::CSV })
  {
    test::expectNamesToldApart({ format, style == XYZWriter::Style::CSV ? "csv" : "xyz",
      [style](const std::string& path) { return std::make_unique<XYZWriter>(path, style); } });
  }
}

TEST(XYZWriter, NamesItsColumnsAndWritesTheGridsDigits)
{
  const std::string path = freshPath("digits.xyz");
  PointBatch batch;
  const SinkDescription description = twoPoints(batch);
  XYZWriter writer(path);
  ASSERT_TRUE(writer.begin(description));
  ASSERT_TRUE(writer.append(batch));
  EXPECT_FALSE(fs::exists(path)) << "whole or absent: not there before finish()";
  ASSERT_TRUE(writer.finish());
  EXPECT_EQ(contents(path),
    "# x y z intensity red green blue wave_length\n"
    "637012.24 849028.31 431.660 143 68 77 88 1000.3\n"
    "-0.05 0.00 12.346 65535 0 255 1 -0.1\n");
  fs::remove(path);
}

TEST(XYZWriter, WritesWhatScaledNumbersMean)
{
  const std::string path = freshPath("scaled.csv");
  SinkDescription description;
  description.grid = { glm::dvec3(1.0), glm::dvec3(0.0) };
  description.schema.add({ "heat\nmap", ScalarType::Float32, 1, 0.5, 100.0 });
  PointBatch batch;
  batch.resize(2, description.schema);
  const float stored[2] = { 0.0f, 3.0f };
  std::memcpy(batch.columns[0].data(), stored, sizeof stored);
  XYZWriter writer(path, XYZWriter::Style::CSV);
  ASSERT_TRUE(writer.begin(description));
  ASSERT_TRUE(writer.append(batch));
  ASSERT_TRUE(writer.finish());
  EXPECT_EQ(contents(path), "x,y,z,heat_map\n0,0,0,100\n0,0,0,101.5\n");
}

TEST(XYZWriter, LeavesNothingWhenItIsNotFinished)
{
  const std::string path = freshPath("unfinished.xyz");
  {
    PointBatch batch;
    const SinkDescription description = twoPoints(batch);
    XYZWriter writer(path);
    ASSERT_TRUE(writer.begin(description));
    ASSERT_TRUE(writer.append(batch));
  }
  EXPECT_FALSE(fs::exists(path));
  EXPECT_TRUE(filesInTheMaking(path).empty());
}

TEST(XYZWriter, SaysWhyItCannotWrite)
{
  XYZWriter writer(testing::TempDir() + "no-such-folder/out.xyz");
  const Result<void> done = writer.begin(SinkDescription());
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().kind, Error::Kind::Unwritable);
  EXPECT_NE(done.error().what.find("no-such-folder"), std::string::npos) << done.error().what;
}
} // namespace
} // namespace pointfront
