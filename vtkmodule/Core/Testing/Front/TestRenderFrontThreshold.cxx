// The threshold of a front (FRONT-7), its moves (FRONT-6) and its budgets (FRONT-8).

#include "pointfront/Front/RenderFront.h"

#include "SevenNodes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pointfront
{

using namespace test;
using State = ResidencySnapshot::State;

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
  test::TreeShape shape;
  shape.childChance = 1.0;
  const auto tree = test::randomTree(shape);
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

} // namespace pointfront
