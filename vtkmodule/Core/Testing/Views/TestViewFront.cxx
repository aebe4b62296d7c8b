// The front of a view and what it shares with those of other clouds, without a window.

#include "pointfront/Views/ViewFront.h"
#include "TerrainReader.h"

#include "pointfront/Residency/LoadScheduler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

using namespace pointfront;
using pointfront::test::Terrain;
using pointfront::test::TerrainReader;
using pointfront::test::Traffic;
using std::chrono::milliseconds;

namespace
{

View overview()
{
  const double s = Terrain::sizeMetres;
  return View::perspective(
    { 0.5 * s, 0.5 * s, s }, { 0.5 * s, 0.51 * s, 0 }, { 0, 0, 1 }, 0.9, 1.0, 1e7, 800, 600);
}

/// 13.6 million points, all of which the view wants.
FrameRequest everything()
{
  FrameRequest demand;
  demand.view = overview();
  demand.targetErrorPx = 0.01;
  return demand;
}

/// A cloud in a window whose machine takes the same for each point.
struct Cloud
{
  Cloud(const std::shared_ptr<LoadScheduler>& scheduler,
    const std::shared_ptr<const WindowDemand>& window, std::uint64_t disk = 0)
    : reader(std::make_shared<TerrainReader>(std::make_shared<Traffic>(), disk))
    , share(reader, reader->table->nodeCount(), scheduler, Terrain::pointsOfNode)
    , front(std::make_shared<HierarchyPiece>(reader->table, 0, 1), share, schema, window)
  {
  }
  void frame(const FrameRequest& demand)
  {
    const FrontDelta& delta = front.update(demand);
    front.recordFrame(
      delta.pointsDrawn, delta.moves, millisecondsPerPoint * double(delta.pointsDrawn));
  }
  std::uint64_t drawn() const { return front.last().pointsDrawn; }

  static constexpr double millisecondsPerPoint = 1e-4;
  std::shared_ptr<TerrainReader> reader;
  AttributeSchema schema;
  ResidencyShare share;
  ViewFront front;
};

struct Window
{
  explicit Window(int clouds)
  {
    for (int c = 0; c < clouds; ++c)
    {
      all.push_back(std::make_unique<Cloud>(scheduler, demand, std::uint64_t(c)));
    }
    FrameRequest complete = everything();
    complete.complete = true;
    frames(1, complete);
  }
  void frames(int count, const FrameRequest& wanted)
  {
    for (int frame = 0; frame < count; ++frame)
    {
      for (const auto& cloud : all)
      {
        cloud->frame(wanted);
      }
    }
  }
  std::uint64_t drawn() const
  {
    std::uint64_t sum = 0;
    for (const auto& cloud : all)
    {
      sum += cloud->drawn();
    }
    return sum;
  }

  std::shared_ptr<LoadScheduler> scheduler =
    std::make_shared<LoadScheduler>(LoadSchedulerOptions());
  std::shared_ptr<WindowDemand> demand = std::make_shared<WindowDemand>();
  std::vector<std::unique_ptr<Cloud>> all;
};

constexpr std::uint64_t wholeTerrain = 13650000;

} // namespace

// 50 ms at 0.1 us a point: half a million points, however many clouds there are.
TEST(ViewFront, AFrameTimeIsSharedByTheCloudsOfAWindow)
{
  FrameRequest motion = everything();
  motion.interacting = true;
  motion.frameMs = 50.0;
  for (const int clouds : { 1, 2, 5 })
  {
    Window window(clouds);
    EXPECT_EQ(window.drawn(), wholeTerrain * std::uint64_t(clouds));
    window.frames(60, motion);
    EXPECT_LE(window.drawn(), 550000u) << clouds;
    EXPECT_GE(window.drawn(), 250000u) << clouds;
    std::uint64_t least = wholeTerrain;
    for (const auto& cloud : window.all)
    {
      least = std::min(least, cloud->drawn());
    }
    EXPECT_GT(least, window.drawn() / std::uint64_t(2 * clouds)) << "at one error";
    // Half the time, half the points; and at rest time is no limit.
    const std::uint64_t before = window.drawn();
    FrameRequest faster = motion;
    faster.frameMs = 25.0;
    window.frames(60, faster);
    EXPECT_LT(window.drawn(), before * 7 / 10);
    window.frames(60, everything());
    EXPECT_EQ(window.drawn(), wholeTerrain * std::uint64_t(clouds));
  }
}

// VTK divides a frame's time among its actors: each has its part, and together they have the whole.
TEST(ViewFront, TheTimesOfTheCloudsAreAddedUpWhereTheFrameHasNone)
{
  Window window(4);
  FrameRequest motion = everything();
  motion.interacting = true;
  motion.cloudMs = 12.5;
  window.frames(60, motion);
  EXPECT_LE(window.drawn(), 550000u);
  EXPECT_GE(window.drawn(), 250000u);
  // What one leaves the others have.
  window.all[0]->front.leave();
  window.all[1]->front.leave();
  for (int frame = 0; frame < 60; ++frame)
  {
    window.all[2]->frame(motion);
    window.all[3]->frame(motion);
  }
  const std::uint64_t two = window.all[2]->drawn() + window.all[3]->drawn();
  EXPECT_LE(two, 550000u);
  EXPECT_GE(two, 250000u);
}

// Of 50 ms two clouds take 10, and .05 us a point: a million points fit. What the far one shows
// takes .1 ms a point, and says nothing of what points cost.
TEST(ViewFront, ACloudThatShowsLittleIsAsFineAsTheOthers)
{
  Window window(2);
  FrameRequest near = everything();
  near.targetErrorPx = 2.0;
  near.interacting = true;
  near.frameMs = 50.0;
  FrameRequest far = near;
  const double s = Terrain::sizeMetres;
  far.view = View::perspective(
    { 0.5 * s, 0.5 * s, 40 * s }, { 0.5 * s, 0.51 * s, 0 }, { 0, 0, 1 }, 0.9, 1.0, 1e7, 800, 600);
  const auto draw = [](Cloud& cloud, const FrameRequest& wanted)
  {
    const FrontDelta& delta = cloud.front.update(wanted);
    cloud.front.recordFrame(
      delta.pointsDrawn, delta.moves, 5.0 + 5e-5 * static_cast<double>(delta.pointsDrawn));
  };
  for (int frame = 0; frame < 100; ++frame)
  {
    draw(*window.all[0], near);
    draw(*window.all[1], far);
  }
  const FrontDelta& many = window.all[0]->front.last();
  const FrontDelta& few = window.all[1]->front.last();
  EXPECT_GT(many.pointsDrawn, 100000u);
  EXPECT_LT(few.pointsDrawn, 10000u);
  EXPECT_EQ(many.thresholdPx, 2.0);
  EXPECT_EQ(few.thresholdPx, 2.0);
}

// Low over the terrain the front's threshold is that of the ground below the eye. A hundred
// thousand points are as large as it allows, and fill more than ten times as many fine ones do.
TEST(ViewFront, WhereSplatsFillFewerPointsAreNotWanted)
{
  Window window(1);
  ViewFront& front = window.all[0]->front;
  FrameRequest low = everything();
  const double s = Terrain::sizeMetres;
  low.view = View::perspective({ 0.5 * s, 0.2 * s, 0.01 * s }, { 0.5 * s, 0.5 * s, 0.0 },
    { 0, 0, 1 }, 0.9, 1.0, 1e7, 800, 600);
  low.targetErrorPx = 1.0;
  low.interacting = true;
  low.frameMs = 15.0;
  constexpr double viewport = 800.0 * 600.0;
  double longest = 0.0;
  for (int frame = 0; frame < 100; ++frame)
  {
    const FrontDelta& delta = front.update(low);
    const auto points = static_cast<double>(delta.pointsDrawn);
    const double spacing = std::min(delta.thresholdPx, 4.0 * std::sqrt(viewport / points));
    const double fill = 3.14 * spacing * spacing * points;
    front.fills(fill, viewport);
    const double milliseconds = 1.0 + 1e-5 * points + 1e-6 * fill;
    longest = frame < 50 ? 0.0 : std::max(longest, milliseconds);
    front.recordFrame(delta.pointsDrawn, delta.moves, milliseconds);
  }
  EXPECT_LT(front.last().thresholdPx, 4.0);
  EXPECT_LT(longest, 2.0 * low.frameMs);
}

TEST(ViewFront, TheBudgetOfPointsHoldsInMotionToo)
{
  Window window(2);
  FrameRequest motion = everything();
  motion.interacting = true;
  motion.frameMs = 1000.0; // ten million
  motion.pointBudget = 300000;
  for (int frame = 0; frame < 30; ++frame)
  {
    window.frames(1, motion);
    EXPECT_LE(window.drawn(), 300000u) << frame;
  }
  EXPECT_GT(window.drawn(), 200000u);
}

// It would be drawn again for nothing, and a test or a user that waits for rest would not see it.
TEST(ViewFront, WhatArrivesForAnotherLeavesACompleteViewInPeace)
{
  const auto scheduler = std::make_shared<LoadScheduler>(LoadSchedulerOptions());
  Cloud cloud(scheduler, std::make_shared<WindowDemand>());
  FrameRequest coarse = everything();
  coarse.targetErrorPx = 1000.0;
  coarse.complete = true;
  cloud.frame(coarse);
  ASSERT_FALSE(cloud.front.wantsUpdate());
  const NodeIndex notShown = cloud.reader->table->nodeCount() - 1;
  ASSERT_EQ(cloud.front.find(notShown), nullptr);
  const std::unique_ptr<ResidencyShare::Wish> another = cloud.share.join();
  const std::uint64_t before = cloud.share.residency().arrivals();
  another->request(
    { { notShown, 1.0, false, Terrain::pointsOfNode, 0 } }, [](NodeIndex) { return 0u; });
  while (cloud.share.residency().arrivals() == before)
  {
    cloud.share.residency().waitForArrival(before);
  }
  EXPECT_FALSE(cloud.front.wantsUpdate());
  // A view that misses something goes on with what arrives.
  cloud.frame(everything());
  while (!cloud.front.last().complete)
  {
    if (cloud.front.wantsUpdate())
    {
      cloud.frame(everything());
    }
  }
  EXPECT_EQ(cloud.drawn(), wholeTerrain);
}

// A new colour or filter: what is drawn is read again, and until then it is drawn without.
TEST(ViewFront, AViewWhosePointsLackANewColumnIsNotComplete)
{
  const auto scheduler = std::make_shared<LoadScheduler>(LoadSchedulerOptions());
  Cloud cloud(scheduler, std::make_shared<WindowDemand>());
  ASSERT_TRUE(cloud.schema.add({ "intensity", ScalarType::UInt16, 1 }));
  FrameRequest coarse = everything();
  coarse.targetErrorPx = 1000.0;
  coarse.complete = true;
  cloud.frame(coarse);
  ASSERT_TRUE(cloud.front.last().complete);
  cloud.reader->nodes.open(false);
  FrameRequest coloured = coarse;
  coloured.complete = false;
  coloured.columns = LayerColumns(ColumnSelection{ 0 });
  cloud.frame(coloured);
  EXPECT_FALSE(cloud.front.last().complete);
  cloud.reader->nodes.open(true);
  while (!cloud.front.last().complete)
  {
    if (cloud.front.wantsUpdate())
    {
      cloud.frame(coloured);
    }
  }
  for (const DrawItem& item : cloud.front.last().draw)
  {
    EXPECT_EQ(cloud.front.find(item.node)->selection, ColumnSelection{ 0 }) << item.node;
  }
  EXPECT_FALSE(cloud.front.wantsUpdate());
}

// The disk hangs from the moment on in which the view begins to move.
TEST(ViewFront, AtRestItHasWhatASmallMotionShows)
{
  const auto above = [](double x, double y)
  {
    return View::perspective(
      { x, y, 20000.0 }, { x, y, 0.0 }, { 0, 1, 0 }, 0.9, 1.0, 1e7, 800, 600);
  };
  const double middle = 0.5 * Terrain::sizeMetres;
  const double width = 2.0 * 20000.0 * std::tan(0.45) * 800 / 600; // of the ground in sight
  // The rows of the table come from the disk, too.
  for (const bool still : { false, true })
  {
    Cloud cloud(
      std::make_shared<LoadScheduler>(LoadSchedulerOptions()), std::make_shared<WindowDemand>());
    FrameRequest demand;
    demand.view = above(middle, middle);
    demand.complete = still;
    const Residency& residency = cloud.share.residency();
    do
    {
      cloud.frame(demand);
      residency.waitUntilIdle();
      std::this_thread::sleep_for(milliseconds(1));
    } while (cloud.front.wantsUpdate());
    ASSERT_TRUE(cloud.front.last().complete);
    residency.waitUntilIdle();
    const auto drawn = static_cast<std::uint32_t>(cloud.front.last().draw.size());
    const std::uint32_t held = residency.statistics().residentNodes;
    EXPECT_GT(drawn, 50u);
    cloud.reader->nodes.open(false);
    std::size_t missing = 0;
    for (const auto& [right, up] :
      { std::pair(0.1, 0.0), std::pair(-0.1, 0.0), std::pair(0.0, 0.07), std::pair(0.07, -0.07) })
    {
      demand.view = above(middle + right * width, middle + up * width);
      demand.interacting = true;
      demand.complete = false;
      cloud.frame(demand);
      missing += static_cast<std::size_t>(std::count_if(cloud.front.last().requests.begin(),
        cloud.front.last().requests.end(), [](const LoadRequest& r) { return !r.optional; }));
    }
    cloud.reader->nodes.open(true);
    if (still)
    {
      EXPECT_EQ(held, drawn) << "a still picture reads nothing else";
      EXPECT_GT(missing, 10u);
    }
    else
    {
      EXPECT_GT(held, drawn);
      EXPECT_LT(held, 2 * drawn);
      EXPECT_EQ(missing, 0u);
    }
  }
}

// Every call is made while the disk hangs: one that waited for it would not return.
TEST(ViewFront, AFrameDoesNotWaitForAPageOfTheTable)
{
  LoadSchedulerOptions options;
  options.overdueAfter = milliseconds(30);
  const auto scheduler = std::make_shared<LoadScheduler>(options);
  Cloud cloud(scheduler, std::make_shared<WindowDemand>());
  cloud.reader->pages->open(false);
  FrameRequest demand = everything();
  for (int frame = 0; frame < 60; ++frame)
  {
    demand.interacting = frame % 2 == 0;
    demand.view.position.z -= 10.0; // so that the margin ahead looks, too
    cloud.frame(demand);
    EXPECT_GT(cloud.drawn(), 0u) << "of the root at least";
    EXPECT_LE(cloud.drawn(), nodePageRows * Terrain::pointsOfNode);
    cloud.front.wantsUpdate();
    cloud.front.expectsMore();
    std::this_thread::sleep_for(milliseconds(1));
  }
  EXPECT_EQ(scheduler->statistics().overdueReads, 1u);
  EXPECT_TRUE(cloud.front.last().rowsComing);
  EXPECT_FALSE(cloud.front.wantsUpdate()) << "nothing arrived: no busy loop";
  cloud.reader->pages->open(true);
  demand.interacting = false;
  demand.complete = true;
  cloud.frame(demand);
  EXPECT_TRUE(cloud.front.last().complete);
  EXPECT_GT(cloud.drawn(), wholeTerrain / 2);
}

// The reads of 1,365 nodes, or of the pages of their table, hang; who looks has had enough.
TEST(ViewFront, ACompleteFrameEndsWhenItIsAborted)
{
  for (const bool rows : { false, true })
  {
    LoadSchedulerOptions options;
    options.overdueAfter = milliseconds(30);
    const auto scheduler = std::make_shared<LoadScheduler>(options);
    Cloud cloud(scheduler, std::make_shared<WindowDemand>());
    FrameRequest demand = everything();
    demand.targetErrorPx = 1000.0;
    cloud.frame(demand); // the root
    if (rows)
    {
      cloud.reader->pages->open(false);
    }
    else
    {
      cloud.reader->nodes.open(false);
    }
    demand.targetErrorPx = 0.01;
    demand.complete = true;
    int asked = 0;
    demand.aborted = [&asked] { return ++asked > 3; };
    cloud.frame(demand);
    EXPECT_EQ(asked, 4) << rows;
    EXPECT_FALSE(cloud.front.last().complete) << rows;
    EXPECT_GT(cloud.drawn(), 0u) << "what is there is drawn";
    cloud.reader->pages->open(true);
    cloud.reader->nodes.open(true);
    demand.aborted = nullptr;
    cloud.frame(demand);
    EXPECT_TRUE(cloud.front.last().complete) << rows;
  }
}

// Eight clouds on disks that hang: a window opens in a second, not in eight halves of one.
TEST(ViewFront, FirstFramesOfManyCloudsWaitForASecondAtMost)
{
  LoadSchedulerOptions options;
  options.overdueAfter = milliseconds(30);
  const auto scheduler = std::make_shared<LoadScheduler>(options);
  const auto window = std::make_shared<WindowDemand>();
  std::vector<std::unique_ptr<Cloud>> clouds;
  const auto begin = std::chrono::steady_clock::now();
  for (std::uint64_t disk = 0; disk < 8; ++disk)
  {
    clouds.push_back(std::make_unique<Cloud>(scheduler, window, disk));
    clouds.back()->reader->nodes.open(false);
    clouds.back()->frame(everything());
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, milliseconds(2000));
  for (const auto& cloud : clouds)
  {
    EXPECT_EQ(cloud->drawn(), 0u);
    cloud->reader->nodes.open(true);
  }
}
