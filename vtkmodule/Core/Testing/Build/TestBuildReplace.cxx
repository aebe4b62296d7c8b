#include "StoreBuildTest.h"

#include "pointfront/Export/StoreExport.h"
#include "pointfront/Means/MeanRecord.h"
#include "pointfront/Points/NormalAttribute.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace pointfront
{
namespace
{
using namespace pointfront::test;
namespace fs = std::filesystem;

class ReplaceBuild
  : public StoreBuildTest
  , public testing::WithParamInterface<Structure>
{
protected:
  void SetUp() override
  {
    StoreBuildTest::SetUp();
    options_.refinement = Refinement::Replace;
    options_.structure = GetParam();
    options_.nodePoints = isKdTree() ? 64 : 256; // its parts have a fixed number of nodes
  }
  static bool isKdTree() { return GetParam() == Structure::KdTree; }
};

INSTANTIATE_TEST_SUITE_P(Structures, ReplaceBuild,
  testing::Values(Structure::Octree, Structure::KdTree),
  [](const auto& instance)
  { return std::string(instance.param == Structure::KdTree ? "KdTree" : "Octree"); });

template <typename T>
T valueOf(const NodeColumns& node, std::size_t column, std::size_t point)
{
  T value;
  std::memcpy(&value, node.columns[column].data() + point * sizeof(T), sizeof(T));
  return value;
}

struct Spheres
{
  std::vector<glm::dvec3> centres;
  std::vector<double> radii;

  bool hold(const glm::dvec3& point) const
  {
    for (std::size_t i = 0; i < centres.size(); ++i)
    {
      if (glm::length(point - centres[i]) <= radii[i] * (1.0 + 1e-6) + 1e-9)
      {
        return true;
      }
    }
    return false;
  }
};

std::vector<glm::dvec3> worldOf(const NodeColumns& node, const QuantisationGrid& grid)
{
  std::vector<glm::dvec3> world;
  for (const glm::u32vec3& p : node.positions)
  {
    world.push_back(grid.toWorld(node.origin + GridPosition(p)));
  }
  return world;
}

/// Every original point below a node must lie in a sphere of one of the node's representatives.
void expectEnclosed(const PointStore& store)
{
  const Hierarchy& hierarchy = *store.hierarchy();
  const QuantisationGrid& grid = store.description().grid;
  const auto radius = store.description().schema.find(enclosingRadiusName);
  ASSERT_TRUE(radius);
  const auto column = static_cast<std::uint32_t>(*radius);
  for (NodeIndex leaf = 0; leaf < hierarchy.nodeCount(); ++leaf)
  {
    if (!hierarchy.node(leaf).leaf())
    {
      continue;
    }
    const auto points = store.read(leaf, { column });
    ASSERT_TRUE(points);
    for (std::size_t i = 0; i < points->size(); ++i)
    {
      EXPECT_EQ(valueOf<float>(*points, 0, i), 0.0f);
    }
    const std::vector<glm::dvec3> world = worldOf(*points, grid);
    for (NodeIndex above = hierarchy.node(leaf).parent; above != noNode;
         above = hierarchy.node(above).parent)
    {
      const auto means = store.read(above, { column });
      ASSERT_TRUE(means);
      Spheres spheres;
      spheres.centres = worldOf(*means, grid);
      for (std::size_t i = 0; i < means->size(); ++i)
      {
        spheres.radii.push_back(valueOf<float>(*means, 0, i));
      }
      for (std::size_t i = 0; i < world.size(); i += 7)
      {
        ASSERT_TRUE(spheres.hold(world[i])) << "leaf " << leaf << ", node " << above;
      }
    }
  }
}

/// Leaves of one size but one, and inner nodes of about as many points with two to four children.
void expectBalance(const Hierarchy& hierarchy)
{
  int unfilled = 0;
  double inner = 0.0;
  double means = 0.0;
  for (NodeIndex n = 0; n < hierarchy.nodeCount(); ++n)
  {
    const Node node = hierarchy.node(n);
    EXPECT_LE(node.pointCount, node.leaf() ? 64u : 128u);
    unfilled += node.leaf() && node.pointCount < 64 ? 1 : 0;
    EXPECT_TRUE(node.leaf() || (node.childCount >= 2 && node.childCount <= 4)) << n;
    inner += node.leaf() ? 0.0 : 1.0;
    means += node.leaf() ? 0.0 : node.pointCount;
  }
  EXPECT_LE(unfilled, 1);
  EXPECT_GT(means / inner, 32.0);
  EXPECT_GE(hierarchy.node(0).pointCount, 16u);
}

TEST_P(ReplaceBuild, LeavesHoldEveryPointOnceAndSpheresHoldWhatIsBelow)
{
  const auto store = build(hills(20000, 100000.0));
  const Hierarchy& hierarchy = *store->hierarchy();
  EXPECT_EQ(store->description().pointCount, 20000u);
  EXPECT_EQ(store->description().refinement, Refinement::Replace);
  EXPECT_EQ(store->description().layers.front().pointCount, 20000u);
  std::vector<bool> seen(20000, false);
  std::uint64_t representatives = 0;
  for (NodeIndex n = 0; n < hierarchy.nodeCount(); ++n)
  {
    const auto columns = store->read(n, { 0 });
    ASSERT_TRUE(columns);
    if (!hierarchy.node(n).leaf())
    {
      representatives += columns->size();
      continue;
    }
    EXPECT_LE(columns->size(), options_.nodePoints);
    for (std::size_t i = 0; i < columns->size(); ++i)
    {
      const auto id = valueOf<std::uint32_t>(*columns, 0, i);
      ASSERT_LT(id, seen.size());
      EXPECT_FALSE(seen[id]);
      seen[id] = true;
    }
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), true), 20000);
  EXPECT_GT(representatives, 2000u);
  // A third, a ninth ... of the points at most; in a kd-tree a half, a quarter ...
  EXPECT_LT(representatives, isKdTree() ? 14000u : 10000u);
  EXPECT_EQ(hierarchy.node(0).pointsBelow, 20000u);
  expectEnclosed(*store);
  if (isKdTree())
  {
    expectBalance(hierarchy);
  }
}

TEST_P(ReplaceBuild, RepresentativesAreMeansOfTheInput)
{
  // Two clumps far apart end in one representative, through those of the clumps.
  //   x = 0 and 2 mm, 600 points each         x = 1000002 and 1000008 mm, 600 points each
  const auto cloud = [](std::size_t i) -> GridPosition
  {
    const std::int64_t odd = i % 2;
    return i < 1200 ? GridPosition(2 * odd, 0, 0) : GridPosition(1000002 + 6 * odd, 0, 0);
  };
  const auto store = build(cloudOf(2400, millimetres(), cloud));
  const auto root = store->read(0, { 1, 2 });
  ASSERT_TRUE(root);
  if (isKdTree())
  {
    EXPECT_LE(root->size(), 4u); // there are ten leaves; the octree has more levels
    return;
  }
  ASSERT_EQ(root->size(), 1u);
  double intensity = 0.0;
  for (std::size_t i = 0; i < 2400; ++i)
  {
    intensity += static_cast<double>((i * 7) & 0xffff) / 2400.0;
  }
  EXPECT_EQ(root->origin.x + root->positions[0].x, 500003);
  EXPECT_NEAR(valueOf<std::uint16_t>(*root, 0, 0), intensity, 0.501);
  EXPECT_NEAR(valueOf<float>(*root, 1, 0), 500.005, 1e-3);
}

TEST_P(ReplaceBuild, SameBytesForAnyThreadsAndMemory)
{
  const auto built = [&](unsigned threads, std::uint64_t memory)
  {
    options_.threads = threads;
    options_.memoryBytes = memory;
    const auto report = buildStore(one(hills(40000, 100000.0)), options_);
    EXPECT_TRUE(report) << report.error().what;
    return bytes();
  };
  const std::string reference = built(1, 1u << 30);
  EXPECT_GT(reference.size(), 100000u);
  EXPECT_TRUE(built(4, 1u << 30) == reference);
  EXPECT_TRUE(built(2, 400 << 10) == reference);
  EXPECT_TRUE(built(3, 1000 << 10) == reference);
}

/// Counts points and keeps the schema.
class CountingSink final : public PointSink
{
public:
  Result<void> begin(const SinkDescription& description) override
  {
    schema = description.schema;
    announced = description.pointCount;
    return {};
  }
  Result<void> append(const PointBatch& batch) override
  {
    EXPECT_EQ(batch.columns.size(), schema.size());
    points += batch.size();
    return {};
  }
  Result<void> finish() override { return {}; }

  AttributeSchema schema;
  std::uint64_t announced = 0;
  std::uint64_t points = 0;
};

TEST_P(ReplaceBuild, ExportGivesTheInputAndRepresentativesOnlyWhereASpacingIsAsked)
{
  const auto store = build(hills(20000, 100000.0));
  CountingSink all;
  ASSERT_TRUE(exportStore(*store, {}, all));
  EXPECT_EQ(all.points, 20000u);
  EXPECT_EQ(all.announced, 20000u);
  EXPECT_TRUE(all.schema == idSchema());
  ExportSelection coarse;
  coarse.spacing = store->hierarchy()->node(0).spacing;
  CountingSink means;
  ASSERT_TRUE(exportStore(*store, coarse, means));
  EXPECT_EQ(means.points, store->hierarchy()->node(0).pointCount);
  EXPECT_TRUE(means.schema.find(enclosingRadiusName));
}

TEST_P(ReplaceBuild, RefusesAnInputThatHasTheColumnAlready)
{
  AttributeSchema schema;
  schema.add(enclosingRadiusAttribute());
  auto cloud = std::make_unique<CloudSource>("cloud", schema, millimetres());
  cloud->addPosition({ 0.0, 0.0, 0.0 });
  cloud->addValue(0, 1.0f);
  const auto report = buildStore(one(std::move(cloud)), options_);
  ASSERT_FALSE(report);
  EXPECT_NE(report.error().what.find(enclosingRadiusName), std::string::npos);
  EXPECT_FALSE(fs::exists(options_.outputPath));
}

/// Points with an id, a normal as the passes store it (half of them with none or of another
/// length) and values that no mean of one value gives back: NaN, -0, integers beyond doubles.
std::unique_ptr<CloudSource> oriented(std::size_t count)
{
  AttributeSchema schema;
  schema.add({ "id", ScalarType::UInt32, 1 });
  schema.add(normalAttribute());
  schema.add({ "height", ScalarType::Float32, 1 });
  schema.add({ "stamp", ScalarType::Int64, 1, 0.5 });
  auto cloud = std::make_unique<CloudSource>("cloud", schema, millimetres());
  Random random(5);
  for (std::size_t i = 0; i < count; ++i)
  {
    const double x = random.uniform();
    const double y = random.uniform();
    cloud->addPosition({ std::round(x * 1e5) / 1e3, std::round(y * 1e5) / 1e3, 0.0 });
    cloud->addValue(0, static_cast<std::uint32_t>(i));
    const PackedNormal unit = packNormal(glm::normalize(glm::dvec3(x - 0.5, y - 0.5, 1.0)));
    const PackedNormal other(static_cast<std::int16_t>(i % 300), 20000, -7);
    cloud->addValue(1, i % 4 == 1 ? PackedNormal(0) : i % 4 == 3 ? other : unit);
    cloud->addValue(2, i % 3 == 0 ? std::nanf("") : i % 3 == 1 ? -0.0f : 0.1f);
    cloud->addValue(3, (std::int64_t(1) << 62) + static_cast<std::int64_t>(i));
  }
  return cloud;
}

/// The points that a cloud's leaves do not hold bit for bit.
std::size_t changedPoints(const PointStore& store, const CloudSource& cloud)
{
  const AttributeSchema& schema = cloud.description().schema;
  std::size_t changed = 0;
  for (NodeIndex n = 0; n < store.hierarchy()->nodeCount(); ++n)
  {
    const auto node = store.read(n, { 0, 1, 2, 3 });
    EXPECT_TRUE(node);
    for (std::size_t i = 0; store.hierarchy()->node(n).leaf() && i < node->size(); ++i)
    {
      const auto id = valueOf<std::uint32_t>(*node, 0, i);
      bool same = true;
      for (std::size_t c = 0; c < schema.size(); ++c)
      {
        const std::size_t bytes = schema[c].bytes();
        same = same &&
          std::memcmp(
            node->columns[c].data() + i * bytes, cloud.column(c).data() + id * bytes, bytes) == 0;
      }
      changed += same ? 0 : 1;
    }
  }
  return changed;
}

TEST_P(ReplaceBuild, LeavesHoldTheInputBitForBit)
{
  // One leaf, leaves of one part, and leaves of many parts that join or grow together.
  for (const auto& [count, memory] : { std::pair<std::size_t, std::uint64_t>(50, 1u << 30),
         { 3000, 1u << 30 }, { 40000, 500 << 10 } })
  {
    options_.memoryBytes = memory;
    auto cloud = oriented(count);
    const CloudSource input = *cloud;
    const auto store = build(std::move(cloud));
    EXPECT_EQ(store->description().schema.find("stamp"), std::optional<std::size_t>(3));
    EXPECT_EQ(changedPoints(*store, input), 0u) << count;
  }
}

/// Upwards and outwards from the centre of a square of 100 m.
glm::dvec3 normalAt(const glm::dvec3& place)
{
  return glm::normalize(glm::dvec3(place.x / 100.0 - 0.5, place.y / 100.0 - 0.5, 1.0));
}

TEST_P(ReplaceBuild, RepresentativesHaveUnitNormalsInTheScaleOfTheColumn)
{
  AttributeSchema schema;
  schema.add(normalAttribute());
  auto cloud = std::make_unique<CloudSource>("cloud", schema, millimetres());
  Random random(6);
  for (std::size_t i = 0; i < 20000; ++i)
  {
    const glm::dvec3 place(100.0 * random.uniform(), 100.0 * random.uniform(), 0.0);
    cloud->addPosition(place);
    cloud->addValue(0, packNormal(normalAt(place)));
  }
  const auto store = build(std::move(cloud));
  std::size_t representatives = 0;
  for (NodeIndex n = 0; n < store->hierarchy()->nodeCount(); ++n)
  {
    const auto node = store->read(n, { 0 });
    ASSERT_TRUE(node);
    const std::vector<glm::dvec3> world = worldOf(*node, store->description().grid);
    for (std::size_t i = 0; !store->hierarchy()->node(n).leaf() && i < node->size(); ++i)
    {
      const glm::dvec3 stored(valueOf<PackedNormal>(*node, 0, i));
      ASSERT_NEAR(glm::length(stored), normalSteps, 2.0) << "node " << n;
      ASSERT_GT(glm::dot(stored / double(normalSteps), normalAt(world[i])), 0.98) << "node " << n;
      ++representatives;
    }
  }
  EXPECT_GT(representatives, 2000u);
}

TEST(MeanRecord, CodesComeFromTheNearestAndNormalsKeepLengthOne)
{
  AttributeSchema schema;
  schema.add({ "classification", ScalarType::UInt8, 1 });
  schema.add({ "normal", ScalarType::Float32, 3 });
  schema.add(enclosingRadiusAttribute());
  TreeSpace space;
  space.grid = millimetres();
  const RecordLayout layout(schema);
  const auto record = [&](std::uint32_t x, std::uint8_t code, const glm::vec3& normal)
  {
    std::vector<std::byte> bytes(layout.bytes());
    setPosition(bytes.data(), { x, 0, 0 });
    std::memcpy(bytes.data() + layout.offset(0), &code, 1);
    std::memcpy(bytes.data() + layout.offset(1), &normal, 12);
    return bytes;
  };
  const float nan = std::nanf("");
  const auto a = record(0, 6, { 1.0f, 0.0f, 0.0f });
  const auto b = record(10, 2, { 0.0f, 1.0f, 0.0f });
  const auto c = record(14, 5, { nan, nan, nan });
  MeanRecord form(space, schema);
  std::vector<std::byte> mean(form.bytes());
  form.summarise({ { a.data(), true }, { b.data(), true }, { c.data(), true } }, 0, 3, mean.data());
  EXPECT_EQ(positionOf(mean.data()), TreePosition(8, 0, 0));
  EXPECT_EQ(std::to_integer<int>(mean[layout.offset(0)]), 2); // 10 is nearest to 8
  glm::vec3 normal;
  std::memcpy(&normal, mean.data() + layout.offset(1), 12);
  EXPECT_NEAR(normal.x, std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(normal.y, std::sqrt(0.5), 1e-6);
  float radius;
  std::memcpy(&radius, mean.data() + layout.offset(2), 4);
  EXPECT_NEAR(radius, 0.008, 1e-8);
  EXPECT_GE(radius, 0.008);
}
} // namespace
} // namespace pointfront
