#include "pointfront/InPlace/RunFinder.h"

#include "MadeUpRecords.h"

#include <gtest/gtest.h>

namespace pointfront
{
namespace
{
constexpr std::uint32_t leafPoints = 300;

CellGrid counted(const MadeUpRecords& records)
{
  CellGrid cells(records.box(), CellGrid::topBitsFor(records.view().count));
  do
  {
    cells.count(records.view(), 0, records.view().count);
  } while (cells.refine(leafPoints));
  return cells;
}

/// Runs by a test of every single point.
std::vector<LeafRun> bruteForce(const GridRecords& records, const CellGrid& cells)
{
  std::vector<LeafRun> runs;
  for (std::uint64_t i = 0; i < records.count; ++i)
  {
    const NodeIndex leaf = cells.at(records.position(i));
    if (runs.empty() || runs.back().leaf != leaf)
    {
      runs.push_back({ leaf, i, 0, {} });
    }
    ++runs.back().count;
    runs.back().box.add(records.position(i));
  }
  return runs;
}

void expectSameAsBruteForce(const MadeUpRecords& records)
{
  CellGrid cells = counted(records);
  const QuadTree tree(cells, leafPoints);
  tree.assignCells(cells);
  const GridRecords view = records.view();
  std::vector<LeafRun> found;
  RunFinder(view, cells, tree).find(0, view.count, found);
  const std::vector<LeafRun> expected = bruteForce(view, cells);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    EXPECT_EQ(found[i].leaf, expected[i].leaf);
    EXPECT_EQ(found[i].first, expected[i].first);
    ASSERT_EQ(found[i].count, expected[i].count);
    EXPECT_EQ(found[i].box.low, expected[i].box.low);
    EXPECT_EQ(found[i].box.high, expected[i].box.high);
  }
}

TEST(RunFinder, FindsTheRunsOfFlightStrips)
{
  expectSameAsBruteForce(MadeUpRecords::strips(60000, 1));
}

TEST(RunFinder, FindsTheRunsOfPointsInNoOrder)
{
  expectSameAsBruteForce(MadeUpRecords::scattered(20000, 2));
}

TEST(RunFinder, ATrackThatLeavesAndReturnsWithinOneStepIsNotOverlooked)
{
  // Long stretches inside one leaf with single points far outside: a step that looks at its last
  // point only would jump over them.
  MadeUpRecords records;
  for (int i = 0; i < 5000; ++i)
  {
    const bool outside = i % 61 == 60;
    records.add(outside ? 900000 + i : i % 7, outside ? 900000 : i % 5, 0);
  }
  expectSameAsBruteForce(records);
}

TEST(RunFinder, EqualPointsAreOneRun)
{
  MadeUpRecords records;
  for (int i = 0; i < 1000; ++i)
  {
    records.add(7, 7, i);
  }
  expectSameAsBruteForce(records);
}

TEST(QuadTree, CountsEveryPointOnceAndKeepsLeavesSmall)
{
  const MadeUpRecords records = MadeUpRecords::strips(60000, 3);
  const CellGrid cells = counted(records);
  const QuadTree tree(cells, leafPoints);
  std::uint64_t sum = 0;
  for (const QuadNode& node : tree.nodes())
  {
    if (node.leaf())
    {
      sum += node.points;
      EXPECT_LE(node.points, leafPoints);
    }
    else
    {
      EXPECT_GE(node.childCount, 2);
      EXPECT_LE(node.points >> node.logStep, leafPoints / 2);
    }
  }
  EXPECT_EQ(sum, records.view().count);
}

TEST(QuadTree, WhatNoSquareCanPartIsSliced)
{
  MadeUpRecords records;
  for (int i = 0; i < 2000; ++i)
  {
    records.add(5, 5, i);
  }
  const CellGrid cells = counted(records);
  const QuadTree tree(cells, leafPoints);
  ASSERT_EQ(tree.nodes().size(), 8u); // 2000 = 7 slices of at most 300
  EXPECT_TRUE(tree.nodes()[0].sliced);
  std::uint64_t sum = 0;
  for (NodeIndex i = 1; i < 8; ++i)
  {
    EXPECT_LE(tree.nodes()[i].points, leafPoints);
    sum += tree.nodes()[i].points;
  }
  EXPECT_EQ(sum, 2000u);
}

TEST(QuadTree, AFarOutlierMakesNoChainOfNodes)
{
  MadeUpRecords records = MadeUpRecords::scattered(5000, 4);
  records.add(2000000000, 2000000000, 0);
  const CellGrid cells = counted(records);
  const QuadTree tree(cells, leafPoints);
  ASSERT_GT(tree.nodes().size(), 2u);
  EXPECT_EQ(tree.nodes()[0].childCount, 2);
  EXPECT_LT(tree.nodes().back().level, 8);
}

TEST(QuadTree, NoPointsNoNodes)
{
  const CellGrid cells({}, CellGrid::topBitsFor(0));
  EXPECT_TRUE(QuadTree(cells, leafPoints).nodes().empty());
}
} // namespace
} // namespace pointfront
