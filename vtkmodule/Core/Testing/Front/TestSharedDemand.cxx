// Fronts that share memory and a window settle at one error.

#include "pointfront/Front/RenderFront.h"
#include "pointfront/Front/SharedDemand.h"

#include "FrontScene.h"

#include <gtest/gtest.h>

#include <random>

namespace pointfront
{
namespace
{

using State = ResidencySnapshot::State;

View seenFrom(double x)
{
  return View::perspective({ x, 300, 200 }, { 0, 0, 0 }, { 0, 0, 1 }, 0.9, 0.1, 1e5, 800, 600);
}

/// State that all clouds share.
struct Shared
{
  std::shared_ptr<SharedDemand> memory = std::make_shared<SharedDemand>();
  std::shared_ptr<SharedDemand> window = std::make_shared<SharedDemand>();
  std::shared_ptr<SharedDemand> gpu = std::make_shared<SharedDemand>();
};

/// One cloud: a front with everything loaded, and its claims.
struct Cloud
{
  Cloud(std::uint32_t seed, const Shared& shared, Refinement refinement = Refinement::Add)
    : tree(treeOf(seed, refinement))
    , front(tree)
    , held(shared.memory)
    , drawn(shared.window)
    , slots(shared.gpu)
  {
    residency.otherwise = State::Resident;
    residency.tellRevisions();
    limits.targetErrorPx = 2.0;
    limits.movesPerFrame = 500;
  }
  static std::shared_ptr<const HierarchyTable> treeOf(std::uint32_t seed, Refinement refinement)
  {
    test::TreeShape shape;
    shape.seed = seed;
    shape.refinement = refinement;
    return test::randomTree(shape);
  }
  std::uint64_t revision() const { return held.revision() + drawn.revision() + slots.revision(); }
  bool changed() const { return revision() != seen; }
  void update()
  {
    seen = revision();
    held.elsewhere(elsewhere.held);
    drawn.elsewhere(elsewhere.drawn);
    slots.elsewhere(elsewhere.slots);
    limits.sharedHeld = { heldPoints, &elsewhere.held };
    limits.sharedDrawn = { drawnPoints, &elsewhere.drawn };
    limits.sharedSlots = { gpuSlots, &elsewhere.slots };
    limits.sharedRevision = seen;
    delta = &front.update(view, residency, limits);
    DemandCurves curves;
    front.demandCurves(curves);
    const std::uint64_t before = revision();
    held.set(curves.held);
    drawn.set(curves.drawn);
    slots.set(curves.slots);
    seen += revision() - before;
  }
  std::uint64_t needed() const
  {
    std::uint64_t sum = 0;
    for (NodeIndex n = 0; n < tree->nodeCount(); ++n)
    {
      sum += front.distanceUnderFront(n) == 0 ? tree->node(n).pointCount : 0;
    }
    return sum;
  }

  std::shared_ptr<const HierarchyTable> tree;
  RenderFront front;
  test::ScriptedResidency residency;
  SharedDemand::Claim held;
  SharedDemand::Claim drawn;
  SharedDemand::Claim slots;
  DemandCurves elsewhere;
  FrontLimits limits;
  View view = seenFrom(1000.0);
  std::uint64_t heldPoints = 0;
  std::uint64_t drawnPoints = 0;
  std::uint64_t gpuSlots = 0;
  std::uint64_t seen = 0;
  const FrontDelta* delta = nullptr;
};

std::uint64_t slotsOf(const std::vector<DrawItem>& draw)
{
  std::uint64_t slots = 0;
  for (const DrawItem& item : draw)
  {
    slots += (item.pointCount + 4095) / 4096;
  }
  return slots;
}

struct Scene
{
  explicit Scene(std::uint32_t count, Refinement refinement = Refinement::Add)
  {
    for (std::uint32_t c = 0; c < count; ++c)
    {
      clouds.push_back(std::make_unique<Cloud>(c + 1, shared, refinement));
    }
  }
  void update()
  {
    for (const auto& cloud : clouds)
    {
      cloud->update();
    }
  }
  /// Renders as long as any cloud asks for it.
  void settle()
  {
    bool again = true;
    int frames = 0;
    for (; again && frames < 500; ++frames)
    {
      update();
      again = false;
      for (const auto& cloud : clouds)
      {
        again = again || cloud->changed() || !cloud->delta->complete;
      }
    }
    EXPECT_LT(frames, 500) << "the scene comes to rest";
  }
  void limit(std::uint64_t heldPoints, std::uint64_t drawnPoints, std::uint64_t gpuSlots = 0)
  {
    for (const auto& cloud : clouds)
    {
      cloud->heldPoints = heldPoints;
      cloud->drawnPoints = drawnPoints;
      cloud->gpuSlots = gpuSlots;
    }
  }
  std::uint64_t pointsDrawn() const
  {
    std::uint64_t sum = 0;
    for (const auto& cloud : clouds)
    {
      sum += cloud->delta->pointsDrawn;
    }
    return sum;
  }
  std::uint64_t slotsDrawn() const
  {
    std::uint64_t sum = 0;
    for (const auto& cloud : clouds)
    {
      sum += cloud->delta->slotsDrawn;
    }
    return sum;
  }
  std::uint64_t pointsNeeded() const
  {
    std::uint64_t sum = 0;
    for (const auto& cloud : clouds)
    {
      sum += cloud->needed();
    }
    return sum;
  }
  double spread() const
  {
    double least = 1e30;
    double most = 0.0;
    for (const auto& cloud : clouds)
    {
      least = std::min(least, cloud->delta->thresholdPx);
      most = std::max(most, cloud->delta->thresholdPx);
    }
    return most / least;
  }

  Shared shared;
  std::vector<std::unique_ptr<Cloud>> clouds;
};

} // namespace

// Whoever comes down to a lower budget first finds the others where they were: what they have at
// this moment does not count until they had their turn, what they will take does.
TEST(SharedDemand, WhoIsYetToComeDownDoesNotStarveWhoComesFirst)
{
  const auto shared = std::make_shared<SharedDemand>();
  SharedDemand::Claim first(shared);
  SharedDemand::Claim second(shared);
  SharedDemand::Claim third(shared);
  const auto curve = [](std::uint64_t now, std::uint64_t later)
  {
    DemandCurve made;
    for (std::size_t step = 0; step < DemandCurve::size; ++step)
    {
      made[step] = later;
    }
    made[0] = now;
    return made;
  };
  first.set(curve(40, 10), 100);
  second.set(curve(40, 10)); // without a budget
  third.set(curve(40, 10), 50);
  DemandCurve others;
  first.elsewhere(others, 100);
  EXPECT_EQ(others[0], 40u) << "the third has a lower one already";
  EXPECT_EQ(others[1], 20u);
  first.elsewhere(others, 30);
  EXPECT_EQ(others[0], 0u);
  EXPECT_EQ(others[1], 20u);
  const std::uint64_t before = first.revision();
  second.set(curve(40, 10), 30);
  EXPECT_NE(first.revision(), before) << "from now on it counts";
  first.elsewhere(others, 30);
  EXPECT_EQ(others[0], 40u);
  second.set(curve(7, 7), 30);
  third.set(curve(5, 5), 30);
  first.elsewhere(others, 30);
  EXPECT_EQ(others[0], 12u);
}

TEST(DemandCurve, IsATableOverThresholds)
{
  EXPECT_EQ(DemandCurve::stepOf(0.0), 0u);
  EXPECT_EQ(DemandCurve::stepOf(1e30), DemandCurve::size - 1);
  for (std::size_t step = 0; step < DemandCurve::size; ++step)
  {
    EXPECT_EQ(DemandCurve::stepOf(DemandCurve::pxOf(step) * 1.001), step);
  }
  DemandCurve curve;
  for (std::size_t step = 0; step < DemandCurve::size; ++step)
  {
    curve[step] = 1000 - step;
  }
  curve.levelOff(4.0);
  EXPECT_EQ(curve.at(0.1), curve.at(4.0));
  EXPECT_LT(curve.at(8.0), curve.at(4.0));
}

TEST(SharedDemand, TellsEachWhatTheOthersTake)
{
  const auto shared = std::make_shared<SharedDemand>();
  SharedDemand::Claim one(shared);
  DemandCurve others;
  DemandCurve curve;
  curve[10] = 7;
  {
    SharedDemand::Claim two(shared);
    const std::uint64_t before = one.revision();
    two.set(curve);
    EXPECT_NE(one.revision(), before);
    one.elsewhere(others);
    EXPECT_EQ(others[10], 7u);
    two.elsewhere(others);
    EXPECT_EQ(others[10], 0u);
    const std::uint64_t same = one.revision();
    two.set(curve);
    EXPECT_EQ(one.revision(), same) << "no news";
  }
  one.elsewhere(others);
  EXPECT_EQ(others[10], 0u) << "withdrawn";
}

TEST(SharedDemand, TheCurveIsWhatAFrontTakesAtEachThreshold)
{
  Scene scene(1);
  scene.settle();
  Cloud& cloud = *scene.clouds[0];
  DemandCurves curves;
  cloud.front.demandCurves(curves);
  const DemandCurve& drawn = curves.drawn;
  EXPECT_EQ(drawn[0], cloud.delta->pointsDrawn);
  EXPECT_EQ(curves.slots[0], cloud.delta->slotsDrawn);
  EXPECT_EQ(cloud.delta->slotsDrawn, slotsOf(cloud.delta->draw));
  for (const double px : { 4.0, 16.0, 64.0 })
  {
    Cloud coarse(1, scene.shared);
    coarse.limits.targetErrorPx = px;
    for (int u = 0; u < 60; ++u)
    {
      coarse.update();
    }
    ASSERT_TRUE(coarse.delta->complete);
    EXPECT_GE(drawn.at(px) + 10, coarse.delta->pointsDrawn) << px;
    EXPECT_LE(double(drawn.at(px)), 1.3 * double(coarse.delta->pointsDrawn) + 100.0) << px;
    EXPECT_GE(curves.slots.at(px), coarse.delta->slotsDrawn) << px;
    EXPECT_LE(double(curves.slots.at(px)), 1.3 * double(coarse.delta->slotsDrawn) + 5.0) << px;
  }
}

TEST(SharedDemand, CloudsSettleAtOneErrorInsideTheMemory)
{
  for (const Refinement refinement : { Refinement::Add, Refinement::Replace })
  {
    Scene alone(4, refinement);
    alone.settle();
    const std::uint64_t everything = alone.pointsNeeded();
    Scene scene(4, refinement);
    scene.limit(everything / 3, 0);
    scene.settle();
    EXPECT_LE(scene.pointsNeeded(), everything / 3);
    EXPECT_GT(scene.pointsNeeded(), everything / 8);
    EXPECT_LT(scene.spread(), refinement == Refinement::Add ? 1.5 : 2.5);
    for (const auto& cloud : scene.clouds)
    {
      EXPECT_TRUE(cloud->delta->limitedByMemory);
      EXPECT_FALSE(cloud->delta->limitedByBudget);
    }
    // At rest nothing moves.
    const std::uint64_t drawn = scene.pointsDrawn();
    for (int frame = 0; frame < 10; ++frame)
    {
      scene.update();
      EXPECT_EQ(scene.pointsDrawn(), drawn);
    }
  }
}

TEST(SharedDemand, ANewCloudTakesItsPartAndLeavesItAgain)
{
  Scene scene(3);
  scene.limit(0, 30000);
  scene.settle();
  EXPECT_LE(scene.pointsDrawn(), 30000u);
  EXPECT_GT(scene.pointsDrawn(), 24000u);
  const double before = scene.clouds[0]->delta->thresholdPx;
  scene.clouds.push_back(std::make_unique<Cloud>(9, scene.shared));
  scene.limit(0, 30000);
  scene.settle();
  EXPECT_LE(scene.pointsDrawn(), 30000u);
  EXPECT_GT(scene.clouds[0]->delta->thresholdPx, before);
  EXPECT_LT(scene.spread(), 1.5);
  scene.clouds.pop_back();
  scene.settle();
  EXPECT_LE(scene.clouds[0]->delta->thresholdPx, before * 1.2);
}

TEST(SharedDemand, CloudsSettleAtOneErrorInsideTheGpu)
{
  for (const Refinement refinement : { Refinement::Add, Refinement::Replace })
  {
    Scene alone(4, refinement);
    alone.settle();
    const std::uint64_t everything = alone.slotsDrawn();
    Scene scene(4, refinement);
    scene.limit(0, 0, everything / 3);
    scene.settle();
    EXPECT_LE(scene.slotsDrawn(), everything / 3);
    EXPECT_GT(scene.slotsDrawn(), everything / 8);
    EXPECT_LT(scene.spread(), refinement == Refinement::Add ? 1.5 : 2.5);
    for (const auto& cloud : scene.clouds)
    {
      EXPECT_TRUE(cloud->delta->limitedByGpu);
      EXPECT_FALSE(cloud->delta->limitedByBudget);
      EXPECT_FALSE(cloud->delta->limitedByMemory);
      EXPECT_TRUE(cloud->delta->complete);
    }
    scene.limit(0, 0, 0);
    scene.settle();
    EXPECT_EQ(scene.slotsDrawn(), everything) << "the limit leaves nothing behind";
  }
}

TEST(SharedDemand, WhatIsLeftOfASmallLimitIsTakenBesideALargeOne)
{
  Scene scene(2);
  scene.limit(50000000, 30000); // memory for all, points for few
  scene.settle();
  const std::uint64_t shared = scene.clouds[0]->delta->pointsDrawn;
  EXPECT_LT(shared, 20000u);
  scene.clouds.pop_back();
  scene.settle();
  EXPECT_GT(scene.clouds[0]->delta->pointsDrawn, 24000u);
}

TEST(SharedDemand, BudgetsHoldInEveryFrameOfEveryPath)
{
  for (std::uint32_t seed = 1; seed <= 4; ++seed)
  {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(400.0, 2500.0);
    Scene scene(5, seed % 2 == 0 ? Refinement::Add : Refinement::Replace);
    const std::uint64_t budget = 20000 + 10000 * seed;
    const std::uint64_t slots = 10 + 10 * seed;
    for (int move = 0; move < 8; ++move)
    {
      scene.limit(0, budget, slots);
      for (const auto& cloud : scene.clouds)
      {
        cloud->view = seenFrom(place(random));
      }
      for (int frame = 0; frame < 40; ++frame)
      {
        for (const auto& cloud : scene.clouds)
        {
          cloud->update();
          // After its update a cloud fits beside what the others draw.
          std::uint64_t all = 0;
          std::uint64_t allSlots = 0;
          for (const auto& other : scene.clouds)
          {
            all += other->delta ? other->delta->pointsDrawn : 0;
            allSlots += other->delta ? slotsOf(other->delta->draw) : 0;
          }
          ASSERT_LE(all, budget);
          ASSERT_LE(allSlots, slots);
        }
      }
      scene.settle();
    }
  }
}

} // namespace pointfront
