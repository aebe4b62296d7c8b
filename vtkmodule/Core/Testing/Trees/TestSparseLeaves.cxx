#include "pointfront/Trees/SparseLeaves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

using namespace pointfront;

namespace
{
/// A root of leaves, each of an area and its points.
std::vector<SparseLeaves::Square> rootOf(
  const std::vector<std::pair<double, std::uint64_t>>& leaves)
{
  std::vector<SparseLeaves::Square> squares(1);
  double area = 0.0;
  for (const auto& [leafArea, points] : leaves)
  {
    area += leafArea;
    squares[0].points += points;
    squares.push_back({ 0, true, points, std::sqrt(leafArea / double(points)) });
  }
  squares[0].spacing = std::sqrt(area / double(squares[0].points));
  return squares;
}
} // namespace

TEST(SparseLeaves, EvenLeavesKeepTheirMean)
{
  // Strips overlap in a third of the squares, and a corner is half empty.
  const SparseLeaves leaves(rootOf({ { 1, 100 }, { 1, 200 }, { 1, 100 }, { 1, 50 } }));
  EXPECT_EQ(leaves.ratio(0), 1.0);
  EXPECT_EQ(leaves.ratio(4), 1.0);
}

TEST(SparseLeaves, TheSparseOfUnevenOnesDecide)
{
  // The sparsest leaf has less than one point of fifty, so the next one decides.
  const SparseLeaves leaves(rootOf({ { 1, 1000 }, { 7, 7 }, { 1, 1000 }, { 91, 93 } }));
  EXPECT_NEAR(leaves.ratio(0), std::sqrt((91.0 / 93.0) / (100.0 / 2100.0)), 1e-5);
  EXPECT_EQ(leaves.ratio(1), 1.0) << "a leaf";
}

TEST(SparseLeaves, AFewPointsDecideNothing)
{
  const SparseLeaves leaves(rootOf({ { 1, 1000 }, { 1, 1000 }, { 30, 20 } }));
  EXPECT_EQ(leaves.ratio(0), 1.0);
}

TEST(SparseLeaves, EachSquareIsJudgedByItsOwnLeaves)
{
  auto squares = rootOf({ { 1, 1000 }, { 1, 1000 } });
  // The second becomes a square of two, one of which is sparse: a fortieth of its points, a
  // hundredth of all.
  squares[2].whole = false;
  squares.push_back({ 2, true, 975, std::sqrt(0.1 / 975) });
  squares.push_back({ 2, true, 25, std::sqrt(0.9 / 25) });
  const SparseLeaves leaves(squares);
  EXPECT_EQ(leaves.ratio(0), 1.0);
  EXPECT_NEAR(leaves.ratio(2), 6.0, 1e-5);
}
