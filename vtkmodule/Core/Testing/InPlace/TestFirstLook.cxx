#include "pointfront/InPlace/FirstLook.h"

#include "CloudInMemory.h"

#include "pointfront/Base/Infinity.h"
#include "pointfront/Query/StoredPoints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace pointfront
{
namespace
{

/// `count` points on a diagonal; each seventh has no place.
std::vector<glm::dvec3> diagonal(std::size_t count)
{
  std::vector<glm::dvec3> points(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const double x = i % 7 == 3 ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(i);
    points[i] = { x, 2.0 * x, i % 7 == 5 ? infinity : 1.0 };
  }
  return points;
}

std::set<double> placesOf(const PointSource& points)
{
  std::set<double> places;
  PointBatch batch;
  for (std::uint64_t chunk = 0; chunk < points.chunkCount(); ++chunk)
  {
    EXPECT_TRUE(points.read(chunk, batch));
    for (const glm::dvec3& p : batch.positions)
    {
      places.insert(std::round(p.x));
      EXPECT_NEAR(p.y, 2.0 * p.x, 0.01);
    }
  }
  return places;
}

} // namespace

TEST(FirstLook, TakesSomeChunksFromAllOfTheCloud)
{
  const auto cloud =
    firstLookAt(std::make_unique<test::CloudInMemory>("a.ply", diagonal(40000), "", 1000));
  ASSERT_TRUE(cloud) << cloud.error().what;
  const auto points = StoredPoints::open(*cloud);
  ASSERT_TRUE(points) << points.error().what;
  const std::set<double> places = placesOf(**points);
  EXPECT_GT(places.size(), 16u * 600u);
  EXPECT_LT(places.size(), 16u * 800u); // sixteen chunks, and two of seven points have no place
  EXPECT_LT(*places.begin(), 3.0);
  EXPECT_GT(*places.rbegin(), 36000.0);
  ASSERT_EQ((*cloud)->description().warnings.size(), 1u);
  EXPECT_EQ((*cloud)->description().warnings[0].rfind("A first look: ", 0), 0u);
}

TEST(FirstLook, OfASmallCloudHasAllOfIt)
{
  std::vector<glm::dvec3> three{ { 1, 2, 0 }, { 2, 4, 0 }, { 3, 6, 0 } };
  const auto cloud = firstLookAt(std::make_unique<test::CloudInMemory>("a.ply", three));
  ASSERT_TRUE(cloud) << cloud.error().what;
  const auto points = StoredPoints::open(*cloud);
  ASSERT_TRUE(points) << points.error().what;
  EXPECT_EQ(placesOf(**points), (std::set<double>{ 1, 2, 3 }));
  EXPECT_TRUE((*cloud)->description().warnings.empty());
  const auto none = firstLookAt(std::make_unique<test::CloudInMemory>("a.ply", diagonal(0)));
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().what, "a.ply: the file holds no points");
}

} // namespace pointfront
