// The front of a view and what it shares with those of other clouds, without a window.

#include "TerrainWindow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

using namespace pointfront;
using namespace pointfront::test;
using std::chrono::milliseconds;

// It would be drawn again for nothing, and a test or a user that waits for rest would not see it.
TEST(ViewFront, WhatArrivesForAnotherLeavesACompleteViewInPeace)
{
  const auto scheduler = std::make_shared<LoadScheduler>(LoadSchedulerOptions());
  TerrainCloud cloud(scheduler, std::make_shared<WindowDemand>());
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
  TerrainCloud cloud(scheduler, std::make_shared<WindowDemand>());
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
  const double width = 2.0 * 20000.0 * std::tan(0.45) * 800 / 600; // width of the ground in sight
  // The rows of the table come from the disk, too.
  for (const bool still : { false, true })
  {
    TerrainCloud cloud(
      std::make_shared<LoadScheduler>(LoadSchedulerOptions()), std::make_shared<WindowDemand>());
    FrameRequest request;
    request.view = above(middle, middle);
    request.complete = still;
    const Residency& residency = cloud.share.residency();
    do
    {
      cloud.frame(request);
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
      request.view = above(middle + right * width, middle + up * width);
      request.interacting = true;
      request.complete = false;
      cloud.frame(request);
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
  TerrainCloud cloud(scheduler, std::make_shared<WindowDemand>());
  cloud.reader->pages->open(false);
  FrameRequest request = everything();
  for (int frame = 0; frame < 60; ++frame)
  {
    request.interacting = frame % 2 == 0;
    request.view.position.z -= 10.0; // so that the margin ahead looks, too
    cloud.frame(request);
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
  request.interacting = false;
  request.complete = true;
  cloud.frame(request);
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
    TerrainCloud cloud(scheduler, std::make_shared<WindowDemand>());
    FrameRequest request = everything();
    request.targetErrorPx = 1000.0;
    cloud.frame(request); // the root
    if (rows)
    {
      cloud.reader->pages->open(false);
    }
    else
    {
      cloud.reader->nodes.open(false);
    }
    request.targetErrorPx = 0.01;
    request.complete = true;
    int asked = 0;
    request.aborted = [&asked] { return ++asked > 3; };
    cloud.frame(request);
    EXPECT_EQ(asked, 4) << rows;
    EXPECT_FALSE(cloud.front.last().complete) << rows;
    EXPECT_GT(cloud.drawn(), 0u) << "what is there is drawn";
    cloud.reader->pages->open(true);
    cloud.reader->nodes.open(true);
    request.aborted = nullptr;
    cloud.frame(request);
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
  std::vector<std::unique_ptr<TerrainCloud>> clouds;
  const auto begin = std::chrono::steady_clock::now();
  for (std::uint64_t disk = 0; disk < 8; ++disk)
  {
    clouds.push_back(std::make_unique<TerrainCloud>(scheduler, window, disk));
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
