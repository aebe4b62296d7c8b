// The splats of neighbours match: items made up here, without a front.

#include "pointfront/Plan/ClosingRadii.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

using namespace pointfront;

/// Autzen from 40 ft: a point of the root, among ground that is all there, was as large as what
/// closes the coarse nodes a mile away, or a few strays.
TEST(FramePlanner, WhatIsFarAwayMakesNoSplatsNearTheEyeLarge)
{
  std::vector<DrawBatch> batches(1);
  const auto add =
    [&](NodeIndex number, NodeIndex parent, float radius, std::uint32_t points, bool unfinished)
  {
    auto node = std::make_shared<NodeColumns>();
    node->node = number;
    node->parent = parent;
    PlanItem item;
    item.node = node;
    item.last = points;
    item.closingRadius = radius;
    item.unfinished = unfinished;
    batches[0].items.push_back(item);
  };
  add(0, noNode, 100.0f, 50, true);
  add(1, 0, 30.0f, 900, true); // refined by the next two
  add(3, 1, 1.0f, 990, false); // near: all there
  add(4, 1, 11.0f, 10, false); // some strays
  add(2, 0, 40.0f, 900, true); // far away: coarse
  matchNeighbours(batches);
  const std::vector<PlanItem>& items = batches[0].items;
  for (const std::size_t above : { std::size_t(0), std::size_t(1) })
  {
    EXPECT_TRUE(items[above].refined);
    EXPECT_FLOAT_EQ(items[above].closingRadius, 2.2f) << "twice the mean";
  }
  EXPECT_FLOAT_EQ(items[0].sparsestRadius, 40.0f);
  EXPECT_FLOAT_EQ(items[1].sparsestRadius, 11.0f);
  EXPECT_TRUE(items[0].unfinished) << "points are left out far away";
  EXPECT_FALSE(items[1].unfinished);
  EXPECT_FLOAT_EQ(items[4].closingRadius, 40.0f);

  batches[0].items.erase(batches[0].items.begin() + 2, batches[0].items.begin() + 4);
  for (PlanItem& item : batches[0].items)
  {
    item.refined = false;
  }
  batches[0].items[1].closingRadius = 30.0f;
  matchNeighbours(batches);
  EXPECT_FLOAT_EQ(batches[0].items[0].closingRadius, 30.0f) << "the nearer of the two";
}

/// Points of the node above close what grows. The nodes above that lie across the
/// whole view: with large splats they covered everything else.
TEST(FramePlanner, WhatGrowsIsClosedByItsParentAlone)
{
  std::vector<DrawBatch> batches(1);
  for (NodeIndex number = 0; number < 4; ++number)
  {
    auto node = std::make_shared<NodeColumns>();
    node->node = number;
    node->parent = number == 0 ? noNode : number - 1;
    PlanItem item;
    item.node = node;
    item.last = 1000;
    item.growingSpacingPx = number == 3 ? 8.0f : 0.0f;
    batches[0].items.push_back(item);
  }
  const auto spacings = [&]
  {
    matchNeighbours(batches);
    std::vector<float> all;
    for (const PlanItem& item : batches[0].items)
    {
      all.push_back(item.growingSpacingPx);
    }
    return all;
  };
  // The parent's points alone are a quarter of an octave farther apart than with those above.
  EXPECT_EQ(spacings(), (std::vector<float>{ 0.0f, 0.0f, 8.0f * 1.1892071f, 8.0f }));
  batches[0].items.erase(batches[0].items.begin() + 2, batches[0].items.end());
  batches[0].items[1].growingSpacingPx = 8.0f;
  EXPECT_EQ(spacings(), (std::vector<float>{ 8.0f, 8.0f })) << "nothing is above a root";
}

TEST(FramePlanner, AFewPointsOfAClassAmongManyOfAnotherHaveSplatsLikeTheirs)
{
  std::vector<DrawBatch> batches(2);
  const auto add =
    [&](std::uint16_t layer, NodeIndex number, float radius, std::uint32_t points, double x)
  {
    auto node = std::make_shared<NodeColumns>();
    node->node = number;
    node->centre = { x, 0.0, 0.0 };
    node->halfSize = { 50.0f, 50.0f, 5.0f };
    PlanItem item;
    item.node = node;
    item.last = points;
    item.closingRadius = radius;
    batches[layer].layer = layer;
    batches[layer].items.push_back(item);
  };
  add(0, 0, 0.5f, 10000, 0.0);
  add(0, 1, 0.4f, 10000, 100.0);
  add(1, 2, 6.0f, 100, 0.0); // among the first
  add(1, 3, 6.0f, 100, 5000.0); // alone
  matchNeighbours(batches);
  EXPECT_FLOAT_EQ(batches[0].items[0].closingRadius, 0.5f);
  EXPECT_FLOAT_EQ(batches[0].items[1].closingRadius, 0.4f);
  EXPECT_FLOAT_EQ(batches[1].items[0].closingRadius, 1.0f);
  EXPECT_FLOAT_EQ(batches[1].items[1].closingRadius, 6.0f);
}

/// Cells of trees halve, so a node often covers a quarter of another layer's, and rounding must not
/// decide.
TEST(FramePlanner, AQuarterOfAnotherLayersGroundCountsHoweverItIsRounded)
{
  for (const double rounding : { -1e-7, 0.0, 1e-7 })
  {
    std::vector<DrawBatch> batches(1);
    auto node = std::make_shared<NodeColumns>();
    node->node = 0;
    node->centre = { 50.0, 50.0, 5.0 };
    node->halfSize = { 50.0f, 50.0f, 5.0f };
    PlanItem sparse;
    sparse.node = node;
    sparse.last = 100;
    sparse.closingRadius = 6.0f;
    batches[0].items.push_back(sparse);
    NodeElsewhere dense;
    dense.node = 1;
    dense.layer = 1;
    dense.points = 10000;
    dense.closingRadius = 0.5f;
    dense.box = { { rounding, 0.0, 0.0 }, { 50.0, 50.0, 5.0 } };
    matchNeighbours(batches, { dense });
    EXPECT_FLOAT_EQ(batches[0].items[0].closingRadius, 1.0f) << rounding;
  }
}

/// A node's own points begin inside of the box of its row, which has the points below it, too.
/// While the node is being loaded its row says its place, so its columns must say the same place.
TEST(FramePlanner, ANodeInMemorySharesTheGroundThatItsRowDoes)
{
  const QuantisationGrid grid;
  Node row;
  row.centre = { 50.0, 50.0, 5.0 };
  row.halfSize = { 50.0f, 50.0f, 5.0f };
  row.layer = 1;
  auto columns = std::make_shared<NodeColumns>();
  columns->node = 1;
  columns->origin = grid.toGrid({ 5.0, 5.0, 5.0 }); // the lowest of its own points
  columns->describe(row);
  const auto sizeOf = [&](const std::shared_ptr<NodeColumns>& sparse, NodeElsewhere other)
  {
    std::vector<DrawBatch> batches(1);
    PlanItem item;
    item.node = sparse;
    item.last = 100;
    item.closingRadius = 6.0f;
    batches[0].layer = row.layer;
    batches[0].items.push_back(item);
    other.points = 10000;
    other.closingRadius = 0.5f;
    matchNeighbours(batches, { other });
    return batches[0].items[0].closingRadius;
  };
  NodeElsewhere beside;
  beside.node = 0;
  beside.box = { { 0.0, 0.0, 0.0 }, { 49.0, 50.0, 5.0 } }; // .245 of the row's ground
  EXPECT_FLOAT_EQ(sizeOf(columns, beside), 1.0f);
  beside.box = { { 55.0, 50.0, 0.0 }, { 105.0, 100.0, 5.0 } }; // .225 of it
  EXPECT_FLOAT_EQ(sizeOf(columns, beside), 6.0f);
}
