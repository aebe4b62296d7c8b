#include "TestBuildClouds.h"

#include "pointfront/Ingest/CellTable.h"
#include "pointfront/Records/TreeSpace.h"
#include "pointfront/Trees/Partition.h"

#include <gtest/gtest.h>

#include <map>
#include <numeric>

namespace pointfront
{
namespace
{
using test::Random;

/// Cells of 2^4 steps with those counts along the x axis.
std::vector<CountedCell> row(const std::vector<std::uint64_t>& counts)
{
  std::vector<CountedCell> cells;
  for (std::size_t i = 0; i < counts.size(); ++i)
  {
    if (counts[i] > 0)
    {
      cells.push_back({ { static_cast<std::uint32_t>(i) << 4, 0, 0 }, counts[i] });
    }
  }
  return cells;
}

TEST(Partition, SplitsUntilPartsFit)
{
  //  counts   5 5 | 50 . || 90 . | . .     a part holds 60
  //  parts     0  |  0   ||  1
  std::vector<std::uint32_t> partOf;
  const Partition partition(row({ 5, 5, 50, 0, 90 }), 4, 60, partOf);
  EXPECT_EQ(partOf, (std::vector<std::uint32_t>{ 0, 0, 0, 1 }));
  ASSERT_EQ(partition.nodes().size(), 3u);
  const Partition::Node& root = partition.nodes()[partition.root()];
  EXPECT_EQ(root.cell.log2Side, 7u);
  EXPECT_EQ(root.count, 150u);
  EXPECT_EQ(partition.part(0).count, 60u);
  EXPECT_EQ(partition.part(0).cell.log2Side, 6u);
  EXPECT_EQ(partition.part(1).cell.log2Side, 4u); // too large, but no finer cells are known
  EXPECT_EQ(postOrder(partition.tree()), (std::vector<std::uint32_t>{ 1, 2, 0 }));
}

TEST(Partition, SkipsLevelsWithOneChild)
{
  std::vector<std::uint32_t> partOf;
  const Partition partition(row({ 9, 9 }), 4, 10, partOf);
  EXPECT_EQ(partition.nodes()[0].cell.log2Side, 5u);
  EXPECT_EQ(partition.partCount(), 2u);
}

TEST(Partition, RefinesAPartByItsOwnCells)
{
  std::vector<std::uint32_t> partOf;
  Partition partition(row({ 5, 50, 5, 5 }), 4, 20, partOf);
  ASSERT_EQ(partOf[1], 1u);
  const std::vector<CountedCell> fine{ { { 16, 0, 0 }, 15 }, { { 18, 0, 0 }, 20 },
    { { 16, 2, 0 }, 15 } };
  std::vector<std::uint32_t> finePartOf;
  const std::vector<std::uint32_t> numbers =
    partition.refine(1, Partition(fine, 1, 20, finePartOf));
  ASSERT_EQ(numbers.size(), 3u);
  EXPECT_EQ(numbers[0], 1u);
  EXPECT_EQ(partition.part(numbers[1]).count, 20u);
  std::uint64_t inParts = 0;
  for (std::uint32_t part = 0; part < partition.partCount(); ++part)
  {
    EXPECT_EQ(partition.part(part).part, part);
    inParts += partition.part(part).count;
  }
  EXPECT_EQ(inParts, 65u);
  const std::vector<std::uint32_t> order = postOrder(partition.tree());
  EXPECT_EQ(order.size(), partition.nodes().size());
  EXPECT_EQ(order.back(), partition.root());
}

TEST(Partition, CutsEqualPointsByOrder)
{
  std::vector<std::uint32_t> partOf;
  Partition partition({ { { 3, 3, 3 }, 100 } }, 0, 20, partOf);
  const std::vector<std::uint32_t> numbers = partition.refineByOrder(0);
  ASSERT_EQ(numbers.size(), 8u);
  EXPECT_EQ(partition.part(numbers[0]).count, 13u);
  EXPECT_EQ(partition.part(numbers[7]).count, 9u);
}

TEST(Partition, CountsInAGridThatCoarsensItself)
{
  Random random(8);
  CellCounts all(0);
  CellCounts halves[2] = { CellCounts(0), CellCounts(3) };
  std::map<std::array<std::uint32_t, 3>, std::uint64_t> expected;
  std::vector<TreePosition> positions;
  for (int i = 0; i < 400000; ++i)
  {
    positions.emplace_back(random.next() & 0x3ff, random.next() & 0x3ff, random.next() & 0x3ff);
  }
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    all.add(positions[i]);
    halves[i % 2].add(positions[i]);
  }
  halves[0].add(halves[1]);
  EXPECT_LE(all.table().size(), CellCounts::limit);
  EXPECT_GE(all.table().shift(), 1u);
  all.coarsen(6);
  halves[0].coarsen(6);
  for (const TreePosition& p : positions)
  {
    ++expected[{ p.x >> 6, p.y >> 6, p.z >> 6 }];
  }
  for (const CellCounts* counts : { &all, &halves[0] })
  {
    EXPECT_EQ(counts->table().size(), expected.size());
    for (const auto& [cell, count] : expected)
    {
      ASSERT_EQ(counts->table().find({ cell[0], cell[1], cell[2] }), count);
    }
  }
  EXPECT_EQ(all.table().find({ 99, 0, 0 }), 0u);
}

TEST(Partition, PlacesTheRootAroundAnyGridPositions)
{
  TreeSpace space;
  space.shift = { 0, 0, 3 };
  const GridPosition low(-5000000000, 7, -3);
  const GridPosition high(-4999999000, 900, 40);
  const auto log2Side = placeRoot(space, low, high);
  ASSERT_TRUE(log2Side);
  EXPECT_EQ(*log2Side, 10u);
  for (const GridPosition& g : { low, high, GridPosition(-4999999500, 8, 0) })
  {
    const TreePosition steps = space.relativeSteps(space.absoluteSteps(g));
    EXPECT_LT(std::max({ steps.x, steps.y, steps.z }), 1u << *log2Side);
    EXPECT_EQ(space.gridPosition(steps), g);
  }
  EXPECT_FALSE(placeRoot(space, GridPosition(0), GridPosition(std::int64_t(1) << 33, 0, 0)));
  EXPECT_EQ(axisShifts({ 0.01, 0.01, 0.001 }), (std::array<unsigned, 3>{ 3, 3, 0 }));
  const GridPosition end(std::int64_t(1) << 31, 1000, 1 << 30);
  EXPECT_EQ(fittingShifts({ 3, 3, 0 }, GridPosition(0), end), (std::array<unsigned, 3>{ 0, 3, 0 }));
  EXPECT_EQ(axisShifts({ 1e-7, 1e-7, 0.01 }), (std::array<unsigned, 3>{ 0, 0, 0 }));
}

} // namespace
} // namespace pointfront
