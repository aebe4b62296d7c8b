#include "pointfront/Front/RenderFront.h"

#include "pointfront/Front/ScreenError.h"
#include "SevenNodes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace pointfront
{

using namespace test;
using State = ResidencySnapshot::State;

// Nothing is there at first:  (0)   then 0 arrives:  0 drawn, 1 and 2 asked for
TEST(RenderFront, DrawsNothingAndAsksForTheRootUntilItIsThere)
{
  RenderFront front(sevenNodes());
  ScriptedResidency residency;
  const View view = fromAbove(1200.0);
  const FrontDelta& delta = front.update(view, residency, settleAt(4.0));
  EXPECT_TRUE(delta.draw.empty());
  ASSERT_FALSE(delta.requests.empty());
  EXPECT_EQ(delta.requests.front().node, 0u);
  EXPECT_FALSE(delta.complete);

  residency.set(0, State::Resident);
  front.update(view, residency, settleAt(4.0));
  EXPECT_EQ(drawn(delta), Nodes{ 0 });
  EXPECT_EQ(requested(delta), (std::vector<NodeIndex>{ 1, 2 }));
}

//        0        8 px: expands      threshold 3.9
//      /   \ .
//    [1]   [2]    4 px each: expand, their children fade in
TEST(RenderFront, ExpandsWhatProjectsAboveTheThresholdOnly)
{
  RenderFront front(sevenNodes());
  ScriptedResidency residency;
  residency.otherwise = State::Resident;
  // At 1000 above the nearest point of the root's sphere its spacing of 8 covers 8 px.
  const FrontDelta& delta = settle(front, fromAbove(1200.0), residency, settleAt(4.5));
  EXPECT_TRUE(delta.complete);
  EXPECT_EQ(drawn(delta), (Nodes{ 0, 1, 2 }));
  EXPECT_EQ(delta.frontLength, 2u);
  for (const DrawItem& item : delta.draw)
  {
    EXPECT_EQ(item.pointCount < 100, item.node != 0) << "ancestors whole, the front by prefix";
  }
  EXPECT_LE(delta.errorPx, 4.5 * 1.01);

  const FrontDelta& fine = settle(front, fromAbove(1200.0), residency, settleAt(0.5));
  EXPECT_EQ(drawn(fine), (Nodes{ 0, 1, 2, 3, 4, 5, 6 }));
  EXPECT_EQ(fine.pointsDrawn, 700u) << "every point of every visible node";
  EXPECT_EQ(fine.errorPx, 0.0);
  EXPECT_TRUE(fine.complete);
  EXPECT_FALSE(fine.limitedByBudget);
}

// Replace:   0     and never  0        children replace their parent, whole groups only
//                            / \ .
//                           1  (2)
TEST(RenderFront, AParentStandsInUntilAllItsChildrenAreThere)
{
  RenderFront front(sevenNodes(Refinement::Replace));
  ScriptedResidency residency;
  const View view = fromAbove(1200.0);
  residency.set(0, State::Resident);
  residency.set(1, State::Resident);
  const FrontDelta& delta = front.update(view, residency, settleAt(4.5));
  EXPECT_EQ(drawn(delta), Nodes{ 0 });
  EXPECT_EQ(requested(delta), std::vector<NodeIndex>{ 2 });
  residency.set(2, State::Resident);
  front.update(view, residency, settleAt(4.5));
  EXPECT_EQ(drawn(delta), (Nodes{ 1, 2 }));
  EXPECT_EQ(delta.pointsDrawn, 200u);
}

//        0
//      /   \ .
//     1     2
//    / \   x \      5 cannot be read
TEST(RenderFront, AFailedNodeIsCountedAndNotAskedForAgain)
{
  for (const Refinement refinement : { Refinement::Add, Refinement::Replace })
  {
    RenderFront front(sevenNodes(refinement));
    ScriptedResidency residency;
    residency.set(5, State::Failed);
    const FrontDelta& delta = settle(front, fromAbove(1200.0), residency, settleAt(0.5));
    EXPECT_TRUE(delta.complete);
    EXPECT_EQ(delta.failedNodes, 1u);
    EXPECT_TRUE(delta.requests.empty());
    EXPECT_EQ(drawn(delta),
      refinement == Refinement::Add ? (Nodes{ 0, 1, 2, 3, 4, 6 }) : (Nodes{ 2, 3, 4 }));
    EXPECT_GT(delta.errorPx, 3.0) << "what is shown there is the parent's spacing";
  }
}

//        0
//      x   \        1 cannot be read; 3 and 4 are stored apart from it
//     1     2
//    / \   / \     .
TEST(RenderFront, BelowAFailedNodeTheOthersGoOn)
{
  RenderFront front(sevenNodes());
  ScriptedResidency residency;
  residency.set(1, State::Failed);
  const FrontDelta& delta = settle(front, fromAbove(1200.0), residency, settleAt(0.5));
  EXPECT_TRUE(delta.complete);
  EXPECT_EQ(drawn(delta), (Nodes{ 0, 2, 3, 4, 5, 6 }));
}

//        0          the eye over the left half sees 0, 1, 3, 4
//      /   \ .
//     1     2       2 is out of sight: asked for last, as an optional sibling
TEST(RenderFront, SiblingsOutOfSightComeLastAndDoNotKeepAViewFromBeingComplete)
{
  RenderFront front(sevenNodes());
  ScriptedResidency residency;
  const View view = fromAbove(150.0, -150.0);
  FrontLimits limits = settleAt(0.5);
  const FrontDelta& delta = front.update(view, residency, limits);
  ASSERT_EQ(requested(delta), (std::vector<NodeIndex>{ 0, 1, 3, 4, 2 }));
  EXPECT_TRUE(delta.requests.back().optional);
  residency.load(delta.requests, 4);
  settle(front, view, residency, limits, 1);
  for (int u = 0; u < 3 && !delta.complete; ++u)
  {
    front.update(view, residency, limits);
  }
  EXPECT_TRUE(delta.complete);
  EXPECT_EQ(requested(delta), std::vector<NodeIndex>{ 2 });
  limits.prefetchSiblings = false;
  EXPECT_TRUE(front.update(view, residency, limits).requests.empty());
}

//        0
//      /   \        turned away from 2: not drawn at once, out of the cut in time
//     1     2
//          / \     .
TEST(RenderFront, CulledBranchesAreNotDrawnAndLeaveTheCutInTime)
{
  RenderFront front(sevenNodes());
  ScriptedResidency residency;
  residency.otherwise = State::Resident;
  const FrontLimits limits = settleAt(0.5);
  const FrontDelta& delta = settle(front, fromAbove(1200.0), residency, limits);
  EXPECT_EQ(delta.frontLength, 4u);
  front.update(fromAbove(150.0, -150.0), residency, limits);
  EXPECT_EQ(drawn(delta), (Nodes{ 0, 1, 3, 4 }));
  EXPECT_EQ(delta.frontLength, 4u);
  EXPECT_EQ(front.distanceUnderFront(4), 0u);
  EXPECT_EQ(front.distanceUnderFront(2), 1u) << "may go, but later than what is below it";
  EXPECT_EQ(front.distanceUnderFront(5), 2u);
  for (int u = 0; u < 40; ++u)
  {
    front.update(fromAbove(150.0 + u, -150.0), residency, limits);
  }
  EXPECT_EQ(delta.frontLength, 3u);
}

TEST(RenderFront, DistanceUnderTheFrontCountsLevels)
{
  RenderFront front(sevenNodes());
  ScriptedResidency residency;
  residency.otherwise = State::Resident;
  settle(front, fromAbove(9000.0), residency, settleAt(4.0));
  EXPECT_EQ(front.distanceUnderFront(0), 0u);
  EXPECT_EQ(front.distanceUnderFront(2), 1u);
  EXPECT_EQ(front.distanceUnderFront(6), 2u);
  settle(front, fromAbove(1200.0), residency, settleAt(0.5));
  EXPECT_EQ(front.distanceUnderFront(6), 0u);
}

TEST(RenderFront, EmptyInnerNodesAreNeverAskedForAndDoNotStandInTheWay)
{
  std::vector<Node> nodes;
  const auto seven = sevenNodes();
  for (NodeIndex n = 0; n < 7; ++n)
  {
    nodes.push_back(seven->node(n));
  }
  for (const NodeIndex n : { 0, 2 })
  {
    nodes[n].pointCount = 0;
    nodes[n].spacing = 0.0f; // nothing there that could have one
  }
  for (const Refinement refinement : { Refinement::Add, Refinement::Replace })
  {
    RenderFront front(
      std::make_shared<HierarchyTable>(nodes, std::vector<NodeIndex>{ 0 }, refinement));
    ScriptedResidency residency;
    residency.set(0, State::Failed); // would be noticed if it were asked for
    const FrontDelta& delta = settle(front, fromAbove(1200.0), residency, settleAt(0.5));
    EXPECT_TRUE(delta.complete);
    EXPECT_EQ(delta.failedNodes, 0u);
    EXPECT_EQ(drawn(delta),
      refinement == Refinement::Add ? (Nodes{ 1, 3, 4, 5, 6 }) : (Nodes{ 3, 4, 5, 6 }));
  }
}

TEST(RenderFront, DrawsNearToFarWithTiesByNode)
{
  test::TreeShape shape;
  const auto tree = test::randomTree(shape);
  RenderFront front(tree);
  ScriptedResidency residency;
  residency.otherwise = State::Resident;
  const View view =
    View::perspective({ 900, 300, 700 }, { 0, 0, 0 }, { 0, 0, 1 }, 0.8, 0.1, 1e4, 800, 600);
  const FrontDelta& delta = settle(front, view, residency, settleAt(3.0));
  ASSERT_GT(delta.draw.size(), 100u);
  for (std::size_t i = 0; i < delta.draw.size(); ++i)
  {
    const DrawItem& item = delta.draw[i];
    EXPECT_FLOAT_EQ(item.distance, float(distanceToNode(view, tree->node(item.node))));
    EXPECT_FLOAT_EQ(item.errorPx, float(screenError(view, tree->node(item.node))));
    if (i > 0)
    {
      const DrawItem& before = delta.draw[i - 1];
      EXPECT_TRUE(before.distance < item.distance ||
        (before.distance == item.distance && before.node < item.node));
    }
  }
}

TEST(RenderFront, NothingChangedEndsAtOnce)
{
  RenderFront front(sevenNodes());
  ScriptedResidency residency;
  residency.tellRevisions();
  const View view = fromAbove(1200.0);
  const FrontDelta& delta = settle(front, view, residency, FrontLimits());
  ASSERT_TRUE(delta.complete);
  const std::uint64_t asked = residency.asked;
  front.update(view, residency, FrontLimits());
  EXPECT_EQ(residency.asked, asked);
  EXPECT_TRUE(delta.complete);
  EXPECT_EQ(delta.pointsDrawn, 700u);
  residency.set(6, State::Absent); // someone else's view released it
  front.update(view, residency, FrontLimits());
  EXPECT_FALSE(delta.complete);
  EXPECT_EQ(requested(delta), std::vector<NodeIndex>{ 6 });
}

TEST(RenderFront, WhatArrivesInTheMiddleOfAnUpdateIsNewsToTheNext)
{
  RenderFront front(sevenNodes());
  ScriptedResidency residency;
  residency.tellRevisions();
  residency.otherwise = State::Resident;
  residency.set(6, State::Absent);
  const View view = fromAbove(1200.0);
  for (int update = 0; update < 30; ++update)
  {
    front.update(view, residency, FrontLimits());
  }
  residency.set(6, State::Absent); // some change, so that the next update looks again
  // Node 6 comes from a loader thread just after that update was told that it is absent.
  residency.afterAsked = [&](NodeIndex node)
  {
    if (node == 6)
    {
      residency.afterAsked = nullptr;
      residency.set(6, State::Resident);
    }
  };
  const FrontDelta& delta = front.update(view, residency, FrontLimits());
  ASSERT_EQ(residency.afterAsked, nullptr);
  EXPECT_EQ(delta.pointsDrawn, 600u);
  front.update(view, residency, FrontLimits());
  EXPECT_TRUE(delta.complete);
  EXPECT_EQ(delta.pointsDrawn, 700u);
}

TEST(RenderFront, ResetStartsAgain)
{
  RenderFront front(sevenNodes());
  ScriptedResidency residency;
  settle(front, fromAbove(1200.0), residency, FrontLimits());
  front.reset();
  const FrontDelta& delta = front.update(fromAbove(1200.0), residency, FrontLimits());
  EXPECT_GE(delta.thresholdPx, 48.0);
  EXPECT_EQ(delta.frontLength, 1u);
}

} // namespace pointfront
