#include "pointfront/Trees/SparseLeaves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

using namespace pointfront;

namespace
{
/// A root of leaves, each of an area and its points.
std::vector<SparseLeaves::Square> rootOf(const std::vector<std::pair<double, double>>& leaves)
{
  std::vector<SparseLeaves::Square> squares(1);
  double all = 0.0;
  for (const auto& [area, points] : leaves)
  {
    squares[0].area += area;
    all += points;
    squares.push_back({ 0, true, area, std::sqrt(area / points) });
  }
  squares[0].spacing = std::sqrt(squares[0].area / all);
  return squares;
}
} // namespace

TEST(SparseLeaves, EvenLeavesKeepTheirMean)
{
  // Strips overlap in one square, and one has half as many points.
  const SparseLeaves leaves(rootOf({ { 1, 100 }, { 1, 200 }, { 1, 100 }, { 1, 50 } }));
  EXPECT_EQ(leaves.ratio(0), 1.0);
  EXPECT_EQ(leaves.ratio(4), 1.0);
}

TEST(SparseLeaves, TheSparseOfUnevenOnesDecide)
{
  // The sparsest leaf has less than a tenth of the area, so the next one decides: 93 of
  // 2,097 points.
  const SparseLeaves leaves(rootOf({ { 1, 1000 }, { 5, 4 }, { 1, 1000 }, { 93, 93 } }));
  EXPECT_NEAR(leaves.ratio(0), 1.0 / std::sqrt(100.0 / 2097.0), 1e-5);
  EXPECT_EQ(leaves.ratio(2), 1.0) << "a leaf";
}

TEST(SparseLeaves, ALittleGroundDecidesNothing)
{
  const SparseLeaves leaves(rootOf({ { 5, 1000 }, { 5, 1000 }, { 1, 2 } }));
  EXPECT_EQ(leaves.ratio(0), 1.0);
}

TEST(SparseLeaves, EachSquareIsJudgedByItsOwnLeaves)
{
  auto squares = rootOf({ { 10, 1000 }, { 1, 1000 } });
  // The second becomes a square of two, one of which is sparse: nine tenths of its area, less than
  // a tenth of all.
  squares[2].whole = false;
  squares.push_back({ 2, true, 0.1, std::sqrt(0.1 / 975) });
  squares.push_back({ 2, true, 0.9, std::sqrt(0.9 / 25) });
  const SparseLeaves leaves(squares);
  EXPECT_EQ(leaves.ratio(0), 1.0);
  EXPECT_NEAR(leaves.ratio(2), 6.0, 1e-5);
}
