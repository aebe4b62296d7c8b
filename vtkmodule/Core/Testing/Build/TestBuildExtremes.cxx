#include "TestBuildClouds.h"

#include "pointfront/Store/PointStore.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <tuple>

namespace pointfront::test
{
namespace
{

struct Shape
{
  const char* name;
  Structure structure;
  Refinement refinement;
  Layering layering;
};

constexpr Shape shapes[] = {
  { "OctreeAdd", Structure::Octree, Refinement::Add, Layering::None },
  { "OctreeReplace", Structure::Octree, Refinement::Replace, Layering::None },
  { "KdTree", Structure::KdTree, Refinement::Add, Layering::None },
  { "KdTreeReplace", Structure::KdTree, Refinement::Replace, Layering::None },
  { "KdTreeOfClasses", Structure::KdTree, Refinement::Add, Layering::ObjectClass },
  { "OctreeOfClasses", Structure::Octree, Refinement::Replace, Layering::ObjectClass },
};

using Steps = std::tuple<std::int64_t, std::int64_t, std::int64_t>;

/// Numerical extremes, for each structure and refinement.
class BuildExtremes : public testing::TestWithParam<Shape>
{
protected:
  void SetUp() override { folder_ = freshFolder(std::string("extremes-") + GetParam().name); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// A cloud whose points have the classes 0, 2, 2, 6, 2, 0, 2 ... and a lone 9.
  static std::unique_ptr<CloudSource> cloud(
    std::size_t count, const QuantisationGrid& grid, const std::function<glm::dvec3(int)>& position)
  {
    AttributeSchema schema;
    schema.add({ "classification", ScalarType::UInt8, 1 });
    auto source = std::make_unique<CloudSource>("extreme", schema, grid);
    for (std::size_t i = 0; i < count; ++i)
    {
      source->addPosition(position(static_cast<int>(i)));
      const std::uint8_t classes[] = { 0, 2, 2, 6, 2 };
      source->addValue<std::uint8_t>(0, i == 7 ? 9 : classes[i % 5]);
    }
    return source;
  }

  Result<BuildReport> build(std::unique_ptr<CloudSource> source)
  {
    BuildOptions options;
    options.outputPath = (folder_ / "out.pfront").string();
    options.structure = GetParam().structure;
    options.refinement = GetParam().refinement;
    options.layering = GetParam().layering;
    options.nodePoints = 500;
    options.threads = 2;
    options.overwrite = true;
    return buildStore(one(std::move(source)), options);
  }

  /// Builds, verifies, and compares the stored points with those of the source, as steps of the
  /// store's grid. `rejected` of them must be missing.
  void keepsAll(std::unique_ptr<CloudSource> source, std::uint64_t rejected = 0)
  {
    const std::vector<glm::dvec3> positions = source->positions();
    const Result<BuildReport> report = build(std::move(source));
    ASSERT_TRUE(report.ok()) << report.error().what;
    EXPECT_EQ(report->pointsStored + rejected, positions.size());
    const auto store = PointStore::open((folder_ / "out.pfront").string());
    ASSERT_TRUE(store.ok()) << store.error().what;
    const Result<VerifyReport> verified = (*store)->verify();
    ASSERT_TRUE(verified.ok());
    EXPECT_TRUE(verified->ok) << verified->firstError;

    const QuantisationGrid& grid = (*store)->description().grid;
    std::vector<Steps> expected;
    for (const glm::dvec3& position : positions)
    {
      if (std::isfinite(position.x + position.y + position.z))
      {
        const glm::dvec3 steps = (position - grid.offset) / grid.scale;
        expected.emplace_back(std::llround(steps.x), std::llround(steps.y), std::llround(steps.z));
      }
    }
    std::vector<Steps> stored = originalPoints(**store);
    std::sort(expected.begin(), expected.end());
    std::sort(stored.begin(), stored.end());
    EXPECT_TRUE(stored == expected) << stored.size() << " of " << expected.size();
  }

  static std::vector<Steps> originalPoints(const PointStore& store)
  {
    std::vector<Steps> points;
    const bool leavesOnly = GetParam().refinement == Refinement::Replace;
    for (NodeIndex n = 0; n < store.hierarchy()->nodeCount(); ++n)
    {
      if (leavesOnly && !store.hierarchy()->node(n).leaf())
      {
        continue;
      }
      const Result<NodeColumns> node = store.read(n, {});
      EXPECT_TRUE(node.ok());
      for (const glm::u32vec3& p : node->positions)
      {
        points.emplace_back(node->origin.x + p.x, node->origin.y + p.y, node->origin.z + p.z);
      }
    }
    return points;
  }

  std::filesystem::path folder_;
};

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double noNumber = std::numeric_limits<double>::quiet_NaN();

TEST_P(BuildExtremes, AllPointsEqual)
{
  keepsAll(cloud(5000, millimetres(), [](int) { return glm::dvec3(1.0, 2.0, 3.0); }));
}

TEST_P(BuildExtremes, OnALineAndOnAPlane)
{
  keepsAll(cloud(5000, millimetres(), [](int i) { return glm::dvec3(0.003 * i, 0, 0); }));
  keepsAll(cloud(
    5000, millimetres(), [](int i) { return glm::dvec3(0.01 * (i % 70), 0.01 * (i / 70), 5.0); }));
  // A line that lies along no axis.
  keepsAll(
    cloud(5000, millimetres(), [](int i) { return glm::dvec3(0.001 * i, 0.002 * i, -0.001 * i); }));
}

TEST_P(BuildExtremes, ExtentsOfAMicrometreAndOfAMillionKilometres)
{
  const QuantisationGrid tiny{ glm::dvec3(1e-12), glm::dvec3(0.0) };
  auto random = std::make_shared<Random>(3);
  const auto inCube = [random](double side)
  { return glm::dvec3(random->uniform(), random->uniform(), random->uniform()) * side; };
  keepsAll(cloud(3000, tiny, [=](int) { return inCube(1e-6); }));
  const QuantisationGrid huge{ glm::dvec3(1.0), glm::dvec3(0.0) };
  keepsAll(cloud(3000, huge, [=](int) { return inCube(1e9); }));
}

TEST_P(BuildExtremes, MillimetresAtTenThousandKilometres)
{
  const glm::dvec3 far(1e7, -1e7, 1e4);
  auto random = std::make_shared<Random>(4);
  keepsAll(cloud(4000, millimetres(far),
    [=](int)
    {
      return far +
        0.001 *
        glm::floor(glm::dvec3(
          random->uniform() * 9000.0, random->uniform() * 9000.0, random->uniform() * 200.0));
    }));
}

TEST_P(BuildExtremes, OnePointAndNone)
{
  keepsAll(cloud(1, millimetres(), [](int) { return glm::dvec3(-4.0, 5.0, 6.0); }));
  keepsAll(cloud(0, millimetres(), [](int) { return glm::dvec3(0.0); }));
}

TEST_P(BuildExtremes, DuplicatesBeyondANode)
{
  // A third of the points at one place, the others apart.
  keepsAll(cloud(6000, millimetres(),
    [](int i)
    { return i % 3 == 0 ? glm::dvec3(0.5) : glm::dvec3(0.001 * i, 0.5, 0.002 * (i % 41)); }));
}

TEST_P(BuildExtremes, WhatIsNoPositionIsRejected)
{
  auto source = cloud(2000, millimetres(),
    [](int i)
    {
      return i == 5 ? glm::dvec3(noNumber, 0, 0)
        : i == 6    ? glm::dvec3(0, infinite, 0)
        : i == 8    ? glm::dvec3(0, 0, -infinite)
                    : glm::dvec3(0.01 * i, 0.02 * (i % 50), 0.0);
    });
  keepsAll(std::move(source), 3);
  // One of which nothing is left is no cloud.
  EXPECT_FALSE(build(cloud(10, millimetres(), [](int) { return glm::dvec3(noNumber); })).ok());
}

TEST_P(BuildExtremes, BoundsThatLieByAnUlpAndByAKilometre)
{
  const auto position = [](int i)
  { return glm::dvec3(0.001 * (i % 900), 0.001 * (i / 3), 0.001 * (i % 17)); };
  for (const double lie : { 0.0, 1000.0, -1000.0 })
  {
    auto source = cloud(5000, millimetres(), position);
    Bounds& bounds = source->editDescription().declaredBounds;
    bounds.high = lie == 0.0 ? glm::dvec3(std::nextafter(bounds.high.x, 0.0),
                                 std::nextafter(bounds.high.y, 0.0), bounds.high.z)
                             : bounds.high + lie;
    bounds.low += lie;
    keepsAll(std::move(source));
  }
}

TEST_P(BuildExtremes, ADenseBlock)
{
  constexpr int side = 40; // every place of the grid is taken
  keepsAll(cloud(side * side * side, millimetres(),
    [](int i) { return 0.001 * glm::dvec3(i % side, i / side % side, i / (side * side)); }));
}

INSTANTIATE_TEST_SUITE_P(Structures, BuildExtremes, testing::ValuesIn(shapes),
  [](const testing::TestParamInfo<Shape>& shape) { return shape.param.name; });

} // namespace
} // namespace pointfront::test
