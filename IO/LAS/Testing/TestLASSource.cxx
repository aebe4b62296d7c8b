#include "RealFiles.h"
#include "SourcePoints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace pointfront::test
{
namespace
{
std::string kinds(const std::string& histogram)
{
  return std::to_string(std::count(histogram.begin(), histogram.end(), ':')) + " kinds";
}

std::string testName(const testing::TestParamInfo<RealFile>& file)
{
  std::string name = file.param.path;
  std::replace_if(
    name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

class RealLASFile : public testing::TestWithParam<RealFile>
{
};

TEST_P(RealLASFile, GivesItsPointsAndClasses)
{
  const RealFile& expected = GetParam();
  const auto source = openOrFail(sharedData(expected.path));
  ASSERT_TRUE(source);
  const SourceDescription& description = source->description();
  EXPECT_EQ(description.format, expected.format);
  EXPECT_EQ(description.pointCount, expected.points);
  const PointBatch all = readAll(*source);
  ASSERT_EQ(all.size(), expected.points);
  const std::string histogram = classHistogram(all, description.schema);
  const bool summarised = std::string(expected.classes).find("kinds") != std::string::npos;
  EXPECT_EQ(summarised ? kinds(histogram) : histogram, expected.classes);
  const std::vector<double> returns = valuesOf(all, description.schema, "return_number");
  EXPECT_TRUE(std::all_of(returns.begin(), returns.end(), [](double r) { return r <= 15; }));
}

TEST_P(RealLASFile, GivesTheSameAsStepsOfItsGrid)
{
  const auto source = openOrFail(sharedData(GetParam().path));
  ASSERT_TRUE(source);
  const QuantisationGrid grid = *source->description().grid;
  PointBatch world;
  PointBatch steps;
  for (std::uint64_t chunk = 0; chunk < source->chunkCount(); ++chunk)
  {
    ASSERT_TRUE(source->read(chunk, world));
    ASSERT_TRUE(source->readSteps(chunk, steps));
    ASSERT_TRUE(steps.positions.empty());
    ASSERT_EQ(steps.size(), world.size());
    EXPECT_EQ(steps.columns, world.columns);
    for (std::size_t i = 0; i < steps.size(); ++i)
    {
      ASSERT_EQ(grid.toGrid(world.positions[i]), GridPosition(steps.steps[i])) << i;
    }
  }
}

TEST_P(RealLASFile, LiesInItsDeclaredBounds)
{
  const auto source = openOrFail(sharedData(GetParam().path));
  ASSERT_TRUE(source);
  const SourceDescription& description = source->description();
  const std::string path = GetParam().path;
  // Fixtures whose points are random, or whose header was never filled in.
  const bool lies = path.find("random") != std::string::npos ||
    path.find("version_x_format") != std::string::npos ||
    path.find("broken_real") != std::string::npos || description.declaredBounds.empty();
  Bounds bounds;
  for (const glm::dvec3& p : readAll(*source).positions)
  {
    bounds.add(p);
  }
  if (!lies)
  {
    const glm::dvec3 step = description.grid->scale;
    const Bounds& declared = description.declaredBounds;
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(bounds.low[axis], declared.low[axis], 1.01 * step[axis]) << axis;
      EXPECT_NEAR(bounds.high[axis], declared.high[axis], 1.01 * step[axis]) << axis;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(LAS, RealLASFile, testing::ValuesIn(realLASFiles), testName);
INSTANTIATE_TEST_SUITE_P(LAZ, RealLASFile, testing::ValuesIn(realLAZFiles), testName);
} // namespace
} // namespace pointfront::test
