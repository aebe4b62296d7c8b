// The spacing that an index says of points on upright surfaces.

#include "FileBytes.h"
#include "IndexedLASFile.h"
#include "LASIndexing.h"
#include "RealFiles.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <random>

namespace pointfront::test
{
namespace
{
using WallSteps = std::array<std::int32_t, 3>;

/// The spacing of the root of an index of 20,000 points, place(u, v) with u and v below 20,000.
float spacingOf(const std::string& name, const std::function<WallSteps(int, int)>& place)
{
  constexpr std::uint32_t count = 20000;
  FileBytes bytes(sharedData("las/real/autzen_trim.las"));
  const auto first = bytes.get<std::uint32_t>(96);
  const auto width = bytes.get<std::uint16_t>(105);
  bytes.put<std::uint32_t>(107, count);
  bytes.resize(first + count * width);
  std::mt19937 random(3);
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const int u = static_cast<int>(random() % count);
    const int v = static_cast<int>(random() % count);
    bytes.put(first + i * width, place(u, v));
  }
  const std::string las = bytes.write(name);
  LASIndexOptions options;
  options.leafPoints = 1000;
  options.overwrite = true;
  const auto report = indexLASFile(las, las + lasIndexSuffix, options);
  EXPECT_TRUE(report) << report.error().what;
  const auto indexed = IndexedLASFile::open(las + lasIndexSuffix);
  EXPECT_TRUE(indexed) << indexed.error().what;
  return indexed ? (*indexed)->hierarchy()->node(0).spacing : 0.0f;
}
} // namespace

/// From above, the points of a wall lie on a line, as if they were thousands of times as close.
TEST(IndexedWall, HasTheSpacingOfItsSurface)
{
  const float floor = spacingOf("floor.las", [](int u, int v) { return WallSteps{ u, v, v % 3 }; });
  ASSERT_GT(floor, 0.0f);
  const float wall = spacingOf("wall.las", [](int u, int v) { return WallSteps{ u, v % 3, v }; });
  EXPECT_NEAR(wall, floor, 0.3f * floor);
}

} // namespace pointfront::test
