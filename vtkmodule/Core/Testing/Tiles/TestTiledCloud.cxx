#include "StoreBuildTest.h"

#include "pointfront/Front/NodePruning.h"
#include "pointfront/Query/BoxRegion.h"
#include "pointfront/Query/QueryPlan.h"
#include "pointfront/Tiles/StoredCloudFormats.h"
#include "pointfront/Tiles/TiledCloud.h"
#include "pointfront/Tiles/TileFormat.h"

#include <map>
#include <set>

namespace pointfront
{
namespace
{
using namespace pointfront::test;
namespace fs = std::filesystem;

class Tiled : public StoreBuildTest
{
protected:
  void SetUp() override
  {
    StoreBuildTest::SetUp();
    options_.nodePoints = 64;
  }
  std::string at(const std::string& name) const { return (folder_ / name).string(); }

  std::string store(const std::string& name, std::unique_ptr<CloudSource> cloud)
  {
    options_.outputPath = at(name);
    const auto report = buildStore(one(std::move(cloud)), options_);
    EXPECT_TRUE(report) << report.error().what;
    return options_.outputPath;
  }
  /// 500 points of 16 m by 16 m, whose ids begin with `first`.
  std::unique_ptr<CloudSource> tile(
    std::uint32_t first, double x, const QuantisationGrid& grid = millimetres())
  {
    auto cloud = std::make_unique<CloudSource>("tile", idSchema(), grid);
    Random random(first + 1);
    for (std::uint32_t i = 0; i < 500; ++i)
    {
      const glm::dvec3 p{ x + 16.0 * random.uniform(), 16.0 * random.uniform(), random.uniform() };
      cloud->addPosition(grid.toWorld(grid.toGrid(p)));
      cloud->addValue(0, first + i);
      cloud->addValue(1, static_cast<std::uint16_t>(first + i));
      expected_[first + i] = cloud->positions().back();
    }
    return cloud;
  }
  std::shared_ptr<const StoredCloud> opened(const std::string& path) const
  {
    auto cloud = StoredCloudFormats::ofProcess().open(path);
    EXPECT_TRUE(cloud) << cloud.error().what;
    return cloud ? *cloud : nullptr;
  }
  std::string list(const std::string& text) const
  {
    std::ofstream(at("all.pfronts")) << text;
    return at("all.pfronts");
  }

  /// Every point of the query by its id; ids must differ and ascend.
  std::map<std::uint32_t, glm::dvec3> points(
    const StoredCloud& cloud, const PointQuery& query = {}) const
  {
    std::map<std::uint32_t, glm::dvec3> found;
    std::uint64_t behind = 0;
    const auto report = queryPoints(cloud, query, {},
      [&](QueryBatch& batch) -> Result<void>
      {
        for (std::size_t i = 0; i < batch.size(); ++i)
        {
          EXPECT_GE(batch.ids[i], behind);
          behind = batch.ids[i] + 1;
          std::uint32_t id = 0;
          std::memcpy(&id, batch.points.columns[0].data() + 4 * i, 4);
          EXPECT_TRUE(found.emplace(id, batch.points.positions[i]).second) << id << " twice";
        }
        return {};
      });
    EXPECT_TRUE(report) << report.error().what;
    return found;
  }

  std::map<std::uint32_t, glm::dvec3> expected_;
};

void expectSoundTable(const Hierarchy& table)
{
  std::uint64_t points = 0;
  std::set<NodeIndex> roots(table.roots().begin(), table.roots().end());
  for (NodeIndex i = 0; i < table.nodeCount(); ++i)
  {
    const Node row = table.node(i);
    EXPECT_EQ(row.firstPoint, points);
    points += row.pointCount;
    EXPECT_EQ(row.parent == noNode, roots.count(i) == 1);
    for (std::uint8_t c = 0; c < row.childCount; ++c)
    {
      const Node child = table.childOf(i, row, c);
      EXPECT_EQ(child.parent, i);
      EXPECT_EQ(child.level, row.level + 1);
      EXPECT_EQ(child.firstPoint, table.node(row.firstChild + c).firstPoint);
      Node peeked;
      ASSERT_EQ(table.peekChild(i, row, c, peeked), RowState::Here);
      EXPECT_EQ(peeked.firstPoint, child.firstPoint);
    }
  }
}

TEST_F(Tiled, ThreeStoresAreOneCloud)
{
  store("a.pfront", tile(0, 0.0));
  store("b.pfront", tile(1000, 16.0));
  options_.structure = Structure::KdTree;
  store("c.pfront", tile(2000, 32.0));
  const auto cloud = opened(list("# tiles\na.pfront\n\n  b.pfront \r\nc.pfront\na.pfront\n"));
  ASSERT_TRUE(cloud);
  EXPECT_EQ(cloud->description().pointCount, 1500u);
  EXPECT_EQ(cloud->description().layers.size(), 1u);
  EXPECT_TRUE(cloud->description().warnings.empty());
  EXPECT_EQ(cloud->hierarchy()->roots().size(), 3u);
  expectSoundTable(*cloud->hierarchy());
  EXPECT_EQ(points(*cloud), expected_);
  EXPECT_TRUE(cloud->verify()->ok);
  EXPECT_EQ(cloud->verify()->pointsChecked, 1500u);
  EXPECT_EQ(cloud->files().size(), 4u);

  PointQuery query;
  query.regions = { *BoxRegion::make({ { 10.0, 3.0, -1.0 }, { 40.0, 12.0, 2.0 } }) };
  query.attributes = { { "id" } };
  std::map<std::uint32_t, glm::dvec3> inside;
  for (const auto& [id, p] : expected_)
  {
    if (p.x >= 10.0 && p.x <= 40.0 && p.y >= 3.0 && p.y <= 12.0)
    {
      inside.emplace(id, p);
    }
  }
  EXPECT_EQ(points(*cloud, query), inside);
}

/// Points of a condition, and the nodes that were read for it.
TEST_F(Tiled, NodesThatAFilterExcludesAreNotRead)
{
  store("a.pfront", tile(0, 0.0));
  store("b.pfront", tile(1000, 16.0, { glm::dvec3(0.0015), glm::dvec3(0.0) }));
  options_.attributes = { { "id" } }; // no intensity
  store("c.pfront", tile(2000, 32.0));
  const auto cloud = opened(folder_.string());
  ASSERT_TRUE(cloud);
  const std::map<std::uint32_t, glm::dvec3> all = points(*cloud);
  ASSERT_EQ(all.size(), 1500u);
  Random random(7);
  for (int i = 0; i < 200; ++i)
  {
    const double low = 2600.0 * random.uniform();
    const double high = low + 300.0 * random.uniform();
    const std::string text = "id in [" + std::to_string(low) + ", " + std::to_string(high) + "]";
    PointQuery query;
    query.where = FilterExpression::parse(i % 2 == 0 ? text : "x in [10, 20] and " + text).value();
    std::map<std::uint32_t, glm::dvec3> wanted;
    for (const auto& [id, p] : all)
    {
      if (id >= low && id <= high && (i % 2 == 0 || (p.x >= 10.0 && p.x <= 20.0)))
      {
        wanted.emplace(id, p);
      }
    }
    EXPECT_EQ(points(*cloud, query), wanted) << text;
    const auto plan = QueryPlan::make(*cloud, query);
    ASSERT_TRUE(plan) << plan.error().what;
    EXPECT_TRUE(low >= 1000.0 || plan->nodeCount() < cloud->hierarchy()->nodeCount()) << text;
  }
  PointQuery bright;
  bright.where = FilterExpression::parse("intensity > 1400").value();
  EXPECT_EQ(points(*cloud, bright).size(), 99u);
  const auto few = QueryPlan::make(*cloud, bright);
  ASSERT_TRUE(few);
  EXPECT_LT(few->nodeCount(), cloud->hierarchy()->nodeCount() / 2); // none of a and c
}

/// Roots in two: the same points with the same ids; from afar the heads are enough.
TEST_F(Tiled, HeadsOfRootsAreEnoughFromAfar)
{
  options_.nodePoints = 4096;
  std::vector<std::shared_ptr<const StoredCloud>> tiles;
  std::map<std::uint32_t, glm::dvec3> all;
  for (std::uint32_t t = 0; t < 3; ++t)
  {
    auto cloud = std::make_unique<CloudSource>("tile", idSchema(), millimetres());
    Random random(t + 1);
    const std::uint32_t points = t == 1 ? 200 : 9000; // the middle one is its root alone
    for (std::uint32_t i = 0; i < points; ++i)
    {
      const glm::dvec3 p{ 100.0 * t + 90.0 * random.uniform(), 90.0 * random.uniform(), 0.0 };
      cloud->addPosition(millimetres().toWorld(millimetres().toGrid(p)));
      cloud->addValue(0, 10000 * t + i);
      cloud->addValue(1, static_cast<std::uint16_t>(i));
      all[10000 * t + i] = cloud->positions().back();
    }
    tiles.push_back(opened(store(std::string(1, char('a' + t)) + ".pfront", std::move(cloud))));
  }
  const auto whole = TiledCloud::make("tiles", tiles);
  const auto cut = TiledCloud::make("tiles", tiles, {}, 768);
  ASSERT_TRUE(whole && cut);
  const Hierarchy& table = *(*cut)->hierarchy();
  EXPECT_EQ(table.nodeCount(), (*whole)->hierarchy()->nodeCount() + 2);
  expectSoundTable(table);
  EXPECT_EQ(points(**cut), all);
  for (const NodeIndex root : table.roots())
  {
    const Node row = table.node(root);
    EXPECT_LE(row.pointCount, 256u);
    const auto head = (*cut)->read(root, { 0 });
    ASSERT_TRUE(head);
    ASSERT_EQ(head->size(), row.pointCount);
    EXPECT_LE(head->bytes(), sizeof(NodeColumns) + 256 * 16 + 64);
  }
  // Ids are those of the uncut cloud: by number, in the same order.
  std::vector<std::uint32_t> ids[2];
  for (int k = 0; k < 2; ++k)
  {
    const StoredCloud& cloud = k == 0 ? **whole : **cut;
    for (NodeIndex i = 0; i < cloud.hierarchy()->nodeCount(); ++i)
    {
      const auto node = cloud.read(i, { 0 });
      ASSERT_TRUE(node);
      ASSERT_EQ(node->firstPoint, ids[k].size());
      for (std::size_t p = 0; p < node->size(); ++p)
      {
        std::uint32_t id = 0;
        std::memcpy(&id, node->columns[0].data() + 4 * p, 4);
        ids[k].push_back(id);
      }
    }
  }
  EXPECT_EQ(ids[0], ids[1]);
  PointQuery query;
  query.where = FilterExpression::parse("id in [20000, 20100]").value();
  EXPECT_EQ(points(**cut, query).size(), 101u);
}

TEST_F(Tiled, RangesHoldTheValuesOfTheirNodes)
{
  store("a.pfront", tile(0, 0.0));
  store("b.pfront", tile(1000, 16.0, { glm::dvec3(0.0015), glm::dvec3(0.0) }));
  store("c.pfront", tile(2000, 32.0, { glm::dvec3(0.01), glm::dvec3(0.003) }));
  const auto cloud = opened(folder_.string());
  ASSERT_TRUE(cloud);
  const NodeIndex nodes = cloud->hierarchy()->nodeCount();
  const NodeIndex few = nodes / 2;
  EXPECT_EQ((*cloud->nodeRanges(0, few))->nodeCount(), few);
  for (std::uint32_t axis = 0; axis < coordinateComponents; ++axis)
  {
    const auto ranges = cloud->nodeRanges(axis);
    ASSERT_TRUE(ranges && *ranges);
    for (NodeIndex i = 0; i < nodes; ++i)
    {
      const auto node = cloud->read(i, {});
      ASSERT_TRUE(node);
      const ValueRange own = (*ranges)->own(i);
      for (const glm::u32vec3& position : node->positions)
      {
        const auto step = static_cast<double>(
          node->origin[static_cast<int>(axis)] + position[static_cast<int>(axis)]);
        ASSERT_TRUE(step >= own.low && step <= own.high) << axis << " of node " << i;
      }
    }
  }
}

TEST_F(Tiled, StoresThatLieFarApartAreTold)
{
  store("a.pfront", tile(0, 0.0));
  store("b.pfront", tile(1000, 100000.0));
  const auto cloud = opened(folder_.string());
  ASSERT_TRUE(cloud);
  ASSERT_EQ(cloud->description().warnings.size(), 1u);
  EXPECT_NE(cloud->description().warnings[0].find("far apart"), std::string::npos);
}

TEST_F(Tiled, AFolderIsItsStores)
{
  fs::create_directories(folder_ / "deeper");
  store("b.pfront", tile(0, 0.0));
  store("deeper/a.pfront", tile(1000, 16.0));
  std::ofstream(at("notes.txt")) << "notes";
  const auto cloud = opened(folder_.string());
  ASSERT_TRUE(cloud);
  EXPECT_EQ(points(*cloud), expected_);
  fs::create_directories(folder_ / "empty");
  EXPECT_FALSE(StoredCloudFormats::ofProcess().open(at("empty")));
}

TEST_F(Tiled, GridsApartByWholeStepsLoseNothing)
{
  store("a.pfront", tile(0, 0.0, millimetres({ 5.0, -7.25, 0.0 })));
  store("b.pfront", tile(1000, 16.0, { glm::dvec3(0.01), glm::dvec3(0.003) }));
  const auto cloud = opened(folder_.string());
  ASSERT_TRUE(cloud);
  EXPECT_TRUE(cloud->description().warnings.empty());
  const auto found = points(*cloud);
  ASSERT_EQ(found.size(), expected_.size());
  for (const auto& [id, p] : expected_)
  {
    EXPECT_LT(glm::length(found.at(id) - p), 1e-9) << id;
  }
}

TEST_F(Tiled, OtherGridsAreRoundedAndToldSo)
{
  store("a.pfront", tile(0, 0.0));
  store("b.pfront", tile(1000, 16.0, { glm::dvec3(0.0015), glm::dvec3(0.0) }));
  const auto cloud = opened(folder_.string());
  ASSERT_TRUE(cloud);
  ASSERT_EQ(cloud->description().warnings.size(), 1u);
  EXPECT_NE(cloud->description().warnings[0].find("1 of 2 stores"), std::string::npos);
  for (const auto& [id, p] : points(*cloud))
  {
    EXPECT_LE(glm::length(p - expected_.at(id)), 0.0005 * 1.7321) << id;
  }
}

TEST_F(Tiled, WhatDiffersIsTold)
{
  auto withSystem = tile(0, 0.0);
  withSystem->editDescription().crsWkt = "LOCAL_CS[\"one\"]";
  store("a.pfront", std::move(withSystem));
  auto other = tile(1000, 16.0);
  other->editDescription().crsWkt = "LOCAL_CS[\"other\"]";
  options_.attributes = { { "id" } };
  store("b.pfront", std::move(other));
  const auto cloud = opened(folder_.string());
  ASSERT_TRUE(cloud);
  std::string told;
  for (const std::string& warning : cloud->description().warnings)
  {
    told += warning + "\n";
  }
  EXPECT_NE(told.find("1 of 2 stores lack intensity"), std::string::npos) << told;
  EXPECT_NE(told.find("another coordinate reference system"), std::string::npos) << told;
  PointQuery query;
  query.where = FilterExpression::parse("intensity > 0").value();
  EXPECT_EQ(points(*cloud, query).size(), 499u); // the first point has 0, like all of b
}

TEST_F(Tiled, SubsetsAndRepresentativesDoNotMix)
{
  store("a.pfront", tile(0, 0.0));
  options_.refinement = Refinement::Replace;
  store("b.pfront", tile(1000, 16.0));
  const auto cloud = StoredCloudFormats::ofProcess().open(folder_.string());
  ASSERT_FALSE(cloud);
  EXPECT_NE(cloud.error().what.find("b.pfront"), std::string::npos) << cloud.error().what;
}

TEST_F(Tiled, StoresWithoutPointsHaveNoSay)
{
  store("a.pfront", tile(0, 0.0));
  AttributeSchema schema;
  schema.add({ "rgb", ScalarType::UInt16, 3 });
  schema.add({ "intensity", ScalarType::Float64, 2 });
  auto empty = std::make_unique<CloudSource>(
    "empty", schema, QuantisationGrid{ glm::dvec3(0.0007), glm::dvec3(0.0003) });
  empty->editDescription().crsWkt = "LOCAL_CS[\"other\"]";
  options_.refinement = Refinement::Replace;
  store("b.pfront", std::move(empty));
  const auto alone = opened(at("a.pfront"));
  for (const char* const lines : { "a.pfront\nb.pfront\n", "b.pfront\na.pfront\n" })
  {
    const auto cloud = opened(list(lines));
    ASSERT_TRUE(cloud);
    const StoreDescription& whole = cloud->description();
    EXPECT_EQ(whole.schema, alone->description().schema) << "all points would be black";
    EXPECT_EQ(whole.grid, alone->description().grid);
    EXPECT_EQ(whole.refinement, Refinement::Add);
    EXPECT_TRUE(whole.crsWkt.empty());
    EXPECT_TRUE(whole.warnings.empty()) << whole.warnings.front();
    EXPECT_EQ(whole.layers.size(), alone->description().layers.size());
    EXPECT_EQ(whole.fileBytes, fs::file_size(at("a.pfront")) + fs::file_size(at("b.pfront")));
    EXPECT_EQ(points(*cloud), expected_);
    EXPECT_TRUE(cloud->verify()->ok);
  }
  const auto nobody = opened(list("b.pfront\n"));
  ASSERT_TRUE(nobody);
  EXPECT_EQ(nobody->description().schema, opened(at("b.pfront"))->description().schema);
}

TEST_F(Tiled, ListsThatCannotBeUsedSayWhy)
{
  store("a.pfront", tile(0, 0.0));
  const auto refusal = [this](const std::string& text)
  {
    const auto cloud = StoredCloudFormats::ofProcess().open(list(text));
    return cloud ? std::string("opened") : cloud.error().what;
  };
  EXPECT_NE(refusal("# nothing\n\n").find("names no store"), std::string::npos);
  EXPECT_NE(refusal("a.pfront\nb.pfront\n").find("b.pfront"), std::string::npos);
  EXPECT_NE(refusal("x*.pfront\n").find("nothing matches"), std::string::npos);
  EXPECT_NE(refusal("all.pfronts\n").find("a list"), std::string::npos);
  EXPECT_NE(refusal(std::string("a\0b\n", 4)).find("line 1"), std::string::npos);
  EXPECT_EQ(refusal("*.pfront"), "opened");
}
} // namespace
} // namespace pointfront
