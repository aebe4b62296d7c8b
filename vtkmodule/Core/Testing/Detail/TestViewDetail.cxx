#include "pointfront/Detail/ViewDetail.h"

#include "FrontScene.h"
#include "pointfront/Detail/DetailLevel.h"
#include "pointfront/Front/OverviewCount.h"
#include "pointfront/Front/ScreenError.h"
#include "TerrainPages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace pointfront
{
namespace
{

using test::ScriptedResidency;
using test::Terrain;
using State = ResidencySnapshot::State;

constexpr double size = Terrain::sizeMetres;

std::shared_ptr<const Hierarchy> terrainInMemory(int levels)
{
  const Terrain terrain(levels);
  std::vector<Node> nodes(terrain.nodeCount());
  for (NodeIndex i = 0; i < terrain.nodeCount(); ++i)
  {
    nodes[i] = terrain.row(i);
  }
  return std::make_shared<HierarchyTable>(nodes, std::vector<NodeIndex>{ 0 }, Refinement::Add);
}

/// Straight down on the middle from a height, in terrain sizes; 53 degrees, 1000 x 1000 pixels.
View fromAbove(double height, double x = 0.5)
{
  return View::perspective({ x * size, 0.5 * size, height * size }, { x * size, 0.5 * size, 0.0 },
    { 0, 1, 0 }, 2.0 * std::atan(0.5), 1.0, 1e7, 1000, 1000);
}

FrontLimits overviewOf(std::uint64_t points)
{
  FrontLimits limits;
  limits.overviewPoints = points;
  return limits;
}

std::uint64_t pointsDrawn(const FrontDelta& delta, std::uint32_t& nodes)
{
  nodes = static_cast<std::uint32_t>(delta.draw.size());
  return delta.pointsDrawn;
}

} // namespace

TEST(DetailLevel, IsThePapersFormulas)
{
  EXPECT_DOUBLE_EQ(overviewLevel(1u << 21), 21.0);
  // Treelevel_Dataset = log2(N_Dataset / N_Total * N_Overview): shares in proportion to the sizes.
  EXPECT_EQ(overviewShare(2000000, 100, 100), 100u) << "not more than there is";
  EXPECT_EQ(overviewShare(2000000, 30000000, 120000000), 500000u);
  EXPECT_EQ(overviewShare(2000000, 1, 1000000000000), 1u) << "every data set shows something";
  EXPECT_EQ(overviewShare(8000000, 90000000, 120000000), 6000000u);
  // Treelevel_Details = Treelevel_Overview + log2(N_IP / N_OPIF).
  EXPECT_DOUBLE_EQ(detailLevel(20.0, 4000.0, 1000.0, 40.0), 22.0);
  EXPECT_DOUBLE_EQ(detailLevel(20.0, 4000.0, 8000.0, 40.0), 20.0) << "the overview is enough";
  EXPECT_DOUBLE_EQ(detailLevel(20.0, 4000.0, 0.0, 33.0), 33.0) << "none in sight: the deepest";
  EXPECT_DOUBLE_EQ(detailLevel(20.0, 4e9, 1.0, 33.0), 33.0);
}

TEST(DetailLevel, SlicesOfTheFrustumDouble)
{
  EXPECT_EQ(frustumSlice(0.0, 2.0), 0);
  EXPECT_EQ(frustumSlice(3.9, 2.0), 0);
  EXPECT_EQ(frustumSlice(4.1, 2.0), 1);
  EXPECT_EQ(frustumSlice(2050.0, 2.0), 10);
}

TEST(OverviewCount, CountsWhatLiesInTheFrustum)
{
  const auto table = terrainInMemory(7);
  const double all = static_cast<double>(table->node(0).pointsBelow);
  const double shown = 1e6 / all;
  // From 2 sizes up the frustum is 2 wide: everything; from 0.5 up half the size: a quarter.
  EXPECT_NEAR(overviewInFrustum(*table, fromAbove(2.0), shown), 1e6, 1e3);
  EXPECT_NEAR(overviewInFrustum(*table, fromAbove(0.5), shown), 0.25e6, 0.02e6);
  EXPECT_NEAR(overviewInFrustum(*table, fromAbove(0.05), shown), 0.0025e6, 0.0005e6);
  EXPECT_EQ(overviewInFrustum(*table, fromAbove(0.5, 9.0), shown), 0.0);
  LayerLimits hidden;
  hidden.visible = false;
  EXPECT_EQ(overviewInFrustum(*table, fromAbove(2.0), shown, { hidden }), 0.0);
}

TEST(OverviewCount, MeasuresBoxes)
{
  const View view = fromAbove(1.0); // sees 0 to 1 of the ground
  const auto at = [](double low, double high) {
    return Bounds{ { low * size, 0.4 * size, 0 }, { high * size, 0.6 * size, 0 } };
  };
  EXPECT_DOUBLE_EQ(shareInFrustum(at(0.2, 0.4), view), 1.0);
  EXPECT_DOUBLE_EQ(shareInFrustum(at(-0.5, 0.5), view), 0.5);
  EXPECT_DOUBLE_EQ(shareInFrustum(at(2.0, 3.0), view), 0.0);
}

// The frustum has about as many points as the image has pixels, from near as from far.
TEST(ViewDetail, FillsTheImage)
{
  const auto table = terrainInMemory(8);
  ScriptedResidency residency;
  residency.otherwise = State::Resident;
  for (const double height : { 1.0, 0.5, 0.2, 0.1 })
  {
    ViewDetail detail(table);
    const FrontDelta& delta = detail.update(fromAbove(height), residency, overviewOf(100000));
    EXPECT_TRUE(delta.complete);
    std::uint32_t nodes = 0;
    // Whole nodes at the frustum's edge are drawn: up to half as much again.
    EXPECT_GT(pointsDrawn(delta, nodes), 0.9e6) << height;
    EXPECT_LT(pointsDrawn(delta, nodes), 2.0e6) << height;
    EXPECT_EQ(delta.thresholdPx, 1.0);
  }
  ViewDetail coarse(table);
  FrontLimits limits = overviewOf(100000);
  limits.targetErrorPx = 2.0;
  const double level = [&]
  {
    ViewDetail fine(table);
    fine.update(fromAbove(0.5), residency, overviewOf(100000));
    return fine.level();
  }();
  coarse.update(fromAbove(0.5), residency, limits);
  EXPECT_NEAR(coarse.level(), level - 2.0, 1e-9) << "twice the error: a quarter of the points";
}

TEST(ViewDetail, EverySubtreeShowsTheSameShare)
{
  const auto table = terrainInMemory(6);
  ScriptedResidency residency;
  residency.otherwise = State::Resident;
  ViewDetail detail(table);
  const FrontDelta& delta = detail.update(fromAbove(2.0), residency, overviewOf(100000));
  std::map<NodeIndex, std::uint64_t> ofQuarter;
  for (const DrawItem& item : delta.draw)
  {
    NodeIndex above = item.node;
    while (above > 4)
    {
      above = table->node(above).parent;
    }
    ofQuarter[above] += item.pointCount;
  }
  ASSERT_EQ(ofQuarter.size(), 5u);
  for (NodeIndex quarter = 2; quarter <= 4; ++quarter)
  {
    EXPECT_NEAR(double(ofQuarter[quarter]), double(ofQuarter[1]), 100.0);
  }
}

TEST(ViewDetail, TheOverviewIsKeptForEveryViewAndComesFirst)
{
  const auto table = terrainInMemory(6);
  ScriptedResidency residency;
  ViewDetail detail(table);
  FrontLimits limits = overviewOf(200000);
  limits.requestLimit = 1000;
  // Low over one corner: nearly all of the overview is out of sight.
  const View view = fromAbove(0.02, 0.05);
  const FrontDelta* delta = &detail.update(view, residency, limits);
  EXPECT_TRUE(delta->draw.empty());
  ASSERT_GT(delta->requests.size(), 21u);
  for (NodeIndex r = 0; r < 21; ++r) // three levels: 210,000 points
  {
    EXPECT_LT(delta->requests[r].node, 21u);
  }
  for (int u = 0; u < 100 && !delta->complete; ++u)
  {
    residency.load(delta->requests, 5);
    delta = &detail.update(view, residency, limits);
  }
  ASSERT_TRUE(delta->complete);
  for (NodeIndex node = 0; node < 21; ++node)
  {
    EXPECT_EQ(detail.distanceUnderFront(node), 0u) << "never released";
  }
  EXPECT_GT(detail.distanceUnderFront(table->nodeCount() - 1), 0u);
  // The nodes that another view sees at once.
  delta = &detail.update(fromAbove(1.0, 0.9), residency, limits);
  EXPECT_GT(delta->pointsDrawn, 50000u);
}

TEST(ViewDetail, AsksNearToFar)
{
  const auto table = terrainInMemory(8);
  ScriptedResidency residency;
  ViewDetail detail(table);
  FrontLimits limits = overviewOf(10000);
  limits.requestLimit = 100000;
  const View view = View::perspective({ 0.1 * size, 0.5 * size, 0.01 * size },
    { 0.2 * size, 0.5 * size, 0 }, { 0, 0, 1 }, 0.8, 1.0, 1e7, 1000, 1000);
  const FrontDelta& delta = detail.update(view, residency, limits);
  ASSERT_GT(delta.requests.size(), 20u);
  int slice = 0;
  for (std::size_t r = 1; r < delta.requests.size(); ++r)
  {
    const double distance = distanceToNode(view, table->node(delta.requests[r].node));
    EXPECT_GE(frustumSlice(distance, view.nearDistance), slice);
    slice = frustumSlice(distance, view.nearDistance);
  }
  EXPECT_GT(slice, 3);
}

TEST(ViewDetail, ASubtreeOnOnePixelIsNotDescended)
{
  const auto table = terrainInMemory(8);
  ScriptedResidency residency;
  residency.otherwise = State::Resident;
  ViewDetail detail(table);
  FrontLimits limits = overviewOf(1);
  limits.targetErrorPx = 0.01; // everything, by the level alone
  const View view = fromAbove(2.0);
  const FrontDelta& delta = detail.update(view, residency, limits);
  for (const DrawItem& item : delta.draw)
  {
    const Node node = table->node(item.node);
    EXPECT_GE(projectedSpacing(view, 2.0 * node.radius, item.distance), 1.0);
  }
  EXPECT_GT(delta.draw.size(), 5000u);
  const FrontDelta& far = detail.update(fromAbove(1000.0), residency, limits);
  EXPECT_LT(far.draw.size(), 30u) << "the terrain has one and a half pixels";
}

TEST(ViewDetail, BudgetsLowerTheLevel)
{
  const auto table = terrainInMemory(8);
  ScriptedResidency residency;
  residency.otherwise = State::Resident;
  ViewDetail detail(table);
  FrontLimits limits = overviewOf(20000);
  const double free = [&]
  {
    detail.update(fromAbove(0.3), residency, limits);
    return detail.level();
  }();
  limits.pointBudget = 200000;
  const FrontDelta* delta = &detail.update(fromAbove(0.3), residency, limits);
  EXPECT_LE(delta->pointsDrawn, 200000u);
  EXPECT_GT(delta->pointsDrawn, 150000u) << "an eighth of a level";
  EXPECT_TRUE(delta->limitedByBudget);
  EXPECT_LT(detail.level(), free);
  EXPECT_GT(delta->thresholdPx, 1.5);
  EXPECT_TRUE(delta->complete);
  limits.pointBudget = 0;
  limits.heldPointBudget = 300000;
  delta = &detail.update(fromAbove(0.3), residency, limits);
  EXPECT_TRUE(delta->limitedByMemory);
  EXPECT_FALSE(delta->limitedByBudget);
  limits.heldPointBudget = 15000; // not even the overview
  delta = &detail.update(fromAbove(0.3), residency, limits);
  EXPECT_GT(delta->pointsDrawn, 0u);
  EXPECT_LE(delta->pointsDrawn, 15000u);
}

TEST(ViewDetail, HiddenLayersAskForNothing)
{
  test::TreeShape shape;
  shape.roots = 2;
  const auto random = test::randomTree(shape);
  std::vector<Node> nodes;
  for (NodeIndex i = 0; i < random->nodeCount(); ++i)
  {
    nodes.push_back(random->node(i));
    nodes[i].layer = i == 0 ? 0 : nodes[i].parent == noNode ? 1 : nodes[nodes[i].parent].layer;
  }
  const auto tree = std::make_shared<HierarchyTable>(nodes, random->roots(), Refinement::Add);
  ViewDetail detail(tree);
  ScriptedResidency residency;
  FrontLimits limits = overviewOf(1000);
  limits.layers.resize(1);
  limits.layers[0].visible = false;
  const View view =
    View::perspective({ 2000, 0, 300 }, { 0, 0, 0 }, { 0, 0, 1 }, 0.9, 0.1, 1e5, 800, 600);
  const FrontDelta& delta = detail.update(view, residency, limits);
  ASSERT_FALSE(delta.requests.empty());
  for (const LoadRequest& request : delta.requests)
  {
    EXPECT_EQ(tree->node(request.node).layer, 1);
  }
}

TEST(ViewDetail, NothingChangedEndsAtOnce)
{
  const auto table = terrainInMemory(6);
  ScriptedResidency residency;
  residency.otherwise = State::Resident;
  residency.tellRevisions();
  ViewDetail detail(table);
  detail.update(fromAbove(0.3), residency, overviewOf(10000));
  const std::uint64_t asked = residency.asked;
  detail.update(fromAbove(0.3), residency, overviewOf(10000));
  EXPECT_EQ(residency.asked, asked);
  detail.update(fromAbove(0.31), residency, overviewOf(10000));
  EXPECT_GT(residency.asked, asked);
}

TEST(ViewDetail, WaitsForRowsOfAPagedTable)
{
  ScriptedResidency residency;
  residency.otherwise = State::Resident;
  const auto listOf = [&](const std::shared_ptr<const Hierarchy>& table)
  {
    ViewDetail detail(table);
    for (int u = 0; u < 1000; ++u)
    {
      const std::uint64_t seen = table->arrivals();
      const FrontDelta& delta = detail.update(fromAbove(0.1), residency, overviewOf(100000));
      if (delta.complete)
      {
        std::map<NodeIndex, std::uint32_t> counts;
        for (const DrawItem& item : delta.draw)
        {
          counts[item.node] = item.pointCount;
        }
        return counts;
      }
      table->waitForArrival(seen);
    }
    ADD_FAILURE() << "never complete";
    return std::map<NodeIndex, std::uint32_t>();
  };
  EXPECT_EQ(listOf(test::terrainTable(8)), listOf(terrainInMemory(8)));
}

} // namespace pointfront
