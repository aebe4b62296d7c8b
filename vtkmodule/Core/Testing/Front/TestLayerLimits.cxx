// LAYERS-11: threshold, share and switch of each layer, the same for every selection of detail.
//
//   layer 0 (ground)  o--+--o    layer 1 (buildings)  o--+--o   the same tree twice, in the same
//                        +--o                            +--o   place
//
// so whatever differs between the two layers on screen comes from their limits.

#include "pointfront/Detail/ViewDetail.h"
#include "pointfront/Front/RenderFront.h"
#include "pointfront/Front/ViewMargin.h"

#include "FrontScene.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace pointfront
{
namespace
{

using test::ScriptedResidency;
using State = ResidencySnapshot::State;

/// `count` copies of one random tree, breadth first, one layer each.
std::shared_ptr<const HierarchyTable> layered(std::uint16_t count, Refinement refinement)
{
  test::TreeShape shape;
  shape.refinement = refinement;
  const auto one = test::randomTree(shape);
  std::vector<Node> nodes;
  std::vector<NodeIndex> roots;
  for (std::uint16_t layer = 0; layer < count; ++layer)
  {
    const auto first = static_cast<NodeIndex>(nodes.size());
    roots.push_back(first);
    for (NodeIndex n = 0; n < one->nodeCount(); ++n)
    {
      Node node = one->node(n);
      node.layer = layer;
      node.parent += node.parent != noNode ? first : 0;
      node.firstChild += node.firstChild != noNode ? first : 0;
      nodes.push_back(node);
    }
  }
  return std::make_shared<HierarchyTable>(std::move(nodes), std::move(roots), refinement);
}

View lookingFrom(double x)
{
  return View::perspective({ x, 300, 200 }, { 0, 0, 0 }, { 0, 0, 1 }, 0.9, 0.1, 1e5, 800, 600);
}

enum class Way
{
  Front,
  ViewDetail
};

std::unique_ptr<DetailSelection> selectionOf(Way way, std::shared_ptr<const Hierarchy> tree)
{
  if (way == Way::Front)
  {
    return std::make_unique<RenderFront>(std::move(tree));
  }
  return std::make_unique<ViewDetail>(std::move(tree));
}

struct Layers
{
  explicit Layers(Way way, std::uint16_t count = 2, Refinement refinement = Refinement::Add)
    : tree(layered(count, refinement))
    , selection(selectionOf(way, tree))
  {
    residency.otherwise = State::Resident;
    limits.targetErrorPx = 2.0;
    limits.overviewPoints = 3000;
    limits.layers.resize(count);
  }

  const FrontDelta& settle()
  {
    const FrontDelta* delta = &selection->update(view, residency, limits);
    for (int u = 0; u < 2000 && !delta->complete; ++u)
    {
      residency.load(delta->requests);
      delta = &selection->update(view, residency, limits);
    }
    EXPECT_TRUE(delta->complete);
    return *delta;
  }
  std::uint64_t drawn(std::uint16_t layer) const
  {
    std::uint64_t sum = 0;
    for (const DrawItem& item : delta().draw)
    {
      sum += tree->node(item.node).layer == layer ? item.pointCount : 0;
    }
    return sum;
  }
  const FrontDelta& delta() const { return *last; }
  void draw() { last = &settle(); }

  std::shared_ptr<const HierarchyTable> tree;
  std::unique_ptr<DetailSelection> selection;
  ScriptedResidency residency;
  FrontLimits limits;
  View view = lookingFrom(1000.0);
  const FrontDelta* last = nullptr;
};

class LayerLimitsOf : public ::testing::TestWithParam<Way>
{
};

} // namespace

INSTANTIATE_TEST_SUITE_P(Selections, LayerLimitsOf, ::testing::Values(Way::Front, Way::ViewDetail),
  [](const auto& way) { return way.param == Way::Front ? "Front" : "ViewDetail"; });

TEST_P(LayerLimitsOf, AFactorMakesALayerCoarserByThatMuch)
{
  Layers l(GetParam());
  l.draw();
  const std::uint64_t whole = l.drawn(0);
  EXPECT_EQ(l.drawn(1), whole);
  l.limits.layers[1].errorFactor = 4.0;
  l.draw();
  EXPECT_EQ(l.drawn(0), whole) << "the other layer is as it was";
  EXPECT_LT(l.drawn(1), whole / 2);
  // As a view with four times the error has it.
  const std::uint64_t coarse = l.drawn(1);
  Layers reference(GetParam());
  reference.limits.targetErrorPx = 8.0;
  reference.draw();
  EXPECT_EQ(coarse, reference.drawn(1));
  EXPECT_LE(l.delta().errorPx, reference.delta().errorPx / 4.0 * 1.5) << "in its own measure";
  for (const DrawItem& item : l.delta().draw)
  {
    const NodeIndex twin = item.node % (l.tree->nodeCount() / 2);
    for (const DrawItem& other : l.delta().draw)
    {
      if (other.node == twin)
      {
        EXPECT_FLOAT_EQ(item.errorPx, other.errorPx) << "pixels, whatever the factor";
      }
    }
  }
}

TEST_P(LayerLimitsOf, AHiddenLayerIsNeitherDrawnNorAskedForNorKept)
{
  for (const Refinement refinement : { Refinement::Add, Refinement::Replace })
  {
    Layers l(GetParam(), 2, refinement);
    l.residency.otherwise = State::Absent;
    l.draw();
    EXPECT_GT(l.drawn(1), 0u);
    l.limits.layers[1].visible = false;
    l.view = lookingFrom(700.0);
    const FrontDelta* delta = &l.selection->update(l.view, l.residency, l.limits);
    EXPECT_FALSE(delta->requests.empty());
    for (const LoadRequest& request : delta->requests)
    {
      EXPECT_EQ(l.tree->node(request.node).layer, 0u);
    }
    l.draw();
    EXPECT_EQ(l.drawn(1), 0u);
    for (NodeIndex n = l.tree->nodeCount() / 2; n < l.tree->nodeCount(); ++n)
    {
      EXPECT_GT(l.selection->distanceUnderFront(n), 0u) << "its memory is free for others";
    }
    EXPECT_EQ(l.selection->distanceUnderFront(0), 0u);
    l.limits.layers[1].visible = true;
    l.draw();
    EXPECT_GT(l.drawn(1), 0u);
  }
}

TEST(LayerLimits, TheMarginAheadOfTheMotionHasLayersToo)
{
  Layers l(Way::Front);
  ViewMargin margin(l.tree);
  ScriptedResidency nothing;
  l.limits.layers[0].visible = false;
  margin.ahead(lookingFrom(1000.0), 4.0, nothing, 8.0, 500, l.limits.layers);
  const auto& ahead = margin.ahead(lookingFrom(990.0), 4.0, nothing, 8.0, 500, l.limits.layers);
  EXPECT_FALSE(ahead.empty());
  for (const LoadRequest& request : ahead)
  {
    EXPECT_EQ(l.tree->node(request.node).layer, 1u);
  }
}

TEST_P(LayerLimitsOf, AShareIsHeldAgainstLayersWithLargerErrors)
{
  Layers l(GetParam());
  l.limits.targetErrorPx = 1.0; // the share is not more than it could use
  l.limits.layers[1].errorFactor = 5.0; // its errors count little beside those of layer 0
  l.limits.pointBudget = 20000;
  l.draw();
  const std::uint64_t without = l.drawn(1);
  EXPECT_LT(without, 2000u);
  EXPECT_TRUE(l.delta().limitedByBudget);
  l.limits.layers[1].share = 0.25;
  l.draw();
  EXPECT_GT(l.drawn(1), 4000u);
  EXPECT_LE(l.drawn(0) + l.drawn(1), 20000u);
  EXPECT_GT(l.drawn(0) + l.drawn(1), 17000u) << "and nothing lies idle";
}

TEST_P(LayerLimitsOf, WhatAShareDoesNotUseIsLentAndTakenBack)
{
  Layers l(GetParam());
  l.limits.pointBudget = 20000;
  l.limits.layers[0].share = 0.5;
  l.limits.layers[1].share = 0.5;
  l.draw();
  EXPECT_GT(l.drawn(0), 8000u);
  EXPECT_EQ(l.drawn(0), l.drawn(1));
  // Lent: layer 1 needs little, or is hidden.
  l.limits.layers[1].errorFactor = 1000.0;
  l.draw();
  EXPECT_LT(l.drawn(1), 5000u);
  EXPECT_GT(l.drawn(0), 14000u);
  EXPECT_LE(l.drawn(0) + l.drawn(1), 20000u);
  l.limits.layers[1].visible = false;
  l.draw();
  EXPECT_EQ(l.drawn(1), 0u);
  EXPECT_GT(l.drawn(0), 17000u);
  // Taken back.
  l.limits.layers[1] = { true, 1.0, 0.5 };
  l.draw();
  EXPECT_GT(l.drawn(0), 8000u);
  EXPECT_EQ(l.drawn(0), l.drawn(1));
}

TEST_P(LayerLimitsOf, SharesOfMoreThanAllAreCutDown)
{
  Layers l(GetParam(), 3);
  l.limits.pointBudget = 30000;
  for (LayerLimits& layer : l.limits.layers)
  {
    layer.share = 0.9;
  }
  l.draw();
  EXPECT_GT(l.drawn(0), 8000u);
  EXPECT_EQ(l.drawn(0), l.drawn(1));
  EXPECT_EQ(l.drawn(1), l.drawn(2));
}

/// A node takes whole slots of GPU memory. Where there are fewer than layers, those layers that get
/// one show as much as if all had one, and the largest get them.
TEST_P(LayerLimitsOf, WhereNotAllHaveASlotThoseThatDoAreAsFineAsWithSlotsForAll)
{
  const DemandCurve nobody;
  for (const Refinement refinement : { Refinement::Add, Refinement::Replace })
  {
    for (const double share : { 0.0, 0.2 })
    {
      SCOPED_TRACE(testing::Message() << share << ' ' << int(refinement));
      Layers all(GetParam(), 5, refinement);
      std::vector<Node> nodes;
      for (NodeIndex n = 0; n < all.tree->nodeCount(); ++n)
      {
        nodes.push_back(all.tree->node(n));
      }
      Node& small = nodes.front(); // a leaf of five points
      small.pointsBelow = small.pointCount = 5;
      small.childCount = 0;
      small.firstChild = noNode;
      const auto tree = std::make_shared<HierarchyTable>(nodes, all.tree->roots(), refinement);
      const auto drawWith = [&](Layers& l, std::uint64_t slots)
      {
        l.tree = tree;
        l.selection = selectionOf(GetParam(), tree);
        l.limits.sharedSlots = { slots, &nobody };
        for (LayerLimits& layer : l.limits.layers)
        {
          layer.share = share;
        }
        l.draw();
      };
      drawWith(all, 5);
      EXPECT_EQ(all.delta().slotsDrawn, 5u);
      EXPECT_GT(all.drawn(1), 100u);
      EXPECT_TRUE(all.delta().layersLeftOut.empty());
      for (const std::uint64_t slots : { 1, 3 })
      {
        Layers few(GetParam(), 5, refinement);
        drawWith(few, slots);
        EXPECT_EQ(few.delta().slotsDrawn, slots);
        EXPECT_EQ(few.delta().pointsDrawn, slots * all.drawn(1));
        EXPECT_EQ(few.drawn(0), 0u) << "it has least";
        EXPECT_TRUE(few.delta().limitedByGpu);
        EXPECT_FALSE(few.delta().limitedByBudget);
        EXPECT_GT(few.delta().errorPx, 10.0 * all.delta().errorPx) << "as if it showed one point";
        EXPECT_EQ(few.delta().layersLeftOut.size(), 5 - slots);
        EXPECT_EQ(few.delta().layersLeftOut.front(), 0u);
      }
    }
  }
}

/// Random factors, shares, switches, budgets and views: never beyond the budget, a layer that is
/// left finer than its share allows never costs another one that has less than its own.
TEST_P(LayerLimitsOf, SharesAndBudgetsHoldOnEveryPath)
{
  for (std::uint32_t seed = 1; seed <= 8; ++seed)
  {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const auto below = [&](double end)
    { return std::uniform_real_distribution<double>(0.0, end)(random); };
    Layers l(GetParam(), 4, seed % 2 == 0 ? Refinement::Add : Refinement::Replace);
    for (int change = 0; change < 6; ++change)
    {
      for (LayerLimits& layer : l.limits.layers)
      {
        layer = { below(1.0) < 0.8, 0.5 + below(4.0), below(1.0) < 0.3 ? 0.0 : below(0.4) };
      }
      l.limits.pointBudget = 5000 + std::uint64_t(below(40000.0));
      l.limits.heldPointBudget = below(1.0) < 0.5 ? 0 : 40000 + std::uint64_t(below(80000.0));
      l.view = lookingFrom(600.0 + below(1500.0));
      for (int u = 0; u < 30; ++u)
      {
        l.last = &l.selection->update(l.view, l.residency, l.limits);
        ASSERT_LE(l.delta().pointsDrawn, l.limits.pointBudget);
      }
      l.draw();
      std::map<NodeIndex, std::uint32_t> before;
      for (const DrawItem& item : l.delta().draw)
      {
        EXPECT_TRUE(l.limits.layers[l.tree->node(item.node).layer].visible);
        before[item.node] = item.pointCount;
      }
      // Another selection that comes from elsewhere settles the same.
      Layers other(GetParam(), 4, l.tree->refinement());
      other.limits = l.limits;
      other.view = lookingFrom(400.0);
      other.draw();
      other.view = l.view;
      other.draw();
      for (const DrawItem& item : other.delta().draw)
      {
        EXPECT_EQ(before[item.node], item.pointCount) << "node " << item.node;
      }
      EXPECT_EQ(other.delta().draw.size(), before.size());
    }
  }
}

} // namespace pointfront
