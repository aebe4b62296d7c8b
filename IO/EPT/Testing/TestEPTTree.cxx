#include "EPTTree.h"
#include "LASFormat.h"

#include "PointValues.h"

#include "pointfront/Query/BoxRegion.h"
#include "pointfront/Query/QueryPlan.h"
#include "pointfront/Query/StoredPoints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>
#include <vector>

namespace pointfront
{
namespace
{
using namespace pointfront::test;

const std::string trees = std::string(POINTFRONT_SHARED_DATA) + "/ept/";

EPTFormat::Opener lazOpener()
{
  return &LASFormat::openBytes;
}

std::shared_ptr<const StoredCloud> openTree(const std::string& name)
{
  auto cloud = EPTTreeFormat(lazOpener()).open(trees + name);
  EXPECT_TRUE(cloud) << cloud.error().what;
  return cloud ? *cloud : nullptr;
}

using Point = std::tuple<double, double, double, std::uint16_t>;

std::vector<Point> pointsOf(const PointSource& source)
{
  const PointBatch all = readPoints(source);
  const auto intensity = columnOf<std::uint16_t>(source, all, "intensity");
  std::vector<Point> points;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    points.emplace_back(all.positions[i].x, all.positions[i].y, all.positions[i].z, intensity[i]);
  }
  std::sort(points.begin(), points.end());
  return points;
}

std::size_t countOf(const StoredCloud& cloud, const PointQuery& query)
{
  std::size_t found = 0;
  const auto report = queryPoints(cloud, query, {},
    [&](QueryBatch& batch) -> Result<void>
    {
      found += batch.size();
      return {};
    });
  EXPECT_TRUE(report) << report.error().what;
  return found;
}

TEST(EPTTree, HoldsThePointsOfItsNodesByItsOwnHierarchy)
{
  const EPTTreeFormat format(lazOpener());
  EXPECT_TRUE(format.accepts(trees + "lone-star-laszip"));
  EXPECT_TRUE(format.accepts(trees + "lone-star-laszip/ept.json"));
  EXPECT_FALSE(format.accepts(trees));
  const auto cloud = openTree("lone-star-laszip/ept.json");
  ASSERT_TRUE(cloud);
  EXPECT_EQ(cloud->hierarchy()->nodeCount(), 13u);
  EXPECT_EQ(cloud->description().levels, 4u);
  const auto verified = cloud->verify();
  ASSERT_TRUE(verified && verified->ok);
  const auto inPlace = StoredPoints::open(cloud);
  ASSERT_TRUE(inPlace);
  const auto read = openPoints(EPTFormat(lazOpener()), trees + "lone-star-laszip/ept.json");
  ASSERT_TRUE(read);
  EXPECT_TRUE(pointsOf(**inPlace) == pointsOf(*read));
  EXPECT_EQ(cloud->files().size(), 14u);
}

/// Ranges are those of a few points: a filter finds what lies beyond them.
TEST(EPTTree, AFilterFindsWhatLiesBeyondTheSampledRanges)
{
  const auto cloud = openTree("lone-star-laszip/ept.json");
  ASSERT_TRUE(cloud);
  const StoreDescription& description = cloud->description();
  EXPECT_TRUE(description.rangesAreSampled);
  const auto read = openPoints(EPTFormat(lazOpener()), trees + "lone-star-laszip/ept.json");
  ASSERT_TRUE(read);
  const std::vector<Point> all = pointsOf(*read);
  const std::size_t column = *description.schema.find("intensity");
  const double sampled = description.ranges[column].components[0][1];
  const auto expected = std::count_if(
    all.begin(), all.end(), [&](const Point& point) { return std::get<3>(point) > sampled; });
  ASSERT_GT(expected, 0) << sampled;
  PointQuery query;
  query.where = *FilterExpression::parse("intensity > " + std::to_string(int(sampled)));
  EXPECT_EQ(countOf(*cloud, query), static_cast<std::size_t>(expected));
}

TEST(EPTTree, BinaryNodesToo)
{
  const auto cloud = openTree("bcbf");
  ASSERT_TRUE(cloud);
  EXPECT_EQ(cloud->description().pointCount, 5u);
  EXPECT_EQ(cloud->description().levels, 5u);
  const auto verified = cloud->verify();
  ASSERT_TRUE(verified);
  // Its description counts ten points: five nodes of the original tree were left out.
  EXPECT_EQ(cloud->description().missingPoints(), 5u);
  EXPECT_EQ(verified->pointsChecked, 5u);
  EXPECT_FALSE(verified->ok);
  EXPECT_NE(verified->firstError.find("lacks 5 of the 10 points"), std::string::npos);
}

TEST(EPTTree, BoxesGiveWhatAFilterOfAllPointsGives)
{
  const auto cloud = openTree("lone-star-laszip");
  const auto read = openPoints(EPTFormat(lazOpener()), trees + "lone-star-laszip/ept.json");
  ASSERT_TRUE(cloud && read);
  const PointBatch all = readPoints(*read);
  const Bounds whole = cloud->description().bounds;
  for (int n = 0; n < 10; ++n)
  {
    const glm::dvec3 low = whole.low + whole.size() * (0.06 * n) + 0.00013;
    const Bounds box{ low, low + whole.size() * 0.3 };
    const auto inside = [&box](const glm::dvec3& p) { return box.contains(p); };
    PointQuery query;
    query.regions = { *BoxRegion::make(box) };
    query.attributes = std::vector<std::string>();
    EXPECT_EQ(countOf(*cloud, query),
      static_cast<std::size_t>(std::count_if(all.positions.begin(), all.positions.end(), inside)))
      << n;
  }
}
} // namespace
} // namespace pointfront
