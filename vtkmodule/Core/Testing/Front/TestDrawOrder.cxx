#include "pointfront/Front/DrawOrder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace pointfront
{
namespace
{

/// Numbered from the last to the first, so that the order they come in is not that of the nodes.
template <typename DistanceOf>
std::vector<DrawItem> items(NodeIndex count, DistanceOf distanceOf)
{
  std::vector<DrawItem> list;
  for (NodeIndex n = count; n-- > 0;)
  {
    list.push_back({ n, n + 1, 0.5f * float(n), float(distanceOf(n)) });
  }
  return list;
}

void expectOrdered(std::vector<DrawItem> list)
{
  std::vector<DrawItem> expected = list;
  std::sort(expected.begin(), expected.end(),
    [](const DrawItem& a, const DrawItem& b)
    { return a.distance != b.distance ? a.distance < b.distance : a.node < b.node; });
  DrawOrder().sort(list);
  ASSERT_EQ(list.size(), expected.size());
  for (std::size_t i = 0; i < list.size(); ++i)
  {
    ASSERT_EQ(list[i].node, expected[i].node) << "at " << i;
    ASSERT_EQ(list[i].pointCount, expected[i].pointCount);
    ASSERT_EQ(list[i].errorPx, expected[i].errorPx);
    ASSERT_EQ(list[i].distance, expected[i].distance);
  }
}

// Lists short and long: compared, and by digits.
class DrawOrders : public ::testing::TestWithParam<NodeIndex>
{
};

} // namespace

INSTANTIATE_TEST_SUITE_P(Lengths, DrawOrders, ::testing::Values(0, 1, 2, 399, 400, 2300, 50000));

TEST_P(DrawOrders, DistancesOfAllSizes)
{
  std::mt19937 random(20101);
  std::uniform_real_distribution<double> exponent(-44.0, 38.0);
  expectOrdered(items(GetParam(), [&](NodeIndex) { return std::pow(10.0, exponent(random)); }));
}

TEST_P(DrawOrders, DistancesThatDifferInOneDigitOnly)
{
  for (const float step : { 1.0e-7f, 1.0f / 4096, 1.0f / 16, 1.0f })
  {
    expectOrdered(items(GetParam(), [&](NodeIndex n) { return 1.0f + step * float(n % 7); }));
  }
}

TEST_P(DrawOrders, ManyAtTheSameDistance)
{
  expectOrdered(items(GetParam(), [](NodeIndex) { return 0.0f; }));
  expectOrdered(items(GetParam(), [](NodeIndex n) { return n % 2 == 0 ? 0.0f : -0.0f; }));
  expectOrdered(items(GetParam(),
    [](NodeIndex n) { return n % 5 ? float(n % 11) : std::numeric_limits<float>::infinity(); }));
}

} // namespace pointfront
