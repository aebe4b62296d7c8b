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

using State = ResidencyView::State;

View lookingFrom(double x)
{
  return View::perspective({ x, 300, 200 }, { 0, 0, 0 }, { 0, 0, 1 }, 0.9, 0.1, 1e5, 800, 600);
}

/// One cloud: a front with everything loaded, and its claims.
struct Cloud
{
  Cloud(std::uint32_t seed, std::shared_ptr<SharedDemand> memory,
    std::shared_ptr<SharedDemand> window, Refinement refinement = Refinement::Add)
    : tree(treeOf(seed, refinement))
    , front(tree)
    , held(std::move(memory))
    , drawn(std::move(window))
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
  bool changed() const { return held.revision() + drawn.revision() != seen; }
  void update()
  {
    seen = held.revision() + drawn.revision();
    held.elsewhere(heldElsewhere);
    drawn.elsewhere(drawnElsewhere);
    limits.sharedHeld = { heldPoints, &heldElsewhere };
    limits.sharedDrawn = { drawnPoints, &drawnElsewhere };
    limits.sharedRevision = seen;
    delta = &front.update(view, residency, limits);
    DemandCurve drawnCurve;
    DemandCurve heldCurve;
    front.demandCurves(drawnCurve, heldCurve);
    const std::uint64_t before = held.revision() + drawn.revision();
    held.set(heldCurve);
    drawn.set(drawnCurve);
    seen += held.revision() + drawn.revision() - before;
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
  DemandCurve heldElsewhere;
  DemandCurve drawnElsewhere;
  FrontLimits limits;
  View view = lookingFrom(1000.0);
  std::uint64_t heldPoints = 0;
  std::uint64_t drawnPoints = 0;
  std::uint64_t seen = 0;
  const FrontDelta* delta = nullptr;
};

struct Scene
{
  explicit Scene(std::uint32_t count, Refinement refinement = Refinement::Add)
  {
    for (std::uint32_t c = 0; c < count; ++c)
    {
      clouds.push_back(std::make_unique<Cloud>(c + 1, memory, window, refinement));
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
  void limit(std::uint64_t heldPoints, std::uint64_t drawnPoints)
  {
    for (const auto& cloud : clouds)
    {
      cloud->heldPoints = heldPoints;
      cloud->drawnPoints = drawnPoints;
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

  std::shared_ptr<SharedDemand> memory = std::make_shared<SharedDemand>();
  std::shared_ptr<SharedDemand> window = std::make_shared<SharedDemand>();
  std::vector<std::unique_ptr<Cloud>> clouds;
};

} // namespace

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
  DemandCurve drawn;
  DemandCurve held;
  cloud.front.demandCurves(drawn, held);
  EXPECT_EQ(drawn[0], cloud.delta->pointsDrawn);
  for (const double px : { 4.0, 16.0, 64.0 })
  {
    Cloud coarse(1, scene.memory, scene.window);
    coarse.limits.targetErrorPx = px;
    for (int u = 0; u < 60; ++u)
    {
      coarse.update();
    }
    ASSERT_TRUE(coarse.delta->complete);
    EXPECT_GE(drawn.at(px) + 10, coarse.delta->pointsDrawn) << px;
    EXPECT_LE(double(drawn.at(px)), 1.3 * double(coarse.delta->pointsDrawn) + 100.0) << px;
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
  scene.clouds.push_back(std::make_unique<Cloud>(9, scene.memory, scene.window));
  scene.limit(0, 30000);
  scene.settle();
  EXPECT_LE(scene.pointsDrawn(), 30000u);
  EXPECT_GT(scene.clouds[0]->delta->thresholdPx, before);
  EXPECT_LT(scene.spread(), 1.5);
  scene.clouds.pop_back();
  scene.settle();
  EXPECT_LE(scene.clouds[0]->delta->thresholdPx, before * 1.2);
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
    for (int move = 0; move < 8; ++move)
    {
      scene.limit(0, budget);
      for (const auto& cloud : scene.clouds)
      {
        cloud->view = lookingFrom(place(random));
      }
      for (int frame = 0; frame < 40; ++frame)
      {
        for (const auto& cloud : scene.clouds)
        {
          cloud->update();
          // After its update a cloud fits beside what the others draw.
          std::uint64_t all = 0;
          for (const auto& other : scene.clouds)
          {
            all += other->delta ? other->delta->pointsDrawn : 0;
          }
          ASSERT_LE(all, budget);
        }
      }
      scene.settle();
    }
  }
}

} // namespace pointfront
