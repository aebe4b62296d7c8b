// Rows of paged tables take their turn with all else that is read: one read at a time, on the
// scheduler's threads, and nobody who draws waits for them.

#include "Sanitizers.h"
#include "TerrainReader.h"

#include "pointfront/Front/RenderFront.h"
#include "pointfront/Residency/LoadScheduler.h"
#include "pointfront/Residency/Residency.h"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <thread>
#include <vector>

namespace pointfront
{
namespace
{

using std::chrono::milliseconds;
using test::Terrain;
using test::TerrainReader;
using test::Traffic;

View overview()
{
  const double s = Terrain::sizeMetres;
  return View::perspective(
    { 0.5 * s, 0.5 * s, s }, { 0.5 * s, 0.51 * s, 0 }, { 0, 0, 1 }, 0.9, 1.0, 1e7, 800, 600);
}

/// A view of a store, as the renderer has one.
struct Cloud
{
  Cloud(std::shared_ptr<TerrainReader> from, const std::shared_ptr<LoadScheduler>& scheduler)
    : reader(std::move(from))
    , residency(reader, reader->table->nodeCount(), scheduler)
    , front(reader->table)
  {
    limits.targetErrorPx = 0.2;
    limits.movesPerFrame = 1000;
    limits.requestLimit = 1000;
  }
  const FrontDelta& frame()
  {
    const FrontDelta& delta = front.update(overview(), residency, limits);
    residency.request(delta.requests);
    residency.release([this](NodeIndex node) { return front.distanceUnderFront(node); });
    return delta;
  }
  /// Frames until the view is complete; false if that takes too long.
  bool finish()
  {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!frame().complete)
    {
      if (std::chrono::steady_clock::now() > end)
      {
        return false;
      }
      std::this_thread::sleep_for(milliseconds(1));
    }
    return true;
  }

  std::shared_ptr<TerrainReader> reader;
  Residency residency;
  RenderFront front;
  FrontLimits limits;
};

std::shared_ptr<LoadScheduler> schedulerOf(unsigned threads, milliseconds overdueAfter)
{
  LoadSchedulerOptions options;
  options.threads = threads;
  options.overdueAfter = overdueAfter;
  return std::make_shared<LoadScheduler>(options);
}

} // namespace

// Every call below is made while a page hangs: one that waited for it would not return.
TEST(TableRows, AFrontGoesOnWhileAPageHangs)
{
  const auto traffic = std::make_shared<Traffic>();
  const auto scheduler = schedulerOf(2, milliseconds(30));
  Cloud cloud(std::make_shared<TerrainReader>(traffic, 1), scheduler);
  cloud.residency.request({ { 0, 1.0, false, Terrain::pointsOfNode } });
  cloud.residency.waitUntilIdle();
  cloud.reader->pages->open(false);
  for (int frame = 0; frame < 100; ++frame)
  {
    const FrontDelta& delta = cloud.frame();
    ASSERT_GE(delta.draw.size(), 1u) << "what it has";
    ASSERT_LE(delta.draw.size(), std::size_t(nodePageRows)) << "of the page that was here";
    EXPECT_FALSE(delta.complete);
    std::this_thread::sleep_for(milliseconds(1));
  }
  EXPECT_TRUE(cloud.front.update(overview(), cloud.residency, cloud.limits).rowsComing);
  // Nobody else waits for that disk either.
  EXPECT_EQ(scheduler->statistics().overdueReads, 1u);
  Cloud other(std::make_shared<TerrainReader>(traffic, 2), scheduler);
  EXPECT_TRUE(other.finish());
  cloud.reader->pages->open(true);
  EXPECT_TRUE(cloud.finish());
  const std::size_t drawn = cloud.frame().draw.size();
  EXPECT_GT(drawn, std::size_t(nodePageRows));
  EXPECT_EQ(drawn, other.frame().draw.size());
}

TEST(TableRows, AStoreGoesWhileItsPageHangs)
{
  const auto scheduler = schedulerOf(2, milliseconds(20));
  auto reader = std::make_shared<TerrainReader>(std::make_shared<Traffic>());
  const std::weak_ptr<PagedNodeTable> table = reader->table;
  test::GatedPages* const pages = reader->pages;
  {
    Cloud cloud(std::move(reader), scheduler);
    cloud.residency.request({ { 0, 1.0, false, Terrain::pointsOfNode } });
    cloud.residency.waitUntilIdle();
    pages->open(false);
    while (scheduler->statistics().overdueReads == 0)
    {
      cloud.frame();
      std::this_thread::sleep_for(milliseconds(1));
    }
  } // returns
  EXPECT_EQ(scheduler->statistics().stores, 0u);
  EXPECT_FALSE(table.expired()) << "the thread that hangs in it has it";
  pages->open(true);
  for (int wait = 0; wait < 10000 && !table.expired(); ++wait)
  {
    std::this_thread::sleep_for(milliseconds(1));
  }
  EXPECT_TRUE(table.expired());
}

TEST(TableRows, ManyStoresReadTheirTablesOneAtATimeOnTheSharedThreads)
{
  const std::size_t stores = test::underThreadSanitizer() ? 12 : 100;
  const auto traffic = std::make_shared<Traffic>();
  const auto scheduler = schedulerOf(3, std::chrono::minutes(10));
  std::vector<std::unique_ptr<Cloud>> clouds;
  for (std::size_t s = 0; s < stores; ++s)
  {
    clouds.push_back(
      std::make_unique<Cloud>(std::make_shared<TerrainReader>(traffic, s), scheduler));
    clouds.back()->limits.targetErrorPx = 1.0;
  }
  traffic->most = 0;
  for (const auto& cloud : clouds)
  {
    cloud->frame(); // all of them ask before the first is served
  }
  for (const auto& cloud : clouds)
  {
    ASSERT_TRUE(cloud->finish());
    EXPECT_GT(cloud->reader->table->pagesRead(), 1u);
  }
  EXPECT_EQ(traffic->most, 1);
  EXPECT_EQ(scheduler->statistics().threads, 3u);
}

TEST(TableRows, TheReaderIsToldOfTheFirstThatIsAskedForAndWhoWaitsReadsWithoutOne)
{
  TerrainReader reader(std::make_shared<Traffic>());
  MissingRows& missing = *reader.table->missingRows();
  int told = 0;
  missing.attach(&told, [&] { ++told; });
  Node row;
  EXPECT_FALSE(missing.waiting());
  EXPECT_EQ(reader.table->peek(100, row), RowState::Coming);
  EXPECT_EQ(reader.table->peek(200, row), RowState::Coming);
  EXPECT_EQ(reader.table->peek(300, row), RowState::Coming);
  EXPECT_TRUE(missing.waiting());
  EXPECT_EQ(told, 1);
  EXPECT_EQ(missing.readNext(), std::size_t(nodePageBytes));
  EXPECT_EQ(reader.table->peek(100, row), RowState::Here) << "the oldest first";
  EXPECT_EQ(reader.table->peek(200, row), RowState::Coming);
  missing.detach(&told);
  reader.table->waitForArrival(reader.table->arrivals());
  EXPECT_EQ(reader.table->peek(200, row), RowState::Here);
  reader.table->waitForArrival(reader.table->arrivals());
  EXPECT_FALSE(missing.waiting());
  EXPECT_EQ(missing.readNext(), 0u);
  EXPECT_EQ(told, 1);
}

// The rows of the roots are asked for with every frame in motion.
TEST(TableRows, RootsStayInMemory)
{
  const auto small = test::terrainTable(9, 12 * sizeof(NodePage));
  small->keepRoots();
  for (NodeIndex node = 60; node < 60 * 40; node += 60)
  {
    small->node(node); // other pages take the place of the first
  }
  Node row;
  EXPECT_EQ(small->peek(1, row), RowState::Coming);
  EXPECT_EQ(small->peek(0, row), RowState::Here);
  const std::uint64_t read = small->pagesRead();
  EXPECT_EQ(small->node(0).childCount, 4);
  EXPECT_EQ(small->pagesRead(), read);
}

} // namespace pointfront
