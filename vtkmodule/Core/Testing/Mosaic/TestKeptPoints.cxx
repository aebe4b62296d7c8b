#include "pointfront/Mosaic/KeptPoints.h"

#include "TestBuildClouds.h"

#include "pointfront/Mosaic/InputSurvey.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <memory>
#include <string>

// A source of three chunks is read through a keeper; afterwards its points come from the file.

namespace pointfront::test
{
namespace
{
AttributeSchema keptSchema()
{
  AttributeSchema schema;
  schema.add({ "intensity", ScalarType::UInt16, 1, 1.0, 0.0, "" });
  schema.add({ "rgb", ScalarType::UInt16, 3, 1.0, 0.0, "" });
  return schema;
}

/// Points on the grid, but for the last chunk if `off`; one column is constant.
std::unique_ptr<CloudSource> keptCloud(bool off = false)
{
  const QuantisationGrid grid{ glm::dvec3(0.01), glm::dvec3(400000.0, 5600000.0, 0.0) };
  auto cloud = std::make_unique<CloudSource>("cloud", keptSchema(), grid, 100);
  for (int i = 0; i < 250; ++i)
  {
    glm::dvec3 p = grid.toWorld({ 7 * i, -3 * i, i });
    p.x += off && i == 249 ? 1e-7 : 0.0;
    p.z = off && i == 240 ? std::numeric_limits<double>::quiet_NaN() : p.z;
    cloud->addPosition(p);
    cloud->addValue(0, std::uint16_t(77));
    const std::uint16_t rgb[3] = { std::uint16_t(i), std::uint16_t(2 * i), 5 };
    cloud->addValue(1, rgb);
  }
  return cloud;
}

std::vector<std::uint64_t> hashesOf(const PointSource& source)
{
  std::vector<std::uint64_t> hashes;
  PointBatch batch;
  for (std::uint64_t chunk = 0; chunk < source.chunkCount(); ++chunk)
  {
    EXPECT_TRUE(source.read(chunk, batch));
    hashes.push_back(hashOfPoints(batch));
  }
  return hashes;
}

/// Reads the cloud through a keeper; the bytes of the file.
std::uint64_t keep(std::unique_ptr<PointSource> cloud, const std::string& path)
{
  std::filesystem::remove(path);
  auto keeper = PointKeeper::create(path, *cloud);
  EXPECT_TRUE(keeper);
  const std::unique_ptr<PointSource> read = keeping(std::move(cloud), *keeper);
  hashesOf(*read);
  EXPECT_FALSE(std::filesystem::exists(path));
  const Result<std::uint64_t> bytes = (*keeper)->finish("key");
  EXPECT_TRUE(bytes);
  EXPECT_EQ(*bytes, std::filesystem::file_size(path));
  return *bytes;
}

/// How many chunks come from the file: the source itself fails.
std::size_t chunksOfFile(const std::string& path, const std::string& key)
{
  std::size_t chunks = 0;
  for (std::uint64_t chunk = 0; chunk < 3; ++chunk)
  {
    auto broken = keptCloud();
    broken->failAt(chunk);
    PointBatch batch;
    chunks += fromKept(std::move(broken), path, key)->read(chunk, batch) ? 1 : 0;
  }
  return chunks;
}

void flipByte(const std::string& path, std::uint64_t at)
{
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekg(static_cast<std::streamoff>(at));
  const char byte = static_cast<char>(file.get() ^ 1);
  file.seekp(static_cast<std::streamoff>(at));
  file.put(byte);
}
} // namespace

TEST(KeptPoints, HaveTheBitsOfTheSource)
{
  const std::string path = (freshFolder("kept") / "points").string();
  for (const bool off : { false, true })
  {
    const std::vector<std::uint64_t> expected = hashesOf(*keptCloud(off));
    keep(keptCloud(off), path);
    EXPECT_EQ(hashesOf(*fromKept(keptCloud(off), path, "key")), expected);
    EXPECT_EQ(chunksOfFile(path, "key"), 3u);
  }
}

TEST(KeptPoints, AreCodedAsSteps)
{
  const std::string path = (freshFolder("kept") / "points").string();
  const std::uint64_t points = 250;
  const std::uint64_t little = 250; // rows, trailer and what blocks say of themselves
  const std::uint64_t steps = keep(keptCloud(), path);
  EXPECT_LT(steps, points + little); // on a line, they need few bits
  EXPECT_GT(keep(keptCloud(true), path), steps + 50 * 2);
}

TEST(KeptPoints, OfAnotherInputAreNotRead)
{
  const std::string path = (freshFolder("kept") / "points").string();
  EXPECT_EQ(chunksOfFile(path, "key"), 0u);
  keep(keptCloud(), path);
  EXPECT_EQ(chunksOfFile(path, "key"), 3u);
  EXPECT_EQ(chunksOfFile(path, "another key"), 0u);
}

TEST(KeptPoints, OfADamagedFileComeFromTheSource)
{
  const std::string path = (freshFolder("kept") / "points").string();
  const std::uint64_t bytes = keep(keptCloud(), path);
  flipByte(path, bytes / 3);
  EXPECT_EQ(chunksOfFile(path, "key"), 2u);
  EXPECT_EQ(hashesOf(*fromKept(keptCloud(), path, "key")), hashesOf(*keptCloud()));
  for (const std::uint64_t at : { bytes - 70, bytes - 40, bytes - 5 })
  {
    keep(keptCloud(), path);
    flipByte(path, at);
    EXPECT_EQ(chunksOfFile(path, "key"), 0u) << at;
  }
  keep(keptCloud(), path);
  std::filesystem::resize_file(path, bytes - 9);
  EXPECT_EQ(chunksOfFile(path, "key"), 0u);
}

TEST(KeptPoints, OfAnEndedReadingLeaveNoFile)
{
  const std::filesystem::path folder = freshFolder("kept");
  {
    auto cloud = keptCloud();
    auto keeper = PointKeeper::create((folder / "points").string(), *cloud);
    ASSERT_TRUE(keeper);
    PointBatch batch;
    EXPECT_TRUE(keeping(std::move(cloud), *keeper)->read(0, batch));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

} // namespace pointfront::test
