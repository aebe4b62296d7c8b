#include "AllocationCount.h"
#include "QueryOracle.h"
#include "StoreBuildTest.h"

#include "pointfront/Style/ClassHeights.h"
#include "pointfront/Threads/ThreadCrew.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>

namespace pointfront
{
namespace
{
using namespace pointfront::test;

class PointQueries : public StoreBuildTest
{
protected:
  std::shared_ptr<const PointStore> buildOf(std::unique_ptr<PointSource> cloud)
  {
    std::vector<std::unique_ptr<PointSource>> sources;
    sources.push_back(std::move(cloud));
    const auto report = buildStore(std::move(sources), options_);
    EXPECT_TRUE(report) << report.error().what;
    const auto store = PointStore::open(options_.outputPath);
    EXPECT_TRUE(store) << store.error().what;
    return *store;
  }
};

/// Counts what is read of a store.
class CountedReads final : public NodeReader
{
public:
  explicit CountedReads(const NodeReader& reader)
    : reader_(reader)
  {
  }
  Result<FetchedNode> fetch(NodeIndex node, const ColumnSelection& columns) const override
  {
    auto fetched = reader_.fetch(node, columns);
    EXPECT_TRUE(fetched);
    bytes += fetched->bytesRead;
    ++nodes;
    return fetched;
  }
  Result<NodeColumns> decode(const FetchedNode& fetched) const override
  {
    return fetched.node == broken
      ? Result<NodeColumns>(makeError(Error::Kind::Corrupt, "node is broken"))
      : reader_.decode(fetched);
  }
  std::size_t decodedBytes(
    NodeIndex node, std::uint32_t points, const ColumnSelection& columns) const override
  {
    return reader_.decodedBytes(node, points, columns);
  }
  std::size_t storedBytes(NodeIndex node, const ColumnSelection& columns) const override
  {
    return reader_.storedBytes(node, columns);
  }

  mutable std::atomic<std::uint64_t> bytes{ 0 };
  mutable std::atomic<std::uint64_t> nodes{ 0 };
  NodeIndex broken = noNode;

private:
  const NodeReader& reader_;
};

std::shared_ptr<const Region> boxOf(const glm::dvec3& low, const glm::dvec3& high)
{
  return BoxRegion::make({ low, high }).value();
}

/// The middle of the hills that `share` of the points lie in.
std::shared_ptr<const Region> middleOf(const Bounds& bounds, double share)
{
  const glm::dvec3 half = 0.5 * std::sqrt(share) * bounds.size();
  return boxOf({ bounds.centre().x - half.x, bounds.centre().y - half.y, -1e9 },
    { bounds.centre().x + half.x, bounds.centre().y + half.y, 1e9 });
}

} // namespace

TEST_F(PointQueries, OfAnOctreeAreThoseOfABruteForceFilter)
{
  auto cloud = std::make_unique<OracleCloud>(6000);
  const OracleCloud copy = *cloud;
  options_.nodePoints = 96;
  expectOracle(*buildOf(std::move(cloud)), copy, 1000);
}

TEST_F(PointQueries, OfAKdTreeAreThoseOfABruteForceFilter)
{
  auto cloud = std::make_unique<OracleCloud>(6000);
  const OracleCloud copy = *cloud;
  options_.nodePoints = 96;
  options_.structure = Structure::KdTree;
  options_.layering = Layering::None;
  expectOracle(*buildOf(std::move(cloud)), copy, 1000);
}

TEST_F(PointQueries, OfMeanRepresentativesGivePointsOfTheInput)
{
  for (const Structure structure : { Structure::Octree, Structure::KdTree })
  {
    auto cloud = std::make_unique<OracleCloud>(3000);
    const OracleCloud copy = *cloud;
    options_.nodePoints = 96;
    options_.structure = structure;
    options_.refinement = Refinement::Replace;
    expectOracle(*buildOf(std::move(cloud)), copy, 60);
  }
}

// The global height counts in each class, whatever its layer.
TEST_F(PointQueries, ByGlobalHeightAreThoseOfAFilterByClass)
{
  for (const Layering layering : { Layering::None, Layering::ObjectClass })
  {
    options_.layering = layering;
    options_.nodePoints = 100;
    const auto store = buildOf(std::make_unique<OracleCloud>(8000));
    const auto heights = std::make_shared<const ClassHeights>(store);
    const auto chosen = [&](const char* text)
    {
      PointQuery query;
      query.where = FilterExpression::parse(text).value();
      QueryAnswer answer;
      EXPECT_TRUE(queryPoints(*store, query, {}, answer.consumer()));
      return answer.ids;
    };
    std::vector<std::uint64_t> low;
    std::vector<std::uint64_t> high;
    for (NodeIndex n = 0; n < store->hierarchy()->nodeCount(); ++n)
    {
      const auto fetched = store->fetch(n, {});
      const auto node = store->decode(*fetched);
      for (std::uint32_t i = 0; i < node->size(); ++i)
      {
        const double height = heights->at(*node, i);
        (height < 0.3 ? low : high).push_back(node->firstPoint + i);
      }
    }
    EXPECT_EQ(chosen("global_height < 0.3"), low);
    EXPECT_EQ(chosen("global-height not in (-1, 0.3)"), high);
  }
}

TEST_F(PointQueries, AreTheSameForAnyThreadsAndAnyMemory)
{
  options_.nodePoints = 100;
  const auto store = build(hills(20000, 1e5));
  PointQuery query;
  query.regions = { middleOf(store->description().bounds, 0.4) };
  query.where = FilterExpression::parse("intensity in [3000, 50000]").value();
  const QueryPlan plan = QueryPlan::make(*store, query).value();
  QueryAnswer first;
  ASSERT_TRUE(plan.run(*store, {}, first.consumer()));
  EXPECT_GT(first.ids.size(), 3000u);
  EXPECT_TRUE(std::is_sorted(first.ids.begin(), first.ids.end()));
  for (const unsigned threads : { 1u, 2u, 5u })
  {
    for (const std::size_t memory : { plan.leastMemoryBytes(*store), std::size_t(1) << 20 })
    {
      ThreadCrew crew(threads);
      QueryOptions options;
      options.crew = &crew;
      options.memoryBytes = memory;
      QueryAnswer answer;
      const auto report = plan.run(*store, options, answer.consumer());
      ASSERT_TRUE(report) << report.error().what;
      EXPECT_TRUE(answer.nodes == first.nodes);
      EXPECT_TRUE(answer.ids == first.ids);
      EXPECT_TRUE(answer.positions == first.positions);
      EXPECT_TRUE(answer.columns == first.columns);
      EXPECT_LE(report->peakBytes, memory);
    }
  }
}

TEST_F(PointQueries, ReadAboutTheShareOfTheBytesThatTheyAskFor)
{
  options_.nodePoints = 100;
  const auto store = build(hills(300000, 1e6));
  const CountedReads all(*store);
  ASSERT_TRUE(
    QueryPlan::make(*store, {})->run(all, {}, [](QueryBatch&) -> Result<void> { return {}; }));
  PointQuery query;
  query.regions = { middleOf(store->description().bounds, 0.01) };
  const CountedReads some(*store);
  const auto report =
    QueryPlan::make(*store, query)->run(some, {}, [](QueryBatch&) -> Result<void> { return {}; });
  ASSERT_TRUE(report);
  EXPECT_NEAR(double(report->pointsChosen), 3000.0, 300.0);
  EXPECT_EQ(report->bytesRead, some.bytes);
  EXPECT_EQ(report->nodesRead, some.nodes);
  // The rim of the box: nodes of some 10 x 10 points that it cuts, and a few on each level above.
  EXPECT_LT(double(some.bytes), 0.03 * double(all.bytes));
  EXPECT_LT(double(report->pointsRead), 3.0 * double(report->pointsChosen));
}

TEST_F(PointQueries, SkipNodesByTheirStoredRanges)
{
  auto cloud = std::make_unique<OracleCloud>(20000);
  options_.nodePoints = 100;
  options_.layering = Layering::None;
  const auto store = buildOf(std::move(cloud));
  PointQuery query;
  query.classes = { 9 }; // the western quarter
  QueryAnswer answer;
  const auto nine = queryPoints(*store, query, {}, answer.consumer());
  ASSERT_TRUE(nine);
  EXPECT_GT(nine->pointsChosen, 4500u);
  EXPECT_LT(nine->pointsRead, 10000u);
  query.classes = { 77 };
  const auto none = queryPoints(*store, query, {}, answer.consumer());
  ASSERT_TRUE(none);
  EXPECT_EQ(none->nodesRead, 0u);
}

TEST_F(PointQueries, ReadOnlyTheColumnsThatAreAskedFor)
{
  const auto store = build(hills(5000, 1e5));
  PointQuery query;
  query.attributes.emplace();
  QueryAnswer answer;
  const auto positions = queryPoints(*store, query, {}, answer.consumer());
  ASSERT_TRUE(positions);
  EXPECT_TRUE(answer.columns.empty());
  query.attributes = { "INTENSITY" };
  const auto one = queryPoints(*store, query, {},
    [](QueryBatch& batch) -> Result<void>
    {
      EXPECT_EQ(batch.points.columns.size(), 1u);
      EXPECT_EQ(batch.points.columns[0].size(), 2 * batch.size());
      return {};
    });
  ASSERT_TRUE(one);
  EXPECT_LT(positions->bytesRead, one->bytesRead);
  // An attribute that only a condition needs is read, and does not come out.
  query.where = FilterExpression::parse("id < 10").value();
  QueryAnswer few;
  ASSERT_TRUE(queryPoints(*store, query, {}, few.consumer()));
  EXPECT_EQ(few.ids.size(), 10u);
  ASSERT_EQ(few.columns.size(), 1u);
  EXPECT_EQ(few.columns[0].size(), 20u);
}

TEST_F(PointQueries, KeepToTheirMemory)
{
  options_.nodePoints = 2000;
  const auto store = build(hills(200000, 1e6));
  const QueryPlan plan = QueryPlan::make(*store, {}).value();
  for (const std::size_t memory : { 400000u, 1u << 20, 4u << 20 })
  {
    ThreadCrew crew(3);
    QueryOptions options;
    options.crew = &crew;
    options.memoryBytes = memory;
    resetPeakBytes();
    const std::size_t before = allocatedBytes();
    std::uint64_t points = 0;
    const auto report = plan.run(*store, options,
      [&points](QueryBatch& batch) -> Result<void>
      {
        points += batch.size();
        return {};
      });
    ASSERT_TRUE(report) << report.error().what;
    EXPECT_EQ(points, 200000u);
    EXPECT_LE(peakAllocatedBytes() - before, memory);
    EXPECT_GT(peakAllocatedBytes() - before, memory / 5); // the counter is in place
    EXPECT_LE(report->peakBytes, memory);
  }
  QueryOptions options;
  options.memoryBytes = plan.leastMemoryBytes(*store) - 1;
  const auto report = plan.run(*store, options, [](QueryBatch&) -> Result<void> { return {}; });
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().kind, Error::Kind::NoMemory);
}

TEST_F(PointQueries, PiecesTogetherAreTheWhole)
{
  options_.nodePoints = 64;
  const auto store = build(hills(5000, 1e5));
  PointQuery query;
  query.regions = { middleOf(store->description().bounds, 0.5) };
  const QueryPlan plan = QueryPlan::make(*store, query).value();
  QueryAnswer whole;
  ASSERT_TRUE(plan.run(*store, {}, whole.consumer()));
  for (const unsigned pieces : { 1u, 3u, 1000u })
  {
    QueryAnswer together;
    std::uint64_t largest = 0;
    for (unsigned piece = 0; piece < pieces; ++piece)
    {
      const QueryPlan part = plan.piece(piece, pieces);
      largest = std::max(largest, part.mostPoints());
      ASSERT_TRUE(part.run(*store, {}, together.consumer()));
    }
    EXPECT_EQ(together.ids, whole.ids);
    EXPECT_LE(largest, plan.mostPoints() / pieces + 64);
  }
}

TEST_F(PointQueries, ThinnedOutAreASubsetThatIsDenseEnough)
{
  options_.nodePoints = 64;
  const auto store = build(hills(5000, 1e5));
  PointQuery query;
  query.regions = { middleOf(store->description().bounds, 0.5) };
  QueryAnswer all;
  ASSERT_TRUE(queryPoints(*store, query, {}, all.consumer()));
  query.spacing = 8.0;
  QueryAnswer some;
  ASSERT_TRUE(queryPoints(*store, query, {}, some.consumer()));
  EXPECT_GT(some.ids.size(), 100u);
  EXPECT_LT(some.ids.size(), all.ids.size() / 2);
  EXPECT_TRUE(std::includes(all.ids.begin(), all.ids.end(), some.ids.begin(), some.ids.end()));
}

TEST_F(PointQueries, OfRegionsWithoutPointsGiveNone)
{
  const auto store = build(hills(1000, 1e5));
  const Bounds bounds = store->description().bounds;
  const std::vector<std::shared_ptr<const Region>> regions{
    boxOf(bounds.high + 1.0, bounds.high + 2.0), boxOf(bounds.high, bounds.low),
    PolygonPrism::make({}).value(), SphereRegion::make(bounds.low - 10.0, 1.0).value()
  };
  for (const std::shared_ptr<const Region>& region : regions)
  {
    PointQuery query;
    query.regions = { region };
    QueryAnswer answer;
    const auto report = queryPoints(*store, query, {}, answer.consumer());
    ASSERT_TRUE(report);
    EXPECT_EQ(report->nodesRead, 0u);
    EXPECT_TRUE(answer.ids.empty());
  }
}

TEST_F(PointQueries, OfASinglePoint)
{
  const auto store = build(cloudOf(1, millimetres(), [](std::size_t) { return GridPosition(7); }));
  const glm::dvec3 place = millimetres().toWorld(GridPosition(7));
  PointQuery query;
  query.regions = { boxOf(place, place), SphereRegion::make(place, 0.0).value() };
  QueryAnswer answer;
  ASSERT_TRUE(queryPoints(*store, query, {}, answer.consumer()));
  EXPECT_EQ(answer.ids, std::vector<std::uint64_t>{ 0 });
  EXPECT_EQ(answer.positions, std::vector<glm::dvec3>{ place });
}

TEST_F(PointQueries, WrongOnesAreRefused)
{
  const auto store = build(hills(1000, 1e5));
  const auto kindOf = [&store](const PointQuery& query)
  {
    const auto report =
      queryPoints(*store, query, {}, [](QueryBatch&) -> Result<void> { return {}; });
    return report ? std::string("taken") : report.error().what;
  };
  PointQuery query;
  query.attributes = { "colour" };
  EXPECT_NE(kindOf(query).find("'colour'"), std::string::npos);
  query = {};
  query.classes = { 2 };
  EXPECT_NE(kindOf(query).find("no classification"), std::string::npos);
  query = {};
  query.where = FilterExpression::parse("nothing > 1").value();
  EXPECT_NE(kindOf(query).find("nothing"), std::string::npos);
  query = {};
  query.spacing = std::nan("");
  EXPECT_NE(kindOf(query), "taken");
}

TEST_F(PointQueries, ErrorsAndCancellationEndThem)
{
  options_.nodePoints = 64;
  const auto store = build(hills(5000, 1e5));
  const QueryPlan plan = QueryPlan::make(*store, {}).value();
  CountedReads broken(*store);
  broken.broken = plan.node(40);
  QueryAnswer before;
  const auto failed = plan.run(broken, {}, before.consumer());
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().kind, Error::Kind::Corrupt);
  EXPECT_EQ(before.nodes.size(), 40u);
  int calls = 0;
  const auto full = plan.run(*store, {},
    [&calls](QueryBatch&) -> Result<void>
    {
      return ++calls == 3 ? Result<void>(makeError(Error::Kind::Unwritable, "full"))
                          : Result<void>();
    });
  ASSERT_FALSE(full);
  EXPECT_EQ(full.error().what, "full");
  EXPECT_EQ(calls, 3);
  QueryOptions options;
  options.progress = [](const Progress&) { return false; };
  const auto cancelled = plan.run(*store, options,
    [](QueryBatch&) -> Result<void>
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(110)); // the next report is due
      return {};
    });
  ASSERT_FALSE(cancelled);
  EXPECT_EQ(cancelled.error().kind, Error::Kind::Cancelled);
}

TEST_F(PointQueries, PointsByTheirIds)
{
  options_.nodePoints = 64;
  const auto store = build(hills(3000, 1e5));
  QueryAnswer all;
  ASSERT_TRUE(queryPoints(*store, {}, {}, all.consumer()));
  ASSERT_EQ(all.ids.size(), 3000u);
  const std::vector<std::uint64_t> ids{ 0, 1, 63, 64, 1500, 2999 };
  QueryAnswer some;
  const auto report = pointsById(*store, ids, { { "id" } }, {}, some.consumer());
  ASSERT_TRUE(report) << report.error().what;
  EXPECT_EQ(some.ids, ids);
  EXPECT_LE(report->nodesRead, 5u);
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    EXPECT_EQ(some.positions[i], all.positions[ids[i]]);
    EXPECT_EQ(some.value<std::uint32_t>(0, i), all.value<std::uint32_t>(0, ids[i]));
  }
  const auto refused = [&store](const std::vector<std::uint64_t>& wrong)
  {
    const auto answer =
      pointsById(*store, wrong, std::nullopt, {}, [](QueryBatch&) -> Result<void> { return {}; });
    return !answer && answer.error().kind == Error::Kind::BadArgument;
  };
  EXPECT_TRUE(refused({ 5, 4 }));
  EXPECT_TRUE(refused({ 4, 4 }));
  EXPECT_TRUE(refused({ 3000 }));
  EXPECT_TRUE(refused({ 0, std::uint64_t(-1) }));
  QueryAnswer none;
  EXPECT_TRUE(pointsById(*store, {}, std::nullopt, {}, none.consumer()));
  EXPECT_TRUE(none.ids.empty());
}

} // namespace pointfront
