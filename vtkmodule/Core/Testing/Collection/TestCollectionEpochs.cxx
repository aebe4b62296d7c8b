#include "CollectionTest.h"

#include "pointfront/Disk/Epoch.h"
#include "pointfront/Query/PointsById.h"
#include "pointfront/Tiles/StoredCloudFormats.h"

#include <cstdint>
#include <set>
#include <utility>

namespace pointfront
{
namespace
{
using namespace pointfront::test;

class CollectionEpochs : public CollectionTest
{
protected:
  TileRequest dated(const std::string& name, std::uint32_t first, double x, const char* epoch)
  {
    TileRequest request = tile(name, first, x);
    request.epoch = epoch;
    return request;
  }
  std::string at2019() const { return city() + "#epoch=2019"; }
  std::string at2024() const { return city() + "#epoch=2024"; }

  static IdsAndPlaces pointsAt(const std::string& address)
  {
    const auto cloud = StoredCloudFormats::ofProcess().open(address);
    EXPECT_TRUE(cloud) << cloud.error().what;
    return cloud ? points(**cloud) : IdsAndPlaces();
  }
};

TEST_F(CollectionEpochs, AreCloudsOfTheirOwnInTheNumbersOfAll)
{
  created({ dated("a.pfront", 0, 0.0, "2019"), dated("b.pfront", 1000, 16.0, "2019"),
    dated("c.pfront", 2000, 0.0, "2024"), tile("d.pfront", 3000, 32.0) });
  EXPECT_EQ(pointsAt(at2019()), expected({ 0, 1000 }));
  EXPECT_EQ(pointsAt(at2024()), expected({ 2000 }));
  EXPECT_EQ(pointsAt(city() + "#epoch="), expected({ 3000 }));
  EXPECT_EQ(pointsAt(city()), expected({ 0, 1000, 2000, 3000 }));

  const auto all = opened();
  const auto one = CollectionCloud::open(at2024());
  ASSERT_TRUE(all && one);
  EXPECT_EQ(all->description().epochs, (std::vector<std::string>{ "", "2019", "2024" }));
  EXPECT_EQ((*one)->description().epochs, std::vector<std::string>{ "2024" });
  EXPECT_EQ((*one)->description().pointCount, 500u);
  EXPECT_EQ((*one)->description().layers[0].pointCount, 500u);
  EXPECT_LE((*one)->description().bounds.high.x, 16.0);
  EXPECT_EQ((*one)->files(), all->files());
  EXPECT_EQ(all->hierarchy()->roots().size(), 3u);
  ASSERT_EQ((*one)->hierarchy()->roots().size(), 1u);
  const NodeIndex root = (*one)->hierarchy()->roots().front();
  EXPECT_EQ((*one)->hierarchy()->node(root).firstPoint, all->hierarchy()->node(root).firstPoint);
  EXPECT_TRUE(all->verify()->ok);
}

TEST_F(CollectionEpochs, HaveNoPointsOfOthersByTheirNumbers)
{
  created({ dated("a.pfront", 0, 0.0, "2019"), dated("b.pfront", 1000, 16.0, "2019"),
    dated("c.pfront", 2000, 0.0, "2024"), tile("d.pfront", 3000, 32.0) });
  std::set<std::uint64_t> own;
  const auto note = [&own](QueryBatch& batch) -> Result<void>
  {
    own.insert(batch.ids.begin(), batch.ids.end());
    return {};
  };
  const auto all = opened();
  ASSERT_TRUE(queryPoints(*all, {}, {}, note));
  const std::set<std::uint64_t> ids = std::exchange(own, {});
  const auto one = CollectionCloud::open(at2024());
  ASSERT_TRUE(one && queryPoints(**one, {}, {}, note));
  ASSERT_EQ(own.size(), 500u);
  for (const std::uint64_t id : ids)
  {
    std::uint64_t found = 0;
    const auto count = [&found](QueryBatch& batch) -> Result<void>
    {
      found += batch.size();
      return {};
    };
    EXPECT_EQ(bool(pointsById(**one, { id }, {}, {}, count)), own.count(id) > 0) << id;
    EXPECT_EQ(found, own.count(id)) << id;
  }
}

TEST_F(CollectionEpochs, AreAColumnForWhoNamesIt)
{
  created({ dated("a.pfront", 0, 0.0, "2019"), dated("b.pfront", 1000, 16.0, "2024"),
    dated("c.pfront", 2000, 0.0, "2024") });
  const auto all = opened();
  const StoreDescription& told = all->description();
  const std::uint32_t column = *told.epochColumn;
  EXPECT_EQ(told.schema[column].name, "epoch");
  EXPECT_TRUE(told.isComputed(column));
  EXPECT_EQ(told.epochTimes, (std::vector<double>{ 2019.0, 2024.0 }));
  EXPECT_EQ(told.ranges.at(column).components[0], (std::array<double, 2>{ 2019.0, 2024.0 }));

  PointQuery asked;
  for (const auto& [text, firsts] : std::map<std::string, std::set<std::uint32_t>>{
         { "epoch == 2019", { 0 } }, { "epoch > 2020", { 1000, 2000 } }, { "epoch == 2020", {} } })
  {
    asked.where = *FilterExpression::parse(text);
    const auto found = query(*all, asked);
    ASSERT_TRUE(found);
    EXPECT_EQ(*found, expected(firsts)) << text;
  }
  // A condition that no point can pass opens no tile.
  const auto closed = opened();
  asked.where = *FilterExpression::parse("epoch == 2020");
  EXPECT_TRUE(query(*closed, asked)->empty());
  EXPECT_EQ(openTiles(*closed), 0u);
  asked.where = *FilterExpression::parse("epoch == 2019");
  EXPECT_TRUE(query(*closed, asked));
  EXPECT_EQ(openTiles(*closed), 1u);

  const auto one = CollectionCloud::open(at2024());
  EXPECT_EQ((*one)->description().epochTimes, std::vector<double>{ 2024.0 });
  EXPECT_TRUE(all->verify()->ok);
}

TEST_F(CollectionEpochs, MakeNoColumnWhereNobodyNamedOne)
{
  created(row(2));
  EXPECT_FALSE(opened()->description().epochColumn);
  EXPECT_EQ(opened()->description().schema.find("epoch"), std::nullopt);
}

TEST_F(CollectionEpochs, KeepTheirTreesThroughEveryChange)
{
  created({ dated("a.pfront", 0, 0.0, "2019") });
  sound(addTiles(city(), { dated("b.pfront", 1000, 0.0, "2024") }, {}));
  sound(addTiles(city(), { dated("c.pfront", 2000, 16.0, "2019") }, {}));
  EXPECT_EQ(pointsAt(at2019()), expected({ 0, 2000 }));
  EXPECT_EQ(pointsAt(at2024()), expected({ 1000 }));
  sound(replaceTiles(city(), { tile("b.pfront", 5000, 0.0) }, {})); // it keeps its epoch
  EXPECT_EQ(pointsAt(at2024()), expected({ 5000 }));
  sound(compactCollection(city(), {}));
  EXPECT_EQ(pointsAt(at2019()), expected({ 0, 2000 }));
  EXPECT_EQ(pointsAt(at2024()), expected({ 5000 }));
  sound(removeTiles(city(), { "b" }, {}));
  EXPECT_EQ(CollectionCloud::open(at2024()).error().kind, Error::Kind::NotFound);
  sound(undoCollection(city(), {}));
  EXPECT_EQ(pointsAt(at2024()), expected({ 5000 }));
}

TEST_F(CollectionEpochs, ThatAreNotThereAreRefusedWithThoseThatAre)
{
  created({ dated("a.pfront", 0, 0.0, "2019"), tile("b.pfront", 1000, 0.0) });
  const auto none = StoredCloudFormats::ofProcess().open(city() + "#epoch=2020");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().kind, Error::Kind::NotFound);
  EXPECT_NE(none.error().what.find("'2020'"), std::string::npos) << none.error().what;
  EXPECT_NE(none.error().what.find("one without a name, 2019"), std::string::npos)
    << none.error().what;
  const auto store = StoredCloudFormats::ofProcess().open(at("a.pfront") + "#epoch=2019");
  ASSERT_FALSE(store);
  EXPECT_EQ(store.error().kind, Error::Kind::BadArgument);
  EXPECT_NE(store.error().what.find("no collection"), std::string::npos) << store.error().what;
}

std::vector<std::pair<double, std::string>> timesAndNames(const std::vector<std::string>& epochs)
{
  std::vector<std::pair<double, std::string>> found;
  for (const EpochTime& epoch : timesOf(epochs))
  {
    found.emplace_back(epoch.time, epoch.name);
  }
  return found;
}

TEST(EpochTimes, AreYearsWhereAllAreDates)
{
  using Times = std::vector<std::pair<double, std::string>>;
  EXPECT_EQ(timesAndNames({ "2019", "2024-07", "2023-01-01" }),
    (Times{ { 2019.0, "2019" }, { 2023.0, "2023-01-01" }, { 2024.5, "2024-07" } }));
  EXPECT_DOUBLE_EQ(timesOf({ "2024-12-31" }).front().time, 2024.0 + 365.0 / 366.0);
  for (const std::vector<std::string>& names :
    { std::vector<std::string>{ "", "2019" }, { "2019", "spring" }, { "2019", "2019-01" },
      { "2019-13", "2020" }, { "2019-02-29", "2020" }, { "20190", "2020" }, { "+019", "2020" } })
  {
    EXPECT_EQ(timesAndNames(names), (Times{ { 0.0, names[0] }, { 1.0, names[1] } }));
  }
}
} // namespace
} // namespace pointfront
