#include "pointfront/Front/RenderFront.h"

#include "FrontScene.h"
#include "pointfront/Front/PointPrefix.h"
#include "pointfront/Front/ScreenError.h"
#include "pointfront/Front/ThresholdLadder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace pointfront
{
namespace
{

using testing::ScriptedResidency;
using State = ResidencyView::State;

//        0          spacing 8     x = 0
//      /   \ .
//     1     2       spacing 4     x = -100, +100
//    / \   / \ .
//   3   4 5   6     spacing 2     x = -150, -50, 50, 150
std::shared_ptr<const HierarchyTable> sevenNodes(Refinement refinement = Refinement::Add)
{
  const double x[] = { 0, -100, 100, -150, -50, 50, 150 };
  const float radius[] = { 200, 100, 100, 50, 50, 50, 50 };
  const float spacing[] = { 8, 4, 4, 2, 2, 2, 2 };
  std::vector<Node> nodes(7);
  for (NodeIndex n = 0; n < 7; ++n)
  {
    nodes[n].centre = { x[n], 0, 0 };
    nodes[n].radius = radius[n];
    nodes[n].spacing = spacing[n];
    nodes[n].pointCount = 100;
    nodes[n].level = std::uint8_t(n == 0 ? 0 : n < 3 ? 1 : 2);
    nodes[n].parent = n == 0 ? noNode : (n - 1) / 2;
    nodes[n].firstChild = n < 3 ? 2 * n + 1 : noNode;
    nodes[n].childCount = n < 3 ? 2 : 0;
  }
  return std::make_shared<HierarchyTable>(nodes, std::vector<NodeIndex>{ 0 }, refinement);
}

/// Looking down from `height`, everything in sight; 1000 pixels a unit at depth 1.
View fromAbove(double height, double x = 0.0)
{
  return View::perspective({ x, 0, height }, { x, 0, 0 }, { 0, 1, 0 },
    2.0 * std::atan(0.5), 0.1, 1e5, 1000, 1000);
}

/// Straight to an error, without the fall from 60 px.
FrontLimits settleAt(double targetPx)
{
  FrontLimits limits;
  limits.targetErrorPx = targetPx;
  limits.initialErrorPx = targetPx;
  return limits;
}

const FrontDelta& settle(RenderFront& front, const View& view, ScriptedResidency& residency,
  const FrontLimits& limits, int updates = 200)
{
  const FrontDelta* delta = &front.update(view, residency, limits);
  for (int u = 1; u < updates && !delta->complete; ++u)
  {
    residency.load(delta->requests);
    delta = &front.update(view, residency, limits);
  }
  return *delta;
}

std::set<NodeIndex> drawn(const FrontDelta& delta)
{
  std::set<NodeIndex> nodes;
  for (const DrawItem& item : delta.draw)
  {
    nodes.insert(item.node);
  }
  return nodes;
}

std::vector<NodeIndex> requested(const FrontDelta& delta)
{
  std::vector<NodeIndex> nodes;
  for (const LoadRequest& request : delta.requests)
  {
    nodes.push_back(request.node);
  }
  return nodes;
}

using Nodes = std::set<NodeIndex>;

} // namespace

TEST(PointPrefix, FadesInBetweenTheParentsTurnAndItsOwn)
{
  EXPECT_EQ(prefixFraction(2.0, 0.5, 4.0), 0.0); // the parent's 4 px are fine enough
  EXPECT_EQ(prefixFraction(2.0, 0.5, 9.0), 0.0);
  EXPECT_EQ(prefixFraction(2.0, 0.5, 2.0), 1.0);
  EXPECT_EQ(prefixFraction(2.0, 0.5, 0.1), 1.0);
  // Half way in density: 1/t^2 = (1/2^2 + 1/4^2) / 2.
  EXPECT_NEAR(prefixFraction(2.0, 0.5, 1.0 / std::sqrt((0.25 + 0.0625) / 2.0)), 0.5, 1e-12);
  EXPECT_NEAR(prefixFraction(2.0, 0.0, 4.0), 0.25, 1e-12); // a root: spacing ~ sqrt(n / k)
  double before = 0.0;
  for (double threshold = 5.0; threshold > 1.0; threshold *= 0.99)
  {
    const double now = prefixFraction(2.0, 0.5, threshold);
    EXPECT_GE(now, before);
    EXPECT_LT(now - before, 0.04) << "no chunk pops up at once";
    before = now;
  }
  const std::uint32_t points = prefixLength(10000, 2.0, 0.5, 3.0);
  EXPECT_NEAR(prefixErrorPx(10000, points, 2.0, 0.5), 3.0, 1e-3);
}

TEST(ThresholdLadder, HasTheTargetTheInitialThresholdAndSmallSteps)
{
  const ThresholdLadder ladder(1.3, 60.0);
  EXPECT_EQ(ladder.at(0), 1.3);
  EXPECT_EQ(ladder.at(ladder.initialRung()), 60.0);
  for (int rung = 0; rung <= ladder.initialRung() + 10; ++rung)
  {
    EXPECT_EQ(ladder.rungFor(ladder.at(rung)), rung);
    EXPECT_GT(ladder.at(rung + 1), ladder.at(rung));
    EXPECT_LT(ladder.at(rung + 1), ladder.at(rung) * 1.012);
  }
  EXPECT_EQ(ladder.rungFor(0.1), 0);
  EXPECT_EQ(ThresholdLadder(5.0, 1.0).initialRung(), 0);
}

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

TEST(RenderFront, ThresholdStartsAtSixtyAndFallsToTheTarget)
{
  RenderFront front(sevenNodes());
  ScriptedResidency residency;
  residency.otherwise = State::Resident;
  FrontLimits limits;
  const View view = fromAbove(1200.0);
  std::vector<double> thresholds;
  std::uint64_t points = 0;
  for (int u = 0; u < 60; ++u)
  {
    const FrontDelta& delta = front.update(view, residency, limits);
    if (!thresholds.empty())
    {
      EXPECT_LE(delta.thresholdPx, thresholds.back());
      EXPECT_GE(delta.thresholdPx, thresholds.back() * 0.79);
    }
    EXPECT_GE(delta.pointsDrawn, points) << "detail is added, never taken back";
    points = delta.pointsDrawn;
    thresholds.push_back(delta.thresholdPx);
    if (delta.complete)
    {
      break;
    }
  }
  EXPECT_LE(thresholds.front(), 60.0);
  EXPECT_GE(thresholds.front(), 48.0);
  EXPECT_EQ(thresholds.back(), 1.0);
  EXPECT_LT(thresholds.size(), 25u);
}

TEST(RenderFront, InMotionTheThresholdRisesAndAtRestItFallsAgain)
{
  RenderFront front(sevenNodes());
  ScriptedResidency residency;
  residency.otherwise = State::Resident;
  FrontLimits limits;
  settle(front, fromAbove(1200.0), residency, limits);
  limits.interacting = true;
  limits.motionErrorPx = 5.0;
  const FrontDelta& delta = front.update(fromAbove(1190.0), residency, limits);
  EXPECT_GE(delta.thresholdPx, 5.0);
  EXPECT_LT(delta.thresholdPx, 5.1);
  EXPECT_FALSE(delta.complete);
  EXPECT_EQ(drawn(delta), (Nodes{ 0, 1, 2 })) << "at once, however many moves that takes";
  limits.interacting = false;
  settle(front, fromAbove(1190.0), residency, limits);
  EXPECT_TRUE(delta.complete);
  EXPECT_EQ(delta.thresholdPx, 1.0);
}

TEST(RenderFront, ASmallStepBackAndForthDoesNotMoveTheFront)
{
  RenderFront front(sevenNodes());
  ScriptedResidency residency;
  residency.otherwise = State::Resident;
  const FrontLimits limits = settleAt(4.0);
  // At 1100 above the spheres of 1 and 2 (spacing 4) their error is near 4 px.
  settle(front, fromAbove(1090.0), residency, limits);
  std::uint32_t moves = 0;
  for (int u = 0; u < 20; ++u)
  {
    moves += front.update(fromAbove(u % 2 ? 1090.0 : 1120.0), residency, limits).moves;
  }
  EXPECT_EQ(moves, 0u);
  // Far away it does collapse.
  const FrontDelta& delta = settle(front, fromAbove(9000.0), residency, limits);
  EXPECT_EQ(delta.frontLength, 1u);
}

TEST(RenderFront, MovesAreBoundedAndGoOnInTheNextUpdate)
{
  testing::TreeShape shape;
  shape.childChance = 1.0;
  const auto tree = testing::randomTree(shape);
  ScriptedResidency residency;
  residency.otherwise = State::Resident;
  FrontLimits limits = settleAt(1.0);
  limits.movesPerFrame = 100000;
  RenderFront unbounded(tree);
  const FrontDelta& all = settle(unbounded, fromAbove(2000.0), residency, limits);
  limits.movesPerFrame = 5;
  RenderFront bounded(tree);
  int updates = 0;
  const FrontDelta* delta = nullptr;
  do
  {
    delta = &bounded.update(fromAbove(2000.0), residency, limits);
    EXPECT_LE(delta->moves, 5u);
    ASSERT_LT(++updates, 5000);
  } while (!delta->complete);
  EXPECT_GT(updates, 20);
  EXPECT_EQ(drawn(*delta), drawn(all));
  EXPECT_EQ(delta->pointsDrawn, all.pointsDrawn);
}

//        0
//      /   \       budget: 450 of 700 points
//     1     2
TEST(RenderFront, ABudgetSettlesAtTheLowestThresholdThatFits)
{
  RenderFront front(sevenNodes());
  ScriptedResidency residency;
  FrontLimits limits;
  limits.pointBudget = 450;
  const View view = fromAbove(1200.0);
  const FrontDelta& delta = settle(front, view, residency, limits);
  EXPECT_TRUE(delta.complete);
  EXPECT_TRUE(delta.limitedByBudget);
  EXPECT_LE(delta.pointsDrawn, 450u);
  EXPECT_GT(delta.pointsDrawn, 430u);
  EXPECT_GT(delta.thresholdPx, 1.0);
  // It stays there.
  const double threshold = delta.thresholdPx;
  const std::uint64_t points = delta.pointsDrawn;
  for (int u = 0; u < 50; ++u)
  {
    front.update(view, residency, limits);
    EXPECT_EQ(delta.thresholdPx, threshold);
    EXPECT_EQ(delta.pointsDrawn, points);
    EXPECT_EQ(delta.moves, 0u);
    EXPECT_TRUE(delta.complete);
  }
  // And another way there ends at the same list.
  RenderFront other(sevenNodes());
  settle(other, fromAbove(500.0, 100.0), residency, limits);
  const FrontDelta& again = settle(other, view, residency, limits);
  EXPECT_EQ(again.pointsDrawn, points);
  EXPECT_EQ(again.thresholdPx, threshold);
  // With room it goes on to the target.
  limits.pointBudget = 10000;
  EXPECT_EQ(settle(front, view, residency, limits).pointsDrawn, 700u);
  EXPECT_FALSE(delta.limitedByBudget);
}

TEST(RenderFront, ABudgetOfHeldPointsKeepsWholeNodesBelowIt)
{
  RenderFront front(sevenNodes());
  ScriptedResidency residency;
  FrontLimits limits;
  limits.heldPointBudget = 350;
  const FrontDelta& delta = settle(front, fromAbove(1200.0), residency, limits);
  EXPECT_TRUE(delta.complete);
  EXPECT_TRUE(delta.limitedByMemory);
  EXPECT_FALSE(delta.limitedByBudget);
  EXPECT_EQ(drawn(delta), (Nodes{ 0, 1, 2 }));
}

TEST(RenderFront, AnExhaustedResidencyEndsTheView)
{
  RenderFront front(sevenNodes());
  ScriptedResidency residency;
  const View view = fromAbove(1200.0);
  for (const NodeIndex n : { 0, 1, 2, 3 })
  {
    residency.set(n, State::Resident);
  }
  for (int u = 0; u < 50; ++u)
  {
    EXPECT_FALSE(front.update(view, residency, FrontLimits()).complete);
  }
  residency.full = true;
  // Another view: the residency has not heard of its wishes yet.
  const FrontDelta& delta = front.update(fromAbove(1201.0), residency, FrontLimits());
  EXPECT_FALSE(delta.complete);
  front.update(fromAbove(1201.0), residency, FrontLimits());
  EXPECT_TRUE(delta.complete);
  EXPECT_TRUE(delta.limitedByMemory);
  EXPECT_EQ(requested(delta), (std::vector<NodeIndex>{ 4, 5, 6 }));
  EXPECT_GT(delta.errorPx, 3.0);
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
  testing::TreeShape shape;
  const auto tree = testing::randomTree(shape);
  RenderFront front(tree);
  ScriptedResidency residency;
  residency.otherwise = State::Resident;
  const View view = View::perspective(
    { 900, 300, 700 }, { 0, 0, 0 }, { 0, 0, 1 }, 0.8, 0.1, 1e4, 800, 600);
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
