#include "NormalClouds.h"

#include "FlannIndex.h"

#include "pointfront/Neighbourhood/KdIndex.h"

namespace
{
using namespace pointfront;

TEST(FlannIndex, FindsWhatTheKernelsTreeFinds)
{
  test::Random random(5);
  PositionSet set;
  for (int i = 0; i < 3200; ++i) // the first half on a grid: many ties
  {
    set.positions.emplace_back(
      1e6 + double(i % 40), double(i / 40 % 40), i < 1600 ? 0.0 : random.uniform());
    set.counts.push_back(static_cast<std::uint32_t>(1 + random.next() % 3));
  }
  const FlannIndex flann(set, 0.0f);
  const KdIndex kernel(set, 3);
  NeighbourList a(16);
  NeighbourList b(16);
  for (int i = 0; i < 500; ++i)
  {
    const glm::dvec3 from(1e6 + 60.0 * random.uniform() - 10.0, double(i % 40), 0.0);
    a.begin(set);
    b.begin(set);
    flann.search(from, a);
    kernel.search(from, b);
    ASSERT_EQ(a.entries().size(), b.entries().size());
    for (std::size_t n = 0; n < a.entries().size(); ++n)
    {
      EXPECT_EQ(a.entries()[n].squaredDistance, b.entries()[n].squaredDistance);
      EXPECT_EQ(set.positions[a.entries()[n].index], set.positions[b.entries()[n].index]);
    }
  }
}

TEST(FlannIndex, ARadiusIsClosed)
{
  PositionSet set;
  for (int i = 0; i < 100; ++i)
  {
    set.positions.emplace_back(i, 0.0, 0.0);
    set.counts.push_back(1);
  }
  const FlannIndex index(set, 0.0f);
  NeighbourList list(0);
  list.begin(set, 25.0);
  index.search({ 50.0, 0.0, 0.0 }, list);
  EXPECT_EQ(list.entries().size(), 11u);
}

TEST(FlannIndex, OfNothingFindsNothing)
{
  const PositionSet set;
  const FlannIndex index(set, 0.0f);
  NeighbourList list(4);
  list.begin(set);
  index.search({ 0.0, 0.0, 0.0 }, list);
  EXPECT_TRUE(list.entries().empty());
}
} // namespace
