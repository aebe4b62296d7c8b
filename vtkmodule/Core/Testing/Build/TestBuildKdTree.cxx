#include "Sanitizers.h"
#include "StoreBuildTest.h"

#include "pointfront/Trees/KdCut.h"

#include <array>
#include <functional>

namespace pointfront
{
namespace
{
using namespace pointfront::test;
namespace fs = std::filesystem;

class KdTreeBuild : public StoreBuildTest
{
protected:
  void SetUp() override
  {
    StoreBuildTest::SetUp();
    options_.structure = Structure::KdTree;
    options_.nodePoints = 64;
  }
};

std::uint32_t idOf(const NodeColumns& node, std::size_t point)
{
  std::uint32_t id;
  std::memcpy(&id, node.columns[0].data() + 4 * point, 4);
  return id;
}

void expectEveryPointOnce(const PointStore& store, std::size_t count)
{
  std::vector<bool> seen(count, false);
  for (NodeIndex n = 0; n < store.hierarchy()->nodeCount(); ++n)
  {
    const auto columns = store.read(n, { 0 });
    ASSERT_TRUE(columns) << columns.error().what;
    for (std::size_t i = 0; i < columns->size(); ++i)
    {
      ASSERT_LT(idOf(*columns, i), count);
      EXPECT_FALSE(seen[idOf(*columns, i)]);
      seen[idOf(*columns, i)] = true;
    }
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), true), static_cast<std::ptrdiff_t>(count));
}

/// In each layer all nodes but one have exactly `nodePoints` points, and that one is a leaf.
void expectEqualNodes(const PointStore& store, std::uint32_t nodePoints)
{
  const Hierarchy& hierarchy = *store.hierarchy();
  std::vector<unsigned> shortNodes(store.description().layers.size(), 0);
  for (NodeIndex n = 0; n < hierarchy.nodeCount(); ++n)
  {
    const Node& node = hierarchy.node(n);
    if (node.pointCount != nodePoints)
    {
      EXPECT_LT(node.pointCount, nodePoints);
      EXPECT_TRUE(node.leaf());
      ++shortNodes[node.layer];
    }
  }
  for (const unsigned count : shortNodes)
  {
    EXPECT_LE(count, 1u);
  }
}

TEST_F(KdTreeBuild, NodesAreEqualAndHoldEveryPointOnce)
{
  // 64 points a node, 16 nodes a part: two levels of parts and more.
  const auto store = build(hills(20000, 100000.0));
  EXPECT_EQ(store->description().structure, "kdtree");
  EXPECT_EQ(store->hierarchy()->nodeCount(), (20000u + 63) / 64);
  expectEveryPointOnce(*store, 20000);
  expectEqualNodes(*store, 64);
  EXPECT_LE(store->description().levels, 10u); // 313 nodes, balanced: 9 levels
}

TEST_F(KdTreeBuild, EvenNumbersOfNodesAreFullToTheLast)
{
  for (const std::size_t count : { 64u, 65u, 128u, 64u * 16, 64u * 16 + 1, 64u * 17, 64u * 100 })
  {
    const auto store = build(hills(count, 100000.0));
    EXPECT_EQ(store->hierarchy()->nodeCount(), (count + 63) / 64) << count;
    expectEveryPointOnce(*store, count);
    expectEqualNodes(*store, 64);
  }
}

TEST_F(KdTreeBuild, SameBytesForAnyThreadsAndMemory)
{
  std::uint64_t spilled = 0;
  const auto built = [&](unsigned threads, std::uint64_t memory, const Bounds* declared)
  {
    options_.threads = threads;
    options_.memoryBytes = memory;
    auto cloud = hills(60000, 100000.0);
    if (declared != nullptr)
    {
      cloud->editDescription().declaredBounds = *declared;
    }
    const auto report = buildStore(one(std::move(cloud)), options_);
    EXPECT_TRUE(report) << report.error().what;
    spilled = report ? report->spilledBytes : 0;
    return bytes();
  };
  const std::string reference = built(1, 1u << 30, nullptr);
  EXPECT_EQ(spilled, 0u);
  EXPECT_GT(reference.size(), 100000u);
  EXPECT_TRUE(built(4, 1u << 30, nullptr) == reference);
  EXPECT_TRUE(built(2, 500 << 10, nullptr) == reference);
  EXPECT_GT(spilled, 0u);
  if (test::underThreadSanitizer())
  {
    return; // the threads of the other builds are the same, and take seconds each
  }
  EXPECT_TRUE(built(3, 900 << 10, nullptr) == reference);
  const Bounds tiny{ glm::dvec3(0.0), glm::dvec3(0.001) };
  const Bounds huge{ glm::dvec3(-1e6), glm::dvec3(1e6) };
  EXPECT_TRUE(built(2, 1u << 30, &tiny) == reference);
  EXPECT_TRUE(built(2, 1u << 30, &huge) == reference);
}

TEST_F(KdTreeBuild, TheRootIsSpreadOverAll)
{
  options_.nodePoints = 1024;
  const auto store = build(hills(40000, 100000.0));
  const auto root = store->read(0, {});
  ASSERT_TRUE(root);
  ASSERT_EQ(root->size(), 1024u);
  // An 16 x 16 grid over the square: 4 points a cell, none empty, none with more than thrice.
  std::array<unsigned, 256> cells{};
  for (const glm::u32vec3& p : root->positions)
  {
    const glm::dvec3 world =
      store->description().grid.toWorld(root->origin + GridPosition(p)); // 100 m a side
    const auto x = std::min(15u, static_cast<unsigned>(world.x / 100.0 * 16.0));
    const auto y = std::min(15u, static_cast<unsigned>(world.y / 100.0 * 16.0));
    ++cells[16 * y + x];
  }
  EXPECT_GE(*std::min_element(cells.begin(), cells.end()), 1u);
  EXPECT_LE(*std::max_element(cells.begin(), cells.end()), 12u);
}

TEST_F(KdTreeBuild, ABorderCrossesNoMoreThanACell)
{
  // The halves of the root meet in a plane, but for the cells that the median goes through.
  const auto store = build(hills(20000, 100000.0));
  const Node& root = store->hierarchy()->node(0);
  ASSERT_EQ(root.childCount, 2);
  const Bounds left = store->hierarchy()->node(root.firstChild).box();
  const Bounds right = store->hierarchy()->node(root.firstChild + 1).box();
  const double overlapX = left.high.x - right.low.x;
  const double overlapY = left.high.y - right.low.y;
  EXPECT_LT(std::min(overlapX, overlapY), 1.0); // the cloud is 100 m wide
}

/// hills() with a class each: most 2, every tenth 5, one single point 6.
std::unique_ptr<CloudSource> classified(std::size_t count)
{
  AttributeSchema schema = idSchema();
  schema.add({ "classification", ScalarType::UInt8, 1 });
  const auto plain = hills(count, 100000.0);
  auto cloud = std::make_unique<CloudSource>("cloud", schema, millimetres());
  for (std::size_t i = 0; i < count; ++i)
  {
    cloud->addPosition(plain->positions()[i]);
    cloud->addValue(0, static_cast<std::uint32_t>(i));
    cloud->addValue(1, static_cast<std::uint16_t>(i * 7));
    cloud->addValue(2, static_cast<std::uint8_t>(i == 4711 ? 6 : i % 10 == 0 ? 5 : 2));
  }
  return cloud;
}

void expectClassLayers(const PointStore& store)
{
  const std::vector<Layer>& layers = store.description().layers;
  ASSERT_EQ(layers.size(), 3u);
  EXPECT_EQ(layers[0].objectClass, 2);
  EXPECT_EQ(layers[0].name, "ground");
  EXPECT_EQ(layers[0].pointCount, 17999u);
  EXPECT_EQ(layers[1].objectClass, 5);
  EXPECT_EQ(layers[1].name, "high vegetation");
  EXPECT_EQ(layers[1].pointCount, 2000u);
  EXPECT_EQ(layers[2].objectClass, 6);
  EXPECT_EQ(layers[2].name, "building");
  EXPECT_EQ(layers[2].pointCount, 1u);
  EXPECT_EQ(layers[2].nodeCount, 1u);
  ASSERT_EQ(store.hierarchy()->roots().size(), 3u);
  for (NodeIndex n = 0; n < store.hierarchy()->nodeCount(); ++n)
  {
    const auto points = store.read(n, { 2 });
    ASSERT_TRUE(points);
    for (const std::byte value : points->columns[0])
    {
      EXPECT_EQ(std::to_integer<int>(value), layers[store.hierarchy()->node(n).layer].objectClass);
    }
  }
}

TEST_F(KdTreeBuild, OneTreeForEachClass)
{
  options_.layering = Layering::Automatic;
  const auto store = build(classified(20000));
  expectClassLayers(*store);
  expectEveryPointOnce(*store, 20000);
  expectEqualNodes(*store, 64);
  const std::string reference = bytes();
  options_.threads = 4;
  options_.memoryBytes = 500 << 10;
  build(classified(20000));
  EXPECT_TRUE(bytes() == reference);
}

TEST_F(KdTreeBuild, OctreesHaveLayersToo)
{
  options_.structure = Structure::Octree;
  options_.layering = Layering::ObjectClass;
  for (const Refinement refinement : { Refinement::Add, Refinement::Replace })
  {
    options_.refinement = refinement;
    options_.memoryBytes = 0;
    options_.threads = 1;
    expectClassLayers(*build(classified(20000)));
    const std::string reference = bytes();
    options_.threads = 4;
    options_.memoryBytes = 300 << 10;
    build(classified(20000));
    EXPECT_TRUE(bytes() == reference);
  }
}

TEST_F(KdTreeBuild, PointsThatNobodyClassifiedShareATree)
{
  options_.layering = Layering::Automatic;
  AttributeSchema schema;
  schema.add({ "classification", ScalarType::UInt8, 1 });
  auto cloud = std::make_unique<CloudSource>("cloud", schema, millimetres());
  for (unsigned i = 0; i < 1000; ++i)
  {
    cloud->addPosition({ i * 0.1, 0.0, 0.0 });
    cloud->addValue(0, static_cast<std::uint8_t>(i % 2));
  }
  const auto store = build(std::move(cloud));
  ASSERT_EQ(store->description().layers.size(), 1u);
  EXPECT_EQ(store->description().layers[0].name, "all");
}

TEST_F(KdTreeBuild, RefusesWhatItCannotDo)
{
  options_.layering = Layering::ObjectClass; // a cloud without classes
  const auto noClass = buildStore(one(hills(100, 1000.0)), options_);
  ASSERT_FALSE(noClass);
  EXPECT_NE(noClass.error().what.find("classification"), std::string::npos);
  EXPECT_FALSE(fs::exists(options_.outputPath));
}

std::uint64_t owedBy(const KdCut& cut, std::size_t node)
{
  std::uint64_t points = 0;
  for (const KdShare& share : cut.shares()[node])
  {
    points += share.points;
  }
  return points;
}

TEST(KdCut, OfLeavesOnlyJoinsTwoDivisionsAndOwesNothing)
{
  Random random(4);
  std::vector<KdCell> cells;
  std::uint64_t total = 0;
  for (std::uint32_t i = 0; i < 4096; ++i)
  {
    const std::uint64_t count = 1 + random.next() % 80;
    cells.push_back({ { (i % 64) << 8, (i / 64) << 8, 0 }, count });
    total += count;
  }
  KdRule rule;
  rule.nodePoints = 100;
  rule.leavesOnly = true;
  const KdCut cut(cells, rule, 3);
  std::uint64_t inParts = 0;
  std::size_t inner = 0;
  for (std::size_t n = 0; n < cut.tree().size(); ++n)
  {
    const PartNode& node = cut.tree()[n];
    EXPECT_TRUE(cut.shares()[n].empty());
    if (node.part != PartNode::none)
    {
      inParts += node.count;
      EXPECT_LE(node.count, rule.partPoints());
      continue;
    }
    ++inner;
    EXPECT_GE(node.children.size(), 2u);
    EXPECT_LE(node.children.size(), 4u);
    std::uint64_t below = 0;
    for (const std::uint32_t child : node.children)
    {
      EXPECT_GT(child, n);
      EXPECT_EQ(cut.tree()[child].parent, n);
      below += cut.tree()[child].count;
    }
    EXPECT_EQ(below, node.count);
  }
  EXPECT_EQ(inParts, total);
  EXPECT_GT(inner, 10u);
  EXPECT_EQ(cut.shares().size(), cut.tree().size());
}

TEST(KdCut, PartsHaveWholeNodesAndOweExactlyWhatIsAsked)
{
  Random random(3);
  std::vector<KdCell> cells;
  std::uint64_t total = 0;
  for (std::uint32_t i = 0; i < 4000; ++i)
  {
    const std::uint64_t count = i % 97 == 0 ? 3000 : 1 + random.next() % 40;
    cells.push_back({ { (i % 64) << 8, (i / 64) << 8, 0 }, count });
    total += count;
  }
  KdRule rule;
  rule.nodePoints = 100;
  const KdCut cut(cells, rule, 7);
  std::uint64_t moved = 0;
  std::vector<std::uint64_t> got(cut.tree().size(), 0);
  unsigned unfilled = 0;
  for (std::size_t n = 0; n < cut.tree().size(); ++n)
  {
    EXPECT_EQ(cut.tree()[n].layer, 7);
    if (cut.tree()[n].part == PartNode::none)
    {
      EXPECT_EQ(cut.tree()[n].children.size(), 2u);
      continue;
    }
    const std::uint64_t own = cut.tree()[n].count - owedBy(cut, n);
    EXPECT_LE(own, rule.partPoints());
    unfilled += own % rule.nodePoints != 0 ? 1 : 0;
    moved += cut.tree()[n].count;
    for (const KdShare& share : cut.shares()[n])
    {
      got[share.node] += share.points;
    }
  }
  EXPECT_EQ(moved, total);
  EXPECT_LE(unfilled, 1u);
  for (std::size_t n = 0; n < cut.tree().size(); ++n)
  {
    EXPECT_EQ(got[n], cut.tree()[n].part == PartNode::none ? rule.nodePoints : 0u) << n;
  }
}

TEST(KdCut, ACellIsDividedOnlyWhereTheMedianGoesThrough)
{
  // One cell of 4000 among cells of one point: divided; parts get what is said.
  std::vector<KdCell> cells{ { { 0, 0, 0 }, 4000 } };
  for (std::uint32_t i = 1; i < 50; ++i)
  {
    cells.push_back({ { i << 8, 0, 0 }, 1 });
  }
  KdRule rule;
  rule.nodePoints = 100;
  const KdCut cut(cells, rule, 0);
  std::vector<std::uint64_t> points(cut.partCount(), 0);
  const std::function<void(std::uint32_t, std::uint64_t)> walk =
    [&](std::uint32_t place, std::uint64_t count)
  {
    const KdPlace& p = cut.places()[place];
    if (p.part != KdPlace::none)
    {
      points[p.part] += count;
      return;
    }
    ASSERT_GT(p.first, 0u);
    ASSERT_LT(p.first, count);
    walk(p.left, p.first);
    walk(p.right, count - p.first);
  };
  EXPECT_EQ(cut.places()[0].part, KdPlace::none);
  for (std::uint32_t i = 0; i < cells.size(); ++i)
  {
    walk(i, cells[i].count);
  }
  for (const PartNode& node : cut.tree())
  {
    if (node.part != PartNode::none)
    {
      EXPECT_EQ(points[node.part], node.count);
    }
  }
}
} // namespace
} // namespace pointfront
