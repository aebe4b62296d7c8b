#include "pointfront/Generate/TerrainSource.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace pointfront
{
namespace
{
constexpr std::uint64_t tile = 65536;

PointBatch readChunk(const TerrainSource& source, std::uint64_t chunk)
{
  PointBatch batch;
  EXPECT_TRUE(source.read(chunk, batch).ok());
  return batch;
}
} // namespace

TEST(TerrainSource, GivesExactlyTheCountAskedFor)
{
  for (const std::uint64_t points : { std::uint64_t(0), std::uint64_t(1), tile, 3 * tile + 7 })
  {
    const TerrainSource source(points, 1);
    std::uint64_t sum = 0;
    for (std::uint64_t chunk = 0; chunk < source.chunkCount(); ++chunk)
    {
      EXPECT_EQ(readChunk(source, chunk).size(), source.chunkPoints(chunk));
      sum += source.chunkPoints(chunk);
    }
    EXPECT_EQ(sum, points);
  }
}

TEST(TerrainSource, IsAFunctionOfSeedAndChunk)
{
  const TerrainSource first(4 * tile, 7);
  const TerrainSource second(4 * tile, 7);
  const TerrainSource other(4 * tile, 8);
  const PointBatch late = readChunk(first, 2);
  (void)readChunk(second, 3);
  const PointBatch again = readChunk(second, 2); // in another order
  EXPECT_EQ(late.positions, again.positions);
  EXPECT_EQ(late.columns, again.columns);
  EXPECT_NE(late.positions, readChunk(other, 2).positions);
}

TEST(TerrainSource, StaysInItsDeclaredBoundsAndOnItsGrid)
{
  const TerrainSource source(9 * tile, 3);
  const QuantisationGrid grid = *source.description().grid;
  for (std::uint64_t chunk = 0; chunk < source.chunkCount(); ++chunk)
  {
    for (const glm::dvec3& p : readChunk(source, chunk).positions)
    {
      ASSERT_TRUE(source.description().declaredBounds.contains(p));
      const glm::dvec3 onGrid = grid.toWorld(grid.toGrid(p));
      ASSERT_NEAR(onGrid.x, p.x, 1e-8);
      ASSERT_NEAR(onGrid.z, p.z, 1e-8);
    }
  }
}

TEST(TerrainSource, HasEveryObjectClass)
{
  // 400 tiles are 2.5 square kilometres; every 8th is read.
  const TerrainSource source(400 * tile, 1);
  std::array<std::uint64_t, 256> histogram{};
  std::uint64_t points = 0;
  for (std::uint64_t chunk = 0; chunk < source.chunkCount(); chunk += 8)
  {
    const PointBatch batch = readChunk(source, chunk);
    const std::size_t column = *source.description().schema.find("classification");
    for (const std::byte value : batch.columns[column])
    {
      ++histogram[static_cast<std::size_t>(value)];
    }
    points += batch.size();
  }
  for (const int expected : { 2, 3, 5, 6, 9 })
  {
    EXPECT_GT(histogram[expected], points / 1000) << "class " << expected;
  }
  EXPECT_GT(histogram[2], points / 5);
}

} // namespace pointfront
