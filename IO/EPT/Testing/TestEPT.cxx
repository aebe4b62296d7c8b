#include "EPTFormat.h"
#include "EPTRecords.h"
#include "LASFormat.h"
#include "PointValues.h"

#include <gtest/gtest.h>
#include <zstd.h>

#include <filesystem>
#include <fstream>

namespace pointfront::test
{
namespace
{
namespace fs = std::filesystem;

EPTFormat format()
{
  return EPTFormat(&LASFormat::openBytes);
}

/// A tree of two nodes with three points, written here.
class WrittenTree : public testing::TestWithParam<const char*>
{
protected:
  void SetUp() override
  {
    folder_ = fs::path(testing::TempDir()) / ("pointfront-ept-" + std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "ept-data");
    fs::create_directories(folder_ / "ept-hierarchy");
    zstd_ = std::string(GetParam()) == "zstandard";
    put("ept.json", description(GetParam()));
    put("ept-hierarchy/0-0-0-0.json", R"({ "0-0-0-0": 2, "1-0-0-0": -1, "1-1-1-1": 0 })");
    put("ept-hierarchy/1-0-0-0.json", R"({ "1-0-0-0": 1 })");
    putNode("0-0-0-0", record(100, 200, -300, 7, 2, 65535) + record(1, 2, 3, 8, 6, 0));
    putNode("1-0-0-0", record(-5, 0, 2147483647, 9, 2, 256));
  }
  void TearDown() override { fs::remove_all(folder_); }

  static std::string description(const std::string& encoding)
  {
    return R"({ "bounds": [-1,-1,-1,1,1,1], "dataType": ")" + encoding +
      R"(", "hierarchyType": "json", "points": 3, "version": "1.1.0",
      "srs": { "authority": "EPSG", "horizontal": "25832" }, "schema": [
      { "name": "X", "type": "signed", "size": 4, "scale": 0.01, "offset": 500000 },
      { "name": "Y", "type": "signed", "size": 4, "scale": 0.01, "offset": 5600000 },
      { "name": "Z", "type": "signed", "size": 4, "scale": 0.001, "offset": 0 },
      { "name": "Intensity", "type": "unsigned", "size": 2 },
      { "name": "Classification", "type": "unsigned", "size": 1 },
      { "name": "Red", "type": "unsigned", "size": 2 },
      { "name": "Green", "type": "unsigned", "size": 2 },
      { "name": "Blue", "type": "unsigned", "size": 2 } ] })";
  }
  static std::string record(
    std::int32_t x, std::int32_t y, std::int32_t z, int intensity, int type, int red)
  {
    std::string bytes;
    const auto append = [&bytes](std::int64_t value, int size)
    {
      for (int i = 0; i < size; ++i)
      {
        bytes += static_cast<char>(value >> (8 * i) & 255);
      }
    };
    append(x, 4);
    append(y, 4);
    append(z, 4);
    append(intensity, 2);
    append(type, 1);
    append(red, 2);
    append(0, 4);
    return bytes;
  }
  void put(const std::string& name, const std::string& bytes) const
  {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }
  void putNode(const std::string& key, const std::string& bytes) const
  {
    if (!zstd_)
    {
      return put("ept-data/" + key + ".bin", bytes);
    }
    std::string packed(::ZSTD_compressBound(bytes.size()), '\0');
    packed.resize(::ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 3));
    put("ept-data/" + key + ".zst", packed);
  }
  std::string file() const { return (folder_ / "ept.json").string(); }
  std::string refusal() const
  {
    const auto source = format().open(file());
    if (!source)
    {
      return source.error().what;
    }
    PointBatch batch;
    for (std::uint64_t chunk = 0; chunk < (*source)->chunkCount(); ++chunk)
    {
      if (const Result<void> done = (*source)->read(chunk, batch); !done)
      {
        return done.error().what;
      }
    }
    return "";
  }

  fs::path folder_;
  bool zstd_ = false;
};

TEST_P(WrittenTree, GivesEveryPointOnItsOwnGrid)
{
  EXPECT_TRUE(format().accepts(file()));
  const auto source = openPoints(format(), file());
  ASSERT_TRUE(source);
  const SourceDescription& description = source->description();
  EXPECT_EQ(description.pointCount, 3u);
  EXPECT_TRUE(description.warnings.empty());
  EXPECT_EQ(description.crsWkt, "EPSG:25832");
  ASSERT_TRUE(description.grid);
  EXPECT_EQ(description.grid->scale, glm::dvec3(0.01, 0.01, 0.001));
  EXPECT_EQ(description.grid->offset, glm::dvec3(500000.0, 5600000.0, 0.0));
  EXPECT_EQ(schemaText(*source), "intensity uint16, classification uint8, rgb uint16x3");
  const PointBatch all = readPoints(*source);
  ASSERT_EQ(all.size(), 3u);
  const GridPosition expected[] = { { 100, 200, -300 }, { 1, 2, 3 }, { -5, 0, 2147483647 } };
  for (std::size_t i = 0; i < 3; ++i)
  {
    EXPECT_EQ(description.grid->toGrid(all.positions[i]), expected[i]);
  }
  EXPECT_EQ(
    columnOf<std::uint16_t>(*source, all, "intensity"), (std::vector<std::uint16_t>{ 7, 8, 9 }));
  EXPECT_EQ(columnOf<std::uint16_t>(*source, all, "rgb")[6], 256u);
}

TEST_P(WrittenTree, ThatIsNotSoundIsRefused)
{
  putNode("1-0-0-0", record(-5, 0, 1, 9, 2, 256) + "x");
  EXPECT_NE(refusal(), "");
  SetUp();
  put(zstd_ ? "ept-data/1-0-0-0.zst" : "ept-data/1-0-0-0.bin", "short");
  EXPECT_NE(refusal(), "");
  SetUp();
  fs::remove_all(folder_ / "ept-data");
  EXPECT_NE(refusal(), "");
  for (const char* page : { "", "[]", "{ \"0-0-0-0\": -1 }", "{ \"0-0-0-0\": -2 }",
         "{ \"../../x\": 1 }", "{ \"0-0-0\": 1 }", "{ \"0-0-0-0\": 1e99 }", "{}",
         "{ \"0-0-0-0\": 99999999999 }", "{ \"1-0-0-1\": -1 }" })
  {
    SetUp();
    put("ept-hierarchy/0-0-0-0.json", page);
    EXPECT_NE(refusal(), "") << page;
  }
  const std::string sound = description(GetParam());
  for (std::size_t cut = 0; cut < sound.size(); cut += 7)
  {
    EXPECT_FALSE(EPTDescription::parse(sound.substr(0, cut), "ept.json")) << cut;
  }
  put("ept.json", description("arrow"));
  EXPECT_NE(refusal().find("arrow"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(EPT, WrittenTree, testing::Values("binary", "zstandard"));

TEST(RealTree, OfLaszipHasThePointsOfItsNodes)
{
  const auto source = openPoints(format(), POINTFRONT_SHARED_DATA "/ept/lone-star-laszip/ept.json");
  ASSERT_TRUE(source);
  EXPECT_EQ(source->description().pointCount, 518862u);
  EXPECT_TRUE(source->description().warnings.empty());
  std::uint64_t read = 0;
  PointBatch batch;
  for (std::uint64_t chunk = 0; chunk < source->chunkCount(); ++chunk)
  {
    ASSERT_TRUE(source->read(chunk, batch));
    EXPECT_EQ(batch.size(), source->chunkPoints(chunk));
    read += batch.size();
  }
  EXPECT_EQ(read, 518862u);
}

TEST(RealTree, OfBinaryTellsThatItsCountLies)
{
  const auto source = openPoints(format(), POINTFRONT_SHARED_DATA "/ept/bcbf/ept.json");
  ASSERT_TRUE(source);
  EXPECT_EQ(source->description().pointCount, 5u);
  EXPECT_EQ(source->description().warnings.size(), 1u); // it promises 10
  EXPECT_EQ(source->description().crsWkt, "+proj=geocent +R=1000 +units=m +no_defs +type=crs");
  EXPECT_EQ(readPoints(*source).positions[0], glm::dvec3(1.0, 1.0, 999.0));
}
} // namespace
} // namespace pointfront::test
