// In the steady state an update allocates nothing: counted at operator new of the whole program.

#include "pointfront/Detail/ViewDetail.h"
#include "pointfront/Front/RenderFront.h"

#include "AllocationCount.h"
#include "FrontScene.h"
#include "TerrainPages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pointfront
{

/// To and fro over the same ground, 1,500 updates to get used to it and 300 that are counted: the
/// longest cut or list, and the allocations.
std::pair<std::uint32_t, std::size_t> allocationsOf(
  DetailSelection& front, const Hierarchy& table, double size, std::uint64_t pointBudget)
{
  test::ScriptedResidency residency;
  residency.otherwise = ResidencySnapshot::State::Resident;
  FrontLimits limits;
  limits.targetErrorPx = 1.0;
  limits.pointBudget = pointBudget;
  limits.overviewPoints = 5000;
  std::uint32_t longest = 0;
  std::size_t before = 0;
  for (int u = 0; u < 1800; ++u)
  {
    before = u == 1500 ? test::allocationCount() : before;
    const double x = size * (1.0 + 0.004 * std::abs(u % 100 - 50));
    const View view = View::perspective({ x, 0.3 * size, 0.2 * size }, { 0, 0, 0 }, { 0, 0, 1 },
      0.9, 1e-4 * size, 100.0 * size, 800, 600);
    const std::uint64_t seen = table.arrivals();
    const FrontDelta& delta = front.update(view, residency, limits);
    longest = std::max(longest, delta.frontLength);
    if (delta.rowsComing && u < 1500)
    {
      table.waitForArrival(seen);
    }
  }
  EXPECT_GT(before, 0u) << "the counter is in place";
  return { longest, test::allocationCount() - before };
}

TEST(RenderFront, AllocatesNothingInTheSteadyState)
{
  for (const Refinement refinement : { Refinement::Add, Refinement::Replace })
  {
    test::TreeShape shape;
    shape.refinement = refinement;
    const auto tree = test::randomTree(shape);
    RenderFront front(tree);
    const auto [longest, counted] = allocationsOf(front, *tree, 1000.0, 100000);
    EXPECT_EQ(counted, 0u);
    EXPECT_GT(longest, 100u);
  }
}

TEST(RenderFront, AllocatesNothingOverAPagedTableOfHundredMillionNodes)
{
  const auto table = test::terrainTable(14);
  RenderFront front(table);
  const auto [longest, counted] = allocationsOf(front, *table, test::Terrain::sizeMetres, 10000000);
  EXPECT_EQ(counted, 0u);
  EXPECT_GT(longest, 200u);
  EXPECT_LE(table->cachedBytes(), PagedNodeTable::defaultCacheBytes);
}

TEST(ViewDetail, AllocatesNothingInTheSteadyState)
{
  for (const Refinement refinement : { Refinement::Add, Refinement::Replace })
  {
    test::TreeShape shape;
    shape.refinement = refinement;
    const auto tree = test::randomTree(shape);
    ViewDetail detail(tree);
    const auto [longest, counted] = allocationsOf(detail, *tree, 1000.0, 100000);
    EXPECT_EQ(counted, 0u);
    EXPECT_GT(longest, 5u);
  }
}

} // namespace pointfront
