#include "CollectionTest.h"
#include "GoldenFiles.h"
#include "SampleStore.h"

#include "pointfront/Query/BoxRegion.h"
#include "pointfront/Query/NodeOfPoint.h"
#include "pointfront/Tiles/StoredCloudFormats.h"

namespace pointfront
{
namespace
{
using namespace pointfront::test;
namespace fs = std::filesystem;

class Collections : public CollectionTest
{
};

/// Every rule that one table has, from its first node to its last.
void expectSoundTable(const Hierarchy& table)
{
  std::uint64_t points = 0;
  const std::set<NodeIndex> roots(table.roots().begin(), table.roots().end());
  for (NodeIndex i = 0; i < table.nodeCount(); ++i)
  {
    const Node row = table.node(i);
    EXPECT_EQ(row.firstPoint, points) << i;
    points += row.pointCount;
    EXPECT_EQ(row.parent == noNode, roots.count(i) == 1) << i;
    std::uint64_t below = row.pointCount;
    for (std::uint8_t c = 0; c < row.childCount; ++c)
    {
      const Node child = table.childOf(i, row, c);
      EXPECT_EQ(child.parent, i);
      EXPECT_EQ(child.level, row.level + 1);
      EXPECT_EQ(child.firstPoint, table.node(row.firstChild + c).firstPoint);
      EXPECT_LE(child.spacing, row.spacing * 1.0001f) << i;
      EXPECT_TRUE(row.box().contains(child.box().low - glm::dvec3(-1e-6))) << i;
      below += child.pointsBelow;
      Node links; // all that the front gives
      links.firstChild = row.firstChild;
      links.level = row.level;
      Node peeked;
      ASSERT_EQ(table.peekChild(i, links, c, peeked), RowState::Here);
      EXPECT_EQ(peeked.firstPoint, child.firstPoint);
    }
    EXPECT_EQ(row.pointsBelow, below) << i;
    if (row.pointCount > 0)
    {
      EXPECT_EQ(nodeOfPoint(table, row.firstPoint), i);
    }
  }
}

TEST_F(Collections, HaveEachPointOfTheirTilesOnce)
{
  const CollectionReport report = created(row(40)); // two levels of groups
  EXPECT_EQ(report.tiles, 40u);
  EXPECT_EQ(report.points, 20000u);
  EXPECT_GT(report.headPoints, 0u);
  const auto cloud = StoredCloudFormats::ofProcess().open(city());
  ASSERT_TRUE(cloud) << cloud.error().what;
  EXPECT_EQ((*cloud)->description().pointCount, 20000u);
  EXPECT_EQ((*cloud)->description().structure, "collection");
  EXPECT_EQ((*cloud)->description().schema, idSchema());
  EXPECT_EQ((*cloud)->hierarchy()->roots().size(), 1u);
  expectSoundTable(*(*cloud)->hierarchy());
  std::set<std::uint32_t> all;
  for (const auto& [first, own] : points_)
  {
    all.insert(first);
  }
  EXPECT_EQ(points(**cloud), expected(all));
  const auto verified = (*cloud)->verify();
  ASSERT_TRUE(verified);
  EXPECT_TRUE(verified->ok) << verified->firstError;
}

TEST_F(Collections, HaveATreeForEachLayerOfTheirTiles)
{
  std::vector<TileRequest> tiles;
  for (int t = 0; t < 3; ++t)
  {
    AttributeSchema schema;
    schema.add({ "classification", ScalarType::UInt8 });
    const QuantisationGrid grid = millimetres();
    auto cloud = std::make_unique<CloudSource>("tile", schema, grid);
    Random random(t + 1);
    for (int i = 0; i < 900; ++i)
    {
      const glm::dvec3 p{ 16.0 * t + 16.0 * random.uniform(), 16.0 * random.uniform(),
        random.uniform() };
      cloud->addPosition(grid.toWorld(grid.toGrid(p)));
      cloud->addValue(0, static_cast<std::uint8_t>(t == 1 || i % 3 == 0 ? 2 : 6));
    }
    options_.layering = Layering::ObjectClass;
    options_.outputPath = at("l" + std::to_string(t) + ".pfront");
    ASSERT_TRUE(buildStore(one(std::move(cloud)), options_));
    tiles.push_back({ options_.outputPath });
  }
  created(tiles);
  const auto cloud = opened();
  EXPECT_EQ(cloud->description().layers.size(), 2u);
  EXPECT_EQ(cloud->hierarchy()->roots().size(), 2u);
  expectSoundTable(*cloud->hierarchy());
  EXPECT_TRUE(cloud->verify()->ok) << cloud->verify()->firstError;
}

TEST_F(Collections, OpenNoTileForTheirHeads)
{
  created(row(20));
  for (int i = 0; i < 20; ++i)
  {
    fs::rename(at("t" + std::to_string(i) + ".pfront"), at("gone" + std::to_string(i)));
  }
  const auto cloud = opened();
  ASSERT_TRUE(cloud);
  const Hierarchy& table = *cloud->hierarchy();
  std::uint64_t points = 0;
  std::vector<NodeIndex> front(table.roots());
  while (!front.empty())
  {
    const NodeIndex node = front.back();
    front.pop_back();
    Node row;
    ASSERT_EQ(table.peek(node, row), RowState::Here);
    if (cloud->record().heads[node].root)
    {
      continue;
    }
    const auto columns = cloud->read(node, { 0, 1 });
    ASSERT_TRUE(columns) << columns.error().what;
    EXPECT_EQ(columns->size(), row.pointCount);
    points += row.pointCount;
    table.appendChildren(node, row, front);
  }
  EXPECT_GT(points, 500u);
  EXPECT_EQ(openTiles(*cloud), 0u);
  EXPECT_FALSE(table.fault());
}

TEST_F(Collections, OpenTheTilesThatAQueryMeetsAndNoOthers)
{
  created(row(20));
  const auto cloud = opened();
  ASSERT_TRUE(cloud);
  PointQuery near;
  near.regions = { *BoxRegion::make({ { 17.0, 1.0, -1.0 }, { 31.0, 15.0, 2.0 } }) };
  const Result<IdsAndPlaces> found = query(*cloud, near);
  ASSERT_TRUE(found) << found.error().what;
  EXPECT_GT(found->size(), 300u);
  for (const auto& [id, place] : *found)
  {
    EXPECT_EQ(id / 1000, 1u);
  }
  EXPECT_EQ(openTiles(*cloud), 1u);
}

TEST_F(Collections, RowsOfClosedTilesComeWhenTheyAreAskedFor)
{
  created(row(3));
  const auto cloud = opened();
  ASSERT_TRUE(cloud);
  const Hierarchy& table = *cloud->hierarchy();
  for (NodeIndex i = 0; i < table.nodeCount(); ++i)
  {
    Node row;
    while (table.peek(i, row) == RowState::Coming)
    {
      const std::uint64_t seen = table.arrivals();
      ASSERT_TRUE(cloud->missingRows()->waiting());
      EXPECT_GT(cloud->missingRows()->readNext(), 0u);
      EXPECT_GT(table.arrivals(), seen);
    }
    EXPECT_EQ(row.firstPoint, table.node(i).firstPoint);
  }
  EXPECT_EQ(openTiles(*cloud), 3u);
}

TEST_F(Collections, ATileThatIsMissingOrReplacedIsAnErrorAndTheOthersAreThere)
{
  created(row(3));
  const auto before = opened();
  fs::remove(at("t1.pfront"));
  const auto gone = opened();
  const auto missing = query(*gone);
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().what.find("t1.pfront"), std::string::npos) << missing.error().what;
  EXPECT_NE(missing.error().what.find("city.pfcollection"), std::string::npos);
  const auto verified = gone->verify();
  ASSERT_TRUE(verified);
  EXPECT_FALSE(verified->ok);

  tile("t1.pfront", 7000, 16.0);
  const auto other = opened();
  const auto replaced = query(*other);
  ASSERT_FALSE(replaced);
  EXPECT_NE(replaced.error().what.find("has been replaced"), std::string::npos)
    << replaced.error().what;
  PointQuery others;
  others.regions = { *BoxRegion::make({ { 33.0, 1.0, -1.0 }, { 47.0, 15.0, 2.0 } }) };
  EXPECT_FALSE(query(*other, others)); // who has met the fault knows that the table is not whole
  EXPECT_TRUE(query(*opened(), others));
}

TEST_F(Collections, ChangesGiveTheTilesThatTheyName)
{
  std::vector<TileRequest> tiles = row(3);
  created({ tiles[0], tiles[1] });
  const auto first = opened();
  EXPECT_EQ(sound(addTiles(city(), { tiles[2] }, {})).state, 2u);
  EXPECT_EQ(points(*opened()), expected({ 0, 1000, 2000 }));
  expectSoundTable(*opened()->hierarchy());

  fs::create_directory(at("new"));
  const TileRequest corrected = tile("new/t1.pfront", 5000, 16.0);
  EXPECT_EQ(sound(replaceTiles(city(), { corrected }, {})).tiles, 3u);
  EXPECT_EQ(points(*opened()), expected({ 0, 2000, 5000 }));

  EXPECT_EQ(sound(removeTiles(city(), { "t0" }, {})).removed, 1u);
  EXPECT_EQ(points(*opened()), expected({ 2000, 5000 }));
  expectSoundTable(*opened()->hierarchy());
  EXPECT_EQ(points(*first), expected({ 0, 1000 })); // who had it open

  sound(undoCollection(city(), {}));
  EXPECT_EQ(points(*opened()), expected({ 0, 2000, 5000 }));
  sound(undoCollection(city(), {}));
  EXPECT_EQ(points(*opened()), expected({ 0, 1000, 2000 }));
  sound(undoCollection(city(), {}));
  EXPECT_EQ(points(*opened()), expected({ 0, 1000 }));
  const auto nothing = undoCollection(city(), {});
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().kind, Error::Kind::BadArgument);
  EXPECT_TRUE(opened()->verify()->ok) << opened()->verify()->firstError;
}

/// Adds tiles one by one until groups are split several times, and takes every other one out.
TEST_F(Collections, GrowAndShrinkTileByTile)
{
  std::vector<TileRequest> tiles;
  std::set<std::uint32_t> in;
  for (std::uint32_t i = 0; i < 80; ++i)
  {
    tiles.push_back(
      tile("g" + std::to_string(i) + ".pfront", 1000 * i, 16.0 * (i % 9), 16.0 * (i / 9)));
  }
  created({ tiles[0] });
  in.insert(0);
  for (std::uint32_t i = 1; i < 80; ++i)
  {
    sound(addTiles(city(), { tiles[i] }, {}));
    in.insert(1000 * i);
  }
  EXPECT_EQ(points(*opened()), expected(in));
  expectSoundTable(*opened()->hierarchy());
  const auto grown = opened()->verify();
  EXPECT_TRUE(grown->ok) << grown->firstError;
  std::vector<std::string> names;
  for (std::uint32_t i = 0; i < 80; i += 2)
  {
    names.push_back("g" + std::to_string(i));
    in.erase(1000 * i);
  }
  sound(removeTiles(city(), names, {}));
  EXPECT_EQ(points(*opened()), expected(in));
  expectSoundTable(*opened()->hierarchy());
  EXPECT_TRUE(opened()->verify()->ok) << opened()->verify()->firstError;

  const std::uint64_t state = opened()->record().state;
  sound(compactCollection(city(), {}));
  EXPECT_EQ(points(*opened()), expected(in));
  EXPECT_EQ(opened()->record().state, state + 1);
  EXPECT_TRUE(opened()->record().history.empty());
  EXPECT_TRUE(opened()->verify()->ok);
}

/// Points and the sum of their identities.
struct Identities
{
  std::uint64_t points = 0;
  std::uint64_t sum = 0;

  void add(const std::byte* identity)
  {
    std::uint64_t number = 0;
    std::memcpy(&number, identity, 8);
    ++points;
    sum += number;
  }
};

Identities identitiesOf(const CollectionCloud& cloud)
{
  Identities all;
  const auto report = queryPoints(cloud, PointQuery(), {},
    [&](QueryBatch& batch) -> Result<void>
    {
      const std::size_t column = *cloud.description().schema.find("identity");
      for (std::size_t i = 0; i < batch.size(); ++i)
      {
        all.add(batch.points.columns[column].data() + 8 * i);
      }
      return {};
    });
  EXPECT_TRUE(report) << report.error().what;
  return all;
}

/// Collections of tiles that have the points of a sample, whatever version wrote them.
class CollectionsOfSamples : public CollectionTest
{
protected:
  TileRequest golden(int version)
  {
    const std::string name = "version" + std::to_string(version) + "-all-codecs.pfront";
    fs::copy_file(goldenFile(name), at(name));
    return { at(name) };
  }
  TileRequest now()
  {
    writeSample(sample_, at("now.pfront"));
    return { at("now.pfront") };
  }
  void expectTiles(std::uint64_t tiles)
  {
    Identities own;
    for (const NodeColumns& node : sample_.points)
    {
      for (std::size_t i = 0; i < node.size(); ++i)
      {
        own.add(node.columns[10].data() + 8 * i);
      }
    }
    const auto cloud = opened();
    EXPECT_EQ(cloud->description().pointCount, tiles * own.points);
    const Identities found = identitiesOf(*cloud);
    EXPECT_EQ(found.points, tiles * own.points);
    EXPECT_EQ(found.sum, tiles * own.sum);
    EXPECT_TRUE(cloud->verify()->ok) << cloud->verify()->firstError;
  }

private:
  SampleStore sample_ = makeSample(260);
};

TEST_F(CollectionsOfSamples, TakeTilesOfAnyVersion)
{
  created({ golden(1), golden(2), golden(3), golden(4) });
  expectTiles(4);
  sound(addTiles(city(), { now() }, {}));
  expectTiles(5);
}

/// The file has the layout of stores of version 3. A change copies its heads into one of today.
TEST_F(CollectionsOfSamples, AFileOfVersion3OpensAndChanges)
{
  fs::copy_file(goldenFile("version3.pfcollection"), city());
  golden(2);
  golden(3);
  expectTiles(2);
  sound(addTiles(city(), { golden(4), now() }, {}));
  expectTiles(4);
  sound(removeTiles(city(), { "version2-all-codecs" }, {}));
  expectTiles(3);
  sound(undoCollection(city(), {}));
  expectTiles(4);
}

TEST_F(Collections, TakeTilesWithOtherAttributesAndGrids)
{
  std::vector<TileRequest> tiles = row(2);
  created(tiles);
  AttributeSchema more = idSchema();
  more.add({ "gps_time", ScalarType::Float64 });
  QuantisationGrid finer = millimetres();
  finer.scale = glm::dvec3(0.0005);
  auto cloud = std::make_unique<CloudSource>("tile", more, finer);
  for (std::uint32_t i = 0; i < 200; ++i)
  {
    const glm::dvec3 p{ 40.0 + 0.0005 * i, 3.0, 1.0 };
    cloud->addPosition(finer.toWorld(finer.toGrid(p)));
    cloud->addValue(0, 9000 + i);
    cloud->addValue(1, static_cast<std::uint16_t>(i));
    cloud->addValue(2, 0.5 * i);
    points_[9000][9000 + i] = cloud->positions().back();
  }
  options_.outputPath = at("fine.pfront");
  ASSERT_TRUE(buildStore(one(std::move(cloud)), options_));
  sound(addTiles(city(), { { options_.outputPath } }, {}));
  const auto grown = opened();
  EXPECT_EQ(grown->description().schema.size(), 3u);
  EXPECT_EQ(grown->description().grid.scale.x, 0.0005);
  const IdsAndPlaces all = expected({ 0, 1000, 9000 });
  const IdsAndPlaces found = points(*grown);
  ASSERT_EQ(found.size(), all.size());
  for (const auto& [id, place] : all)
  {
    EXPECT_NEAR(glm::length(found.at(id) - place), 0.0, 1e-9) << id;
  }
  EXPECT_TRUE(grown->verify()->ok) << grown->verify()->firstError;

  sound(removeTiles(city(), { "fine" }, {}));
  EXPECT_EQ(opened()->description().schema.size(), 3u); // heads keep their attributes
  EXPECT_EQ(points(*opened()).size(), 1000u);
  sound(compactCollection(city(), {}));
  EXPECT_EQ(opened()->description().schema, idSchema());
  EXPECT_EQ(points(*opened()), expected({ 0, 1000 }));
}

} // namespace
} // namespace pointfront
