#include "SortedCloud.h"

#include "pointfront/Trees/Sampler.h"
#include "pointfront/Trees/SparsePoints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>

namespace pointfront
{
namespace
{
using test::Random;
using test::SortedCloud;

SortedCloud cloudOf(std::size_t count, const std::function<TreePosition(std::size_t)>& at)
{
  std::vector<TreePosition> positions;
  for (std::size_t i = 0; i < count; ++i)
  {
    positions.push_back(at(i));
  }
  return SortedCloud(positions);
}

double sparse(const SortedCloud& cloud)
{
  return sparseSpacing(cloud.view(), cloud.all);
}

TEST(SparsePoints, EvenPointsKeepTheirSpacing)
{
  Random random(5);
  const auto coordinate = [&](std::uint32_t range) { return random.next() % range; };
  for (const std::uint32_t range : { 40000u, 57000u, 65536u, 90000u, 113000u })
  {
    const std::pair<const char*, SortedCloud> clouds[] = {
      { "random on a plane",
        cloudOf(10000,
          [&](std::size_t) { return TreePosition(coordinate(range), coordinate(range), 7); }) },
      { "a grid",
        cloudOf(10000,
          [&](std::size_t i) { return TreePosition(i % 100, i / 100, 0) * (range / 100); }) },
      { "lines of a scanner",
        cloudOf(10000,
          [&](std::size_t i)
          { return TreePosition(i % 500 * (range / 500), i / 500 * (range / 20), 0); }) },
    };
    for (const auto& [name, cloud] : clouds)
    {
      EXPECT_LE(sparse(cloud), 1.15 * surfaceSpacing(cloud.view(), cloud.all)) << name << range;
    }
    const SortedCloud volume = cloudOf(10000,
      [&](std::size_t)
      { return TreePosition(coordinate(range), coordinate(range), coordinate(range)); });
    EXPECT_LE(sparse(volume), double(range) / std::cbrt(10000.0)) << range;
  }
}

/// A prefix leaves the sparse part two and a half thresholds apart at most if the spacing is
/// .4 of the sparse part's own. Here these points are 1,000 steps apart, and a hundred times as far
/// as most.
TEST(SparsePoints, AFewSparseOnesRaiseIt)
{
  Random random(6);
  for (const std::size_t far : { 1000u, 3000u })
  {
    const std::uint32_t side = far == 1000u ? 31623 : 54772;
    const SortedCloud cloud = cloudOf(16000,
      [&](std::size_t i)
      {
        const std::uint32_t range = i < far ? side : 1200;
        const auto x = static_cast<std::uint32_t>(random.next() % range);
        return TreePosition(x, random.next() % range, 0);
      });
    EXPECT_LT(surfaceSpacing(cloud.view(), cloud.all), 200.0);
    EXPECT_GT(sparse(cloud), 400.0) << far;
    EXPECT_LT(sparse(cloud), 1000.0) << far;
  }
}

TEST(SparsePoints, PointsOfOnePlaceNeedNothing)
{
  EXPECT_EQ(sparse(SortedCloud({ TreePosition(1, 2, 3) })), 0.0);
  EXPECT_EQ(sparse(SortedCloud({ TreePosition(1, 2, 3), TreePosition(1, 2, 3) })), 0.0);
  const SortedCloud two({ TreePosition(0), TreePosition(0xffffffffu) });
  EXPECT_GT(sparse(two), 0.4 * 2147483648.0);
}

} // namespace
} // namespace pointfront
