// Rules of every selection of detail (rendering front, view-specific detail), for every
// tree, camera path, projection and order of arrival (fixed seeds).

#include "pointfront/Detail/ViewDetail.h"
#include "pointfront/Front/GpuSlots.h"
#include "pointfront/Front/RenderFront.h"

#include "FrontScene.h"
#include "pointfront/Front/ScreenError.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <map>

namespace pointfront
{
namespace
{

using test::ScriptedResidency;
using test::TreeShape;
using State = ResidencySnapshot::State;

struct Case
{
  std::uint32_t seed;
  Refinement refinement;
  bool front; ///< RenderFront, otherwise ViewDetail
};

void PrintTo(const Case& c, std::ostream* out)
{
  *out << (c.front ? "front " : "view detail ")
       << (c.refinement == Refinement::Add ? "add" : "replace") << " seed " << c.seed;
}

std::vector<Case> allCases()
{
  std::vector<Case> cases;
  for (std::uint32_t seed = 1; seed <= 5; ++seed)
  {
    for (const Refinement refinement : { Refinement::Add, Refinement::Replace })
    {
      cases.push_back({ seed, refinement, true });
      cases.push_back({ seed, refinement, false });
    }
  }
  return cases;
}

std::unique_ptr<DetailSelection> selectionOf(
  const Case& c, const std::shared_ptr<const Hierarchy>& tree)
{
  if (c.front)
  {
    return std::make_unique<RenderFront>(tree);
  }
  return std::make_unique<ViewDetail>(tree);
}

std::shared_ptr<const HierarchyTable> treeOf(const Case& c)
{
  TreeShape shape;
  shape.seed = c.seed;
  shape.roots = 1 + int(c.seed % 3);
  shape.childChance = 0.4 + 0.05 * (c.seed % 8);
  shape.refinement = c.refinement;
  return test::randomTree(shape);
}

/// Any view that a host application may set: tiny and huge angles, parallel, off-axis, near planes
/// from 1e-6 to 1e9, from inside nodes, with the tree before or behind the eye.
View anyView(std::mt19937& random)
{
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::uniform_real_distribution<double> place(-1500.0, 1500.0);
  const double closeness = unit(random) < 0.3 ? 0.02 : 1.0;
  const glm::dvec3 eye = closeness * glm::dvec3(place(random), place(random), place(random));
  const glm::dvec3 focus = 0.2 * glm::dvec3(place(random), place(random), place(random));
  const glm::dmat4 camera = glm::lookAt(eye, focus, glm::dvec3(0.01, 0.02, 1.0));
  const double nearPlane = std::pow(10.0, -6.0 + 15.0 * unit(random));
  const double farPlane = nearPlane * std::pow(10.0, 1.0 + 11.0 * unit(random));
  const double shift = unit(random) < 0.3 ? 3.0 * unit(random) - 1.5 : 0.0;
  if (unit(random) < 0.3)
  {
    const double size = std::pow(10.0, -2.0 + 6.0 * unit(random));
    return View::fromMatrix(
      glm::ortho(-size * (1.0 + shift), size * (1.0 - shift), -size, size, nearPlane, farPlane) *
        camera,
      800, 600);
  }
  const double slope = std::pow(10.0, -4.0 + 6.0 * unit(random)); // 0.0002 to nearly 180 degrees
  const double edge = nearPlane * slope;
  return View::fromMatrix(glm::frustum(edge * (shift - 1.0), edge * (shift + 1.0), -0.75 * edge,
                            0.75 * edge, nearPlane, farPlane) *
      camera,
    800, 600);
}

/// A walk in the tree, step by step.
View walkingView(int step)
{
  const double angle = 0.02 * step;
  const glm::dvec3 eye(900.0 * std::cos(angle), 700.0 * std::sin(angle), 250.0);
  return View::perspective(eye, glm::dvec3(0.0), { 0, 0, 1 }, 0.9, 0.1, 1e5, 800, 600);
}

using Counts = std::map<NodeIndex, std::uint32_t>;

struct Trip
{
  explicit Trip(const Case& c)
    : tree(treeOf(c))
    , selection(selectionOf(c, tree))
    , random(c.seed * 104729u)
  {
    for (NodeIndex i = 0; i < tree->nodeCount(); ++i)
    {
      points += tree->node(i).pointCount;
      slots += gpuSlotsOf(tree->node(i).pointCount);
    }
    limits.targetErrorPx = 1.5;
    limits.movesPerFrame = 64;
    limits.requestLimit = 40;
    limits.overviewPoints = points / 50;
    // The coarsest picture of the tree always fits.
    limits.pointBudget = c.seed % 3 == 0 ? 0 : points / (2 + c.seed % 3);
    limits.heldPointBudget = c.seed % 2 == 0 ? 0 : points / 2;
    limits.sharedSlots = { c.seed % 4 == 1 ? 0 : std::max<std::uint64_t>(8, slots / 4), &nobody };
  }

  const FrontDelta& step(const View& view) { return selection->update(view, residency, limits); }

  void arrive(const FrontDelta& delta, std::size_t most, double failures)
  {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (std::size_t r = 0; r < delta.requests.size() && r < most; ++r)
    {
      const State state = unit(random) < failures ? State::Failed : State::Resident;
      residency.set(delta.requests[r].node, state);
    }
  }

  Counts countsOf(const FrontDelta& delta) const
  {
    Counts counts;
    for (const DrawItem& item : delta.draw)
    {
      EXPECT_TRUE(counts.emplace(item.node, item.pointCount).second) << "a node twice";
    }
    return counts;
  }

  void expectSound(const FrontDelta& delta) const
  {
    const Counts counts = countsOf(delta);
    std::uint64_t sum = 0;
    std::uint64_t slotSum = 0;
    for (const auto& [index, count] : counts)
    {
      sum += count;
      slotSum += gpuSlotsOf(count);
      ASSERT_GE(count, 1u);
      ASSERT_LE(count, tree->node(index).pointCount);
      ASSERT_EQ(residency.state(index), State::Resident);
      for (NodeIndex above = tree->node(index).parent; above != noNode;
           above = tree->node(above).parent)
      {
        expectAncestor(counts, above);
      }
    }
    ASSERT_EQ(sum, delta.pointsDrawn);
    ASSERT_EQ(slotSum, delta.slotsDrawn);
    if (limits.pointBudget > 0)
    {
      ASSERT_LE(sum, limits.pointBudget);
    }
    if (limits.sharedSlots.most > 0)
    {
      ASSERT_LE(slotSum, limits.sharedSlots.most);
    }
    ASSERT_LE(delta.requests.size(), limits.requestLimit);
    ASSERT_TRUE(std::isfinite(delta.errorPx));
    for (std::size_t i = 1; i < delta.draw.size(); ++i)
    {
      ASSERT_LE(delta.draw[i - 1].distance, delta.draw[i].distance);
    }
  }

  void expectAncestor(const Counts& counts, NodeIndex above) const
  {
    const auto drawn = counts.find(above);
    if (tree->refinement() == Refinement::Replace)
    {
      ASSERT_EQ(drawn, counts.end()) << "an ancestor of a node that is drawn: no cut";
    }
    else if (tree->node(above).pointCount > 0 && residency.state(above) != State::Failed)
    {
      ASSERT_NE(drawn, counts.end()) << "Add: the ancestors are drawn too";
      ASSERT_EQ(drawn->second, tree->node(above).pointCount) << "whole";
    }
  }

  std::shared_ptr<const HierarchyTable> tree;
  std::unique_ptr<DetailSelection> selection;
  std::mt19937 random;
  std::uint64_t points = 0;
  std::uint64_t slots = 0; ///< slots of GPU memory
  DemandCurve nobody; ///< shares
  ScriptedResidency residency;
  FrontLimits limits;
};

class DetailSelections : public ::testing::TestWithParam<Case>
{
};

} // namespace

INSTANTIATE_TEST_SUITE_P(Trees, DetailSelections, ::testing::ValuesIn(allCases()));

TEST_P(DetailSelections, ListsAreSoundForEveryViewThatCanBeSet)
{
  Trip trip(GetParam());
  for (int u = 0; u < 150; ++u)
  {
    const View view = anyView(trip.random);
    trip.limits.interacting = u % 4 == 0;
    for (int frame = 0; frame < 3; ++frame)
    {
      const FrontDelta& delta = trip.step(view);
      trip.expectSound(delta);
      ASSERT_FALSE(HasFatalFailure()) << "view " << u;
      trip.arrive(delta, 10, 0.02);
    }
  }
}

TEST_P(DetailSelections, EveryViewIsCompleteInTime)
{
  Trip trip(GetParam());
  for (int v = 0; v < 12; ++v)
  {
    const View view = anyView(trip.random);
    const FrontDelta* delta = &trip.step(view);
    for (int u = 0; !delta->complete; ++u)
    {
      ASSERT_LT(u, 2000) << "view " << v;
      trip.arrive(*delta, 40, 0.02);
      delta = &trip.step(view);
      trip.expectSound(*delta);
      ASSERT_FALSE(HasFatalFailure()) << "view " << v;
    }
  }
}

TEST_P(DetailSelections, WhatIsHeldFitsTheBudget)
{
  Trip trip(GetParam());
  trip.limits.heldPointBudget = trip.points / 4;
  trip.residency.otherwise = State::Resident;
  for (int v = 0; v < 20; ++v)
  {
    const View view = anyView(trip.random);
    const FrontDelta* delta = &trip.step(view);
    for (int u = 0; u < 2000 && !delta->complete; ++u)
    {
      delta = &trip.step(view);
    }
    ASSERT_TRUE(delta->complete);
    std::uint64_t held = 0;
    for (const DrawItem& item : delta->draw)
    {
      held += trip.tree->node(item.node).pointCount;
    }
    EXPECT_LE(held, trip.limits.heldPointBudget);
  }
}

TEST_P(DetailSelections, WhatWasDrawnStaysWhileTheRestLoads)
{
  Trip trip(GetParam());
  trip.limits.pointBudget = trip.limits.heldPointBudget = trip.limits.sharedSlots.most = 0;
  for (int v = 0; v < 6; ++v)
  {
    const View view = walkingView(60 * v);
    Counts before;
    const FrontDelta* delta = &trip.step(view);
    for (int u = 0; u < 300 && !delta->complete; ++u)
    {
      const Counts now = trip.countsOf(*delta);
      for (const auto& [node, count] : before)
      {
        const auto still = now.find(node);
        if (trip.tree->refinement() == Refinement::Add || trip.tree->node(node).leaf())
        {
          ASSERT_NE(still, now.end()) << "node " << node;
          ASSERT_GE(still->second, count);
        }
        else if (still == now.end())
        {
          for (std::uint8_t c = 0; c < trip.tree->node(node).childCount; ++c)
          {
            const NodeIndex child = trip.tree->node(node).firstChild + c;
            EXPECT_TRUE(trip.tree->node(child).pointCount == 0 ||
              trip.residency.state(child) == State::Resident)
              << "a parent goes when all of its children are there";
          }
        }
      }
      before = now;
      trip.arrive(*delta, 3, 0.0);
      delta = &trip.step(view);
    }
  }
}

TEST_P(DetailSelections, TwoRunsGiveTheSameLists)
{
  Trip one(GetParam());
  Trip two(GetParam());
  for (int u = 0; u < 100; ++u)
  {
    const FrontDelta& a = one.step(walkingView(u));
    const FrontDelta& b = two.step(walkingView(u));
    ASSERT_EQ(one.countsOf(a), two.countsOf(b));
    ASSERT_EQ(a.requests.size(), b.requests.size());
    for (std::size_t r = 0; r < a.requests.size(); ++r)
    {
      ASSERT_EQ(a.requests[r].node, b.requests[r].node);
    }
    one.arrive(a, 6, 0.05);
    two.arrive(b, 6, 0.05);
  }
}

TEST_P(DetailSelections, WhatIsDrawnOrAskedForIsNotUnderTheFront)
{
  Trip trip(GetParam());
  trip.limits.prefetchSiblings = false;
  for (int u = 0; u < 100; ++u)
  {
    const FrontDelta& delta = trip.step(walkingView(3 * u));
    for (const DrawItem& item : delta.draw)
    {
      ASSERT_EQ(trip.selection->distanceUnderFront(item.node), 0u);
    }
    for (const LoadRequest& request : delta.requests)
    {
      ASSERT_EQ(trip.selection->distanceUnderFront(request.node), 0u);
    }
    trip.arrive(delta, 6, 0.02);
  }
}

} // namespace pointfront
