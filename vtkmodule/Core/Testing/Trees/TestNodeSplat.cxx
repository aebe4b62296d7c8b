#include "pointfront/Trees/NodeSplat.h"

#include "SplatPatterns.h"
#include "StoreBuildTest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace pointfront
{
namespace
{
using test::SplatPatterns;
using Points = std::vector<glm::dvec3>;
constexpr double extent = 100.0; ///< side of the patterns' unit square, metres
constexpr double step = 1e-4; ///< step of the grid

float radiusOf(const std::vector<TreePosition>& positions, const glm::dvec3& scale)
{
  TreeSpace space;
  space.grid.scale = scale;
  const RecordSpan view{ reinterpret_cast<const std::byte*>(positions.data()),
    sizeof(TreePosition) };
  std::vector<TreePosition> sorted;
  for (const std::uint32_t i : mortonOrder(view, positions.size()))
  {
    sorted.push_back(positions[i]);
  }
  std::vector<std::uint32_t> all(sorted.size());
  for (std::uint32_t i = 0; i < all.size(); ++i)
  {
    all[i] = i;
  }
  return NodeSplat(space).measure(
    { reinterpret_cast<const std::byte*>(sorted.data()), sizeof(TreePosition) }, all);
}

float radiusOf(const Points& points)
{
  std::vector<TreePosition> positions;
  for (const glm::dvec3& p : points)
  {
    const glm::dvec3 steps = (p * extent + 1.0) / step;
    positions.push_back(TreePosition(steps));
  }
  return radiusOf(positions, glm::dvec3(step));
}
} // namespace

TEST(NodeSplat, OneRadiusClosesAPlane)
{
  SplatPatterns patterns(1);
  for (const Points& points : { patterns.blueNoise(5000), patterns.scanLines(5000, 1.0),
         patterns.scanLines(5000, 2.0), patterns.scanLines(5000, 4.0) })
  {
    const double radius = radiusOf(points) / extent;
    const double h = 1.0 / std::sqrt(static_cast<double>(points.size()));
    EXPECT_LT(
      test::holesOf(points, [&](std::size_t) { return test::visibleShare * radius; }), 0.002);
    EXPECT_LT(radius, 1.45 * h); // 1 : 4 needs 1.29
  }
}

TEST(NodeSplat, WherePointsAreUnevenItClosesNearlyAll)
{
  SplatPatterns patterns(2);
  Points points;
  for (int i = 0; i < 5000; ++i)
  {
    points.emplace_back(patterns.uniform(), patterns.uniform(), 0.0);
  }
  const double radius = radiusOf(points) / extent;
  EXPECT_LT(test::holesOf(points, [&](std::size_t) { return test::visibleShare * radius; }), 0.01);
  EXPECT_LT(radius, 2.0 / std::sqrt(5000.0));
}

TEST(NodeSplat, Extremes)
{
  const glm::dvec3 scale(0.01);
  const std::uint32_t most = 0xffffffffu;
  EXPECT_EQ(radiusOf(std::vector<TreePosition>{}, scale), 0.0f);
  EXPECT_EQ(radiusOf({ TreePosition(7) }, scale), 0.0f);
  EXPECT_EQ(radiusOf(std::vector<TreePosition>(5000, TreePosition(7)), scale), 0.0f);
  // The corners of all that positions can be: they touch.
  const float across = radiusOf({ TreePosition(0), TreePosition(most) }, scale);
  EXPECT_NEAR(across, 1.25 * 0.5 * std::sqrt(3.0) * 0.01 * most, 1e-3 * across);
  std::vector<TreePosition> line;
  for (std::uint32_t i = 0; i < 1000; ++i)
  {
    line.emplace_back(100 * i, 0u, 0u);
  }
  EXPECT_NEAR(radiusOf(line, scale), 1.25 * 0.5, 1e-6);
  // A crowd in one place beside a plane.
  std::vector<TreePosition> crowd(4000, TreePosition(50, 50, 0));
  for (std::uint32_t i = 0; i < 1600; ++i)
  {
    crowd.emplace_back(100 * (i % 40), 100 * (i / 40), 0u);
  }
  const float beside = radiusOf(crowd, scale);
  EXPECT_GT(beside, 0.5f);
  EXPECT_LT(beside, 1.5f);
  // Degrees and metres.
  EXPECT_TRUE(std::isfinite(radiusOf(crowd, { 1e-7, 1e-7, 0.01 })));
  EXPECT_EQ(radiusOf(crowd, glm::dvec3(1e300)), 0.0f) << "larger than any float: not measured";
}

namespace
{
class SplatStore : public test::StoreBuildTest
{
protected:
  std::unique_ptr<test::CloudSource> cloudOf(const Points& points)
  {
    auto cloud = std::make_unique<test::CloudSource>(
      "plane", AttributeSchema(), QuantisationGrid{ glm::dvec3(step), glm::dvec3(0.0) });
    for (const glm::dvec3& p : points)
    {
      cloud->addPosition(p * extent + origin_);
    }
    return cloud;
  }
  glm::dvec3 origin_{ 0.0 };
};

Points pointsOf(const PointStore& store, NodeIndex node)
{
  Points points;
  const auto columns = store.read(node, {});
  for (const glm::u32vec3& p : columns->positions)
  {
    const GridPosition at = columns->origin + GridPosition(p);
    points.push_back(store.description().grid.toWorld(at));
  }
  return points;
}

/// All that is drawn when the tree is drawn down to a level.
Points drawnAt(const PointStore& store, unsigned level)
{
  Points points;
  for (NodeIndex i = 0; i < store.hierarchy()->nodeCount(); ++i)
  {
    const Node node = store.hierarchy()->node(i);
    const bool alone = store.hierarchy()->refinement() == Refinement::Replace;
    if (node.level == level || (node.level < level && (!alone || node.leaf())))
    {
      const Points own = pointsOf(store, i);
      points.insert(points.end(), own.begin(), own.end());
    }
  }
  return points;
}

/// Share of the places around the node's points that discs of its size do not cover.
double holesAround(const PointStore& store, NodeIndex index, const Points& drawn)
{
  const Node node = store.hierarchy()->node(index);
  const double radius = test::visibleShare * node.splatRadius;
  SplatPatterns places(index);
  int holes = 0;
  int count = 0;
  for (const glm::dvec3& p : pointsOf(store, index))
  {
    const glm::dvec3 at =
      p + glm::dvec3(places.uniform() - 0.5, places.uniform() - 0.5, 0.0) * (2.0 * node.spacing);
    const double inside = 0.05 * extent;
    if (++count % 4 == 0 && std::min(at.x, at.y) > inside && std::max(at.x, at.y) < extent - inside)
    {
      holes += std::any_of(drawn.begin(), drawn.end(),
                 [&](const glm::dvec3& q) { return std::hypot(q.x - at.x, q.y - at.y) <= radius; })
        ? 0
        : 1;
    }
  }
  return count == 0 ? 0.0 : 4.0 * holes / count;
}
} // namespace

// Every node of every kind of tree, drawn with those above it, closes its surface.
TEST_F(SplatStore, EveryNodeSaysWhatClosesIt)
{
  options_.nodePoints = 1000;
  SplatPatterns patterns(8);
  const Points plane = patterns.scanLines(20000, 2.0);
  for (const auto& [structure, refinement] : { std::pair(Structure::Octree, Refinement::Add),
         { Structure::Octree, Refinement::Replace }, { Structure::KdTree, Refinement::Add } })
  {
    options_.structure = structure;
    options_.refinement = refinement;
    const auto store = build(cloudOf(plane));
    const Hierarchy& table = *store->hierarchy();
    for (unsigned level = 0; level < store->description().levels; ++level)
    {
      const Points drawn = drawnAt(*store, level);
      for (NodeIndex i = 0; i < table.nodeCount(); ++i)
      {
        const Node node = table.node(i);
        ASSERT_GT(node.splatRadius, 0.0f) << "node " << i;
        if (node.level == level)
        {
          EXPECT_LT(holesAround(*store, i, drawn), 0.02)
            << "node " << i << ", level " << level << " of " << store->description().structure
            << ", leaf " << node.leaf() << ", radius / spacing " << node.splatRadius / node.spacing;
          EXPECT_EQ(store->read(i, {})->splatRadius, node.splatRadius);
        }
      }
    }
  }
}

TEST_F(SplatStore, DependsNeitherOnThreadsNorOnMemory)
{
  SplatPatterns patterns(9);
  const Points plane = patterns.scanLines(60000, 2.0);
  options_.nodePoints = 500;
  std::string first;
  for (const unsigned threads : { 1u, 2u, 7u })
  {
    for (const std::uint64_t memory : { std::uint64_t(0), std::uint64_t(4) << 20 })
    {
      options_.threads = threads;
      options_.memoryBytes = memory;
      build(cloudOf(plane));
      first = first.empty() ? bytes() : first;
      EXPECT_TRUE(bytes() == first) << threads << " threads, " << memory << " bytes";
    }
  }
}

// Ten thousand kilometres from the origin the same radii come out.
TEST_F(SplatStore, FarFromTheOriginItIsTheSame)
{
  SplatPatterns patterns(10);
  const Points plane = patterns.blueNoise(4000);
  options_.nodePoints = 1000;
  const auto here = build(cloudOf(plane));
  std::vector<float> radii;
  for (NodeIndex i = 0; i < here->hierarchy()->nodeCount(); ++i)
  {
    radii.push_back(here->hierarchy()->node(i).splatRadius);
  }
  origin_ = glm::dvec3(std::ldexp(1e4, 10), std::ldexp(1e4, 10), 0.0);
  const auto there = build(cloudOf(plane));
  ASSERT_EQ(there->hierarchy()->nodeCount(), radii.size());
  for (NodeIndex i = 0; i < radii.size(); ++i)
  {
    EXPECT_NEAR(there->hierarchy()->node(i).splatRadius, radii[i], 2e-3 * radii[i]);
  }
}

} // namespace pointfront
