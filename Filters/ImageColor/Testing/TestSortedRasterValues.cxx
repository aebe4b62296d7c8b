// Clouds of which every chunk is scattered over images that do not fit the cache.

#include "ImageValuesPass.h"
#include "RasterTiles.h"

#include "CloudInMemory.h"
#include "ProjCoordinateSystems.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <random>

using namespace pointfront;
using pointfront::test::CloudInMemory;

namespace
{
const std::string image = POINTFRONT_SHARED_DATA "/ortho/autzen/autzen.jpg";
constexpr std::uint64_t chunks = 24;
constexpr std::uint64_t chunkPoints = 4000;

/// Points all over the image and a little beyond, ordered along it.
std::vector<glm::dvec3> ordered()
{
  const ProjCoordinateSystems systems;
  const Result<RasterFile> file = RasterFile::open(image, RasterUse::Colour, systems);
  EXPECT_TRUE(file.ok()) << (file ? "" : file.error().what);
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> across(-20.0, 3248.0 + 20.0);
  std::vector<glm::dvec3> points;
  for (std::uint64_t i = 0; i < chunks * chunkPoints; ++i)
  {
    const double row = 4385.0 * (double(i) + 0.5) / double(chunks * chunkPoints);
    const glm::dvec2 p = file->transform.toGround({ across(random), row });
    points.push_back({ p.x, p.y, 0.0 });
  }
  return points;
}

struct Coloured
{
  std::vector<std::array<std::uint16_t, 3>> colours;
  std::uint64_t tilesRead = 0;
  std::vector<std::string> findings;
};

/// In two sources, with a cache of 10 MiB for 42.7 MB of pixels.
Coloured coloured(const std::vector<glm::dvec3>& points)
{
  PointSources sources;
  const auto half = points.begin() + static_cast<std::ptrdiff_t>(points.size() / 2);
  sources.push_back(std::make_unique<CloudInMemory>(
    "first", std::vector<glm::dvec3>(points.begin(), half), "", chunkPoints));
  sources.push_back(std::make_unique<CloudInMemory>(
    "second", std::vector<glm::dvec3>(half, points.end()), "", chunkPoints));
  const ImageValuesPass pass({ { "rgb", { image } } }, std::make_shared<ProjCoordinateSystems>());
  PassResources resources;
  resources.memoryBytes = 80u << 20;
  resources.threads = 2;
  resources.temporaryFolder = testing::TempDir();
  const Result<PointSources> result = pass.apply(std::move(sources), resources);
  EXPECT_TRUE(result.ok()) << (result ? "" : result.error().what);
  Coloured outcome;
  for (std::size_t s = 0; result && s < result->size(); ++s)
  {
    const PointSource& source = *(*result)[s];
    const AttributeSchema& schema = source.description().schema;
    const Attribute& attribute = schema[*schema.find("rgb")];
    PointBatch batch;
    for (std::uint64_t chunk = 0; chunk < source.chunkCount(); ++chunk)
    {
      const Result<void> done = source.read(chunk, batch);
      EXPECT_TRUE(done.ok()) << (done ? "" : done.error().what);
      const std::byte* bytes = batch.columns[*schema.find("rgb")].data();
      for (std::size_t i = 0; i < batch.size(); ++i)
      {
        std::array<std::uint16_t, 3> colour{};
        for (std::size_t c = 0; c < 3; ++c)
        {
          std::memcpy(&colour[c], bytes + i * attribute.bytes() + c * sizeOf(attribute.type),
            sizeOf(attribute.type));
        }
        outcome.colours.push_back(colour);
      }
    }
  }
  outcome.tilesRead = pass.tilesRead();
  outcome.findings = pass.findings();
  return outcome;
}

/// Tiles that the image has.
std::uint64_t allTiles()
{
  const ProjCoordinateSystems systems;
  RasterTiles tiles(10u << 20);
  const Result<RasterFile> file = RasterFile::open(image, RasterUse::Colour, systems);
  EXPECT_TRUE(file && tiles.add(*file));
  const RasterTiles::Layout& layout = tiles.layout(0);
  return static_cast<std::uint64_t>(layout.across) *
    static_cast<std::uint64_t>((file->height + layout.height - 1) / layout.height);
}

TEST(SortedRasterValues, AShuffledCloudReadsEachTileOnceToo)
{
  const std::vector<glm::dvec3> points = ordered();
  std::vector<std::size_t> shuffled(points.size());
  for (std::size_t i = 0; i < shuffled.size(); ++i)
  {
    shuffled[i] = i;
  }
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937_64(18));
  std::vector<glm::dvec3> scattered;
  for (const std::size_t i : shuffled)
  {
    scattered.push_back(points[i]);
  }
  const Coloured expected = coloured(points);
  const Coloured found = coloured(scattered);
  ASSERT_EQ(found.colours.size(), points.size());
  ASSERT_EQ(expected.colours.size(), points.size());
  std::size_t black = 0;
  for (std::size_t i = 0; i < shuffled.size(); ++i)
  {
    ASSERT_EQ(found.colours[i], expected.colours[shuffled[i]]) << i;
    black += found.colours[i] == std::array<std::uint16_t, 3>{} ? 1 : 0;
  }
  EXPECT_LT(black, points.size() / 20);
  EXPECT_EQ(found.findings, expected.findings); // points beside the image, counted
  ASSERT_EQ(found.findings.size(), 2u + 1u) << "no system is named twice, points without";
  const std::uint64_t all = allTiles();
  EXPECT_GE(expected.tilesRead, all);
  // Chunk by chunk it would be 24 times each.
  EXPECT_LE(found.tilesRead, all + all / 4) << expected.tilesRead << " in order";
  std::printf("[   READ   ] %d tiles: %d in order, %d shuffled\n", static_cast<int>(all),
    static_cast<int>(expected.tilesRead), static_cast<int>(found.tilesRead));
}

TEST(SortedRasterValues, ChunksInOrderAreLookedUpWhileTheyAreRead)
{
  std::vector<glm::dvec3> points = ordered();
  const ImageValuesPass pass({ { "rgb", { image } } }, std::make_shared<ProjCoordinateSystems>());
  PassResources resources;
  resources.memoryBytes = 80u << 20;
  resources.threads = 2;
  resources.temporaryFolder = testing::TempDir();
  PointSources sources;
  sources.push_back(std::make_unique<CloudInMemory>("cloud", std::move(points), "", chunkPoints));
  ASSERT_TRUE(pass.apply(std::move(sources), resources));
  EXPECT_EQ(pass.tilesRead(), 0u);
}
} // namespace
