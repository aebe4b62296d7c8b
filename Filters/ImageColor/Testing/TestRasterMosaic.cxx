// Mosaics of large images, looked up in a small cache of tiles.

#include "ColouredCloud.h"
#include "RasterImages.h"

#include "OrthoImages.h"
#include "ProjCoordinateSystems.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

using namespace pointfront;
using namespace pointfront::test;

TEST(ImageValuesPass, TilesAreTouchedOnceAndTheCacheStaysSmall)
{
  // 42.7 MB of pixels, a cache of 10 MiB; the points of a chunk jump all over the image.
  constexpr std::uint64_t cacheBytes = 10u << 20;
  const ProjCoordinateSystems systems;
  RasterTiles tiles(cacheBytes);
  const auto mosaic =
    RasterMosaic::open({ ortho + "autzen/autzen.jpg" }, RasterUse::Colour, systems, tiles);
  ASSERT_TRUE(mosaic.ok()) << mosaic.error().what;
  const RasterFile& file = mosaic.value().files()[0];
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 60000; ++i)
  {
    const double x = std::fmod(i * 1237.5, 3248.0);
    const double y = std::fmod(i * 2741.25, 4385.0);
    const glm::dvec2 p = file.transform.toGround({ x, y });
    points.push_back({ p.x, p.y, 0.0 });
  }
  std::uint64_t largest = 0;
  const auto visit = [&](std::size_t, const RasterFile&, const std::byte*)
  {
    largest = std::max(largest, tiles.bytesUsed());
    return true;
  };
  const auto without = mosaic.value().sample(points, { nullptr }, visit);
  ASSERT_TRUE(without.ok()) << without.error().what;
  EXPECT_LT(*without, 10u);
  const RasterTiles::Layout& layout = tiles.layout(0);
  const std::uint64_t all = static_cast<std::uint64_t>(layout.across) *
    static_cast<std::uint64_t>((4385 + layout.height - 1) / layout.height);
  EXPECT_GE(tiles.tilesRead(), all - all / 10);
  EXPECT_LE(tiles.tilesRead(), all + all / 10) << "each once, give or take what the cache drops";
  EXPECT_LE(largest, cacheBytes + (4u << 20)) << "a band of tiles is read at a time";
}

// EXPECTED: 10,028,461 points inside; a mean difference of 2.70 levels to the colours stored, 99.06
// % within 8. Half a pixel off would give 3.70.
TEST(LargeRaster, ColoursOfTenMillionPoints)
{
  std::unique_ptr<PointSource> source =
    opened(POINTFRONT_SHARED_DATA "/large/autzen_10653336_rgb_intensity.laz");
  ASSERT_TRUE(source);
  const ProjCoordinateSystems systems;
  RasterTiles tiles(10u << 20);
  const auto mosaic =
    RasterMosaic::open({ ortho + "autzen/autzen.jpg" }, RasterUse::Colour, systems, tiles);
  ASSERT_TRUE(mosaic.ok()) << mosaic.error().what;
  const std::size_t column = *source->description().schema.find("rgb");
  std::uint64_t inside = 0;
  std::uint64_t near = 0;
  double sum = 0.0;
  for (std::uint64_t chunk = 0; chunk < source->chunkCount(); ++chunk)
  {
    PointBatch batch;
    ASSERT_TRUE(source->read(chunk, batch).ok());
    const auto visit = [&](std::size_t point, const RasterFile&, const std::byte* pixel)
    {
      std::uint16_t own[3];
      std::memcpy(own, batch.columns[column].data() + 6 * point, sizeof own);
      int largest = 0;
      for (std::size_t c = 0; c < 3; ++c)
      {
        largest = std::max(largest, std::abs(std::to_integer<int>(pixel[c]) - own[c]));
      }
      ++inside;
      near += largest <= 8 ? 1 : 0;
      sum += largest;
      return true;
    };
    const auto without = mosaic.value().sample(batch.positions, { nullptr }, visit);
    ASSERT_TRUE(without.ok()) << without.error().what;
  }
  EXPECT_EQ(inside, 10028461u);
  EXPECT_NEAR(sum / static_cast<double>(inside), 2.70, 0.005);
  EXPECT_NEAR(static_cast<double>(near) / static_cast<double>(inside), 0.9906, 0.00005);
}
