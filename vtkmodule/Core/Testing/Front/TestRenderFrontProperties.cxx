// Rules for every tree, camera path and order of arrival (fixed seeds).

#include "pointfront/Front/RenderFront.h"

#include "FrontScene.h"
#include "pointfront/Front/ScreenError.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace pointfront
{
namespace
{

using test::randomTree;
using test::ScriptedResidency;
using test::TreeShape;
using State = ResidencySnapshot::State;

struct Case
{
  std::uint32_t seed;
  Refinement refinement;
};

void PrintTo(const Case& c, std::ostream* out)
{
  *out << (c.refinement == Refinement::Add ? "add" : "replace") << " seed " << c.seed;
}

/// Somewhere round the tree, inside it now and then, looking somewhere near its middle.
View randomView(std::mt19937& random)
{
  std::uniform_real_distribution<double> place(-1500.0, 1500.0);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const glm::dvec3 eye(place(random), place(random), place(random));
  const glm::dvec3 focus(0.2 * place(random), 0.2 * place(random), 0.2 * place(random));
  const double angle = unit(random) < 0.1 ? 0.01 : 0.3 + 1.5 * unit(random);
  return View::perspective(eye, focus, { 0, 0, 1 }, angle, 0.01 + unit(random), 1e5, 800, 600);
}

/// A little further on the way.
View moved(const View& view, std::mt19937& random)
{
  std::uniform_real_distribution<double> step(-20.0, 20.0);
  const glm::dvec3 eye = view.position + glm::dvec3(step(random), step(random), step(random));
  const glm::dvec3 focus =
    view.position + 500.0 * view.direction + glm::dvec3(step(random), step(random), step(random));
  return View::perspective(eye, focus, { 0, 0, 1 }, 0.9, 0.1, 1e5, 800, 600);
}

using Counts = std::map<NodeIndex, std::uint32_t>;

Counts countsOf(const FrontDelta& delta)
{
  Counts counts;
  for (const DrawItem& item : delta.draw)
  {
    counts[item.node] += item.pointCount;
  }
  return counts;
}

class Flight
{
public:
  explicit Flight(const Case& c)
    : random(c.seed * 7919u)
    , tree(randomTree(shapeOf(c)))
    , front(tree)
    , view(randomView(random))
  {
    limits.targetErrorPx = 1.5;
    limits.movesPerFrame = 16;
    limits.requestLimit = 40;
    limits.pointBudget = c.seed % 3 == 0 ? 0 : tree->node(0).pointsBelow / (2 + c.seed % 5);
  }

  static TreeShape shapeOf(const Case& c)
  {
    TreeShape shape;
    shape.seed = c.seed;
    shape.roots = 1 + int(c.seed % 3);
    shape.childChance = 0.4 + 0.05 * (c.seed % 8);
    shape.refinement = c.refinement;
    return shape;
  }

  const FrontDelta& step() { return front.update(view, residency, limits); }

  /// Some of what was asked for comes, some of it cannot be read.
  void arrive(const FrontDelta& delta, std::size_t most, double failures)
  {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (std::size_t r = 0; r < delta.requests.size() && r < most; ++r)
    {
      const State state = unit(random) < failures ? State::Failed : State::Resident;
      residency.set(delta.requests[r].node, state);
    }
  }

  void expectSound(const FrontDelta& delta) const
  {
    const Counts counts = countsOf(delta);
    ASSERT_EQ(counts.size(), delta.draw.size()) << "no node twice";
    std::uint64_t points = 0;
    for (const auto& [index, count] : counts)
    {
      const Node& node = tree->node(index);
      points += count;
      EXPECT_GE(count, 1u);
      EXPECT_LE(count, node.pointCount);
      EXPECT_EQ(residency.state(index), State::Resident);
      EXPECT_EQ(sphereVisibility(view, node.centre, node.radius), Visibility::Inside);
      for (NodeIndex a = node.parent; a != noNode; a = tree->node(a).parent)
      {
        expectAncestor(counts, a);
      }
    }
    EXPECT_EQ(points, delta.pointsDrawn);
    if (limits.pointBudget > 0)
    {
      EXPECT_LE(points, limits.pointBudget);
    }
    EXPECT_LE(delta.moves, limits.movesPerFrame);
    EXPECT_LE(delta.requests.size(), limits.requestLimit);
    for (std::size_t r = 0; r < delta.requests.size(); ++r)
    {
      EXPECT_EQ(residency.state(delta.requests[r].node), State::Absent);
      EXPECT_GT(tree->node(delta.requests[r].node).pointCount, 0u);
    }
  }

  std::mt19937 random;
  std::shared_ptr<const HierarchyTable> tree;
  RenderFront front;
  ScriptedResidency residency;
  FrontLimits limits;
  View view;

private:
  void expectAncestor(const Counts& counts, NodeIndex ancestor) const
  {
    const auto drawn = counts.find(ancestor);
    if (tree->refinement() == Refinement::Replace)
    {
      EXPECT_EQ(drawn, counts.end()) << "an ancestor of a node that is drawn: no cut";
    }
    else if (tree->node(ancestor).pointCount > 0 && residency.state(ancestor) != State::Failed)
    {
      ASSERT_NE(drawn, counts.end()) << "Add: the ancestors are drawn too";
      EXPECT_EQ(drawn->second, tree->node(ancestor).pointCount) << "whole";
    }
  }
};

class RenderFrontProperties : public ::testing::TestWithParam<Case>
{
};

std::vector<Case> allCases()
{
  std::vector<Case> cases;
  for (std::uint32_t seed = 1; seed <= 6; ++seed)
  {
    cases.push_back({ seed, Refinement::Add });
    cases.push_back({ seed, Refinement::Replace });
  }
  return cases;
}

} // namespace

INSTANTIATE_TEST_SUITE_P(Trees, RenderFrontProperties, ::testing::ValuesIn(allCases()));

TEST_P(RenderFrontProperties, EveryListIsSoundOnEveryPath)
{
  Flight flight(GetParam());
  for (int u = 0; u < 300; ++u)
  {
    const bool jump = u % 60 == 59;
    flight.view = jump ? randomView(flight.random) : moved(flight.view, flight.random);
    flight.limits.interacting = u % 40 < 10;
    flight.limits.motionErrorPx = 4.0 + u % 7;
    const FrontDelta& delta = flight.step();
    flight.expectSound(delta);
    if (HasFatalFailure())
    {
      return;
    }
    flight.arrive(delta, 5, 0.02);
  }
}

TEST_P(RenderFrontProperties, AStillViewIsCompleteInTime)
{
  Flight flight(GetParam());
  for (int view = 0; view < 4; ++view)
  {
    flight.view = randomView(flight.random);
    const FrontDelta* delta = &flight.step();
    int updates = 0;
    while (!delta->complete)
    {
      ASSERT_LT(++updates, 3000) << "threshold " << delta->thresholdPx;
      flight.arrive(*delta, 20, 0.02);
      delta = &flight.step();
      flight.expectSound(*delta);
    }
    EXPECT_TRUE(delta->thresholdPx == 1.5 || delta->limitedByBudget);
    // At rest means at rest.
    const Counts before = countsOf(*delta);
    for (int u = 0; u < 5; ++u)
    {
      delta = &flight.step();
      EXPECT_TRUE(delta->complete);
      EXPECT_EQ(countsOf(*delta), before);
    }
  }
}

/// Points that show a node's region: its own or those of what replaced it.
std::uint64_t shown(const Counts& counts, const Hierarchy& tree, NodeIndex node)
{
  std::uint64_t sum = 0;
  const auto own = counts.find(node);
  sum += own != counts.end() ? own->second : 0;
  for (std::uint8_t c = 0; c < tree.node(node).childCount; ++c)
  {
    sum += shown(counts, tree, tree.node(node).firstChild + c);
  }
  return sum;
}

TEST_P(RenderFrontProperties, DetailDoesNotVanishWhileItsReplacementLoads)
{
  Flight flight(GetParam());
  flight.limits.pointBudget = 0;
  for (int view = 0; view < 3; ++view)
  {
    flight.view = randomView(flight.random);
    Counts before;
    const FrontDelta* delta = &flight.step();
    for (int u = 0; u < 200 && !delta->complete; ++u)
    {
      const Counts now = countsOf(*delta);
      for (const auto& [node, count] : before)
      {
        if (flight.tree->refinement() == Refinement::Add)
        {
          const auto found = now.find(node);
          ASSERT_NE(found, now.end()) << "node " << node << " update " << u;
          EXPECT_GE(found->second, count);
        }
        else if (flight.tree->node(node).childCount == 0)
        {
          EXPECT_EQ(now.count(node), 1u) << "a leaf has no replacement";
        }
        else if (now.count(node) == 0)
        {
          // Replaced by whole groups: every child in sight that has points shows some.
          for (std::uint8_t c = 0; c < flight.tree->node(node).childCount; ++c)
          {
            const NodeIndex child = flight.tree->node(node).firstChild + c;
            const Node& entry = flight.tree->node(child);
            if (entry.pointCount > 0 &&
              sphereVisibility(flight.view, entry.centre, entry.radius) == Visibility::Inside)
            {
              EXPECT_GT(shown(now, *flight.tree, child), 0u);
            }
          }
        }
      }
      before = now;
      flight.arrive(*delta, 3, 0.0);
      delta = &flight.step();
    }
  }
}

TEST_P(RenderFrontProperties, TheSettledListDoesNotDependOnTheOrderOfArrival)
{
  Flight one(GetParam());
  Flight two(GetParam());
  two.view = one.view = randomView(one.random);
  two.residency.otherwise = State::Resident;
  const FrontDelta* first = &one.step();
  for (int u = 0; u < 3000 && !first->complete; ++u)
  {
    one.arrive(*first, 1 + u % 30, 0.0);
    first = &one.step();
  }
  const FrontDelta* second = &two.step();
  for (int u = 0; u < 3000 && !second->complete; ++u)
  {
    second = &two.step();
  }
  ASSERT_TRUE(first->complete);
  ASSERT_TRUE(second->complete);
  EXPECT_EQ(first->thresholdPx, second->thresholdPx);
  EXPECT_EQ(countsOf(*first), countsOf(*second));
}

TEST_P(RenderFrontProperties, TwoRunsGiveTheSameLists)
{
  Flight one(GetParam());
  Flight two(GetParam());
  for (int u = 0; u < 120; ++u)
  {
    one.view = moved(one.view, one.random);
    two.view = moved(two.view, two.random);
    const FrontDelta& a = one.step();
    const FrontDelta& b = two.step();
    ASSERT_EQ(a.draw.size(), b.draw.size());
    for (std::size_t i = 0; i < a.draw.size(); ++i)
    {
      ASSERT_EQ(a.draw[i].node, b.draw[i].node);
      ASSERT_EQ(a.draw[i].pointCount, b.draw[i].pointCount);
    }
    ASSERT_EQ(a.requests.size(), b.requests.size());
    for (std::size_t i = 0; i < a.requests.size(); ++i)
    {
      ASSERT_EQ(a.requests[i].node, b.requests[i].node);
    }
    one.arrive(a, 6, 0.05);
    two.arrive(b, 6, 0.05);
  }
}

TEST_P(RenderFrontProperties, WhatIsDrawnOrAskedForIsNeverUnderTheFront)
{
  Flight flight(GetParam());
  flight.limits.prefetchSiblings = false;
  for (int u = 0; u < 150; ++u)
  {
    flight.view = moved(flight.view, flight.random);
    const FrontDelta& delta = flight.step();
    for (const DrawItem& item : delta.draw)
    {
      EXPECT_EQ(flight.front.distanceUnderFront(item.node), 0u);
    }
    for (const LoadRequest& request : delta.requests)
    {
      EXPECT_EQ(flight.front.distanceUnderFront(request.node), 0u);
    }
    flight.arrive(delta, 6, 0.02);
  }
}

} // namespace pointfront
