#include "pointfront/Residency/ReleasePlan.h"

#include <gtest/gtest.h>

#include <utility>

namespace pointfront
{
namespace
{

using Taken = std::vector<std::pair<std::uint32_t, NodeIndex>>;

Taken farthest(ReleasePlan& plan, std::size_t bytes)
{
  Taken taken;
  for (const ReleasePlan::Candidate& candidate : plan.farthest(bytes))
  {
    taken.emplace_back(candidate.store, candidate.node);
  }
  return taken;
}

/// Two stores; nodes of 10 bytes.
ReleasePlan plan()
{
  ReleasePlan made;
  made.count(0, 1, 10, 0);
  made.count(0, 2, 10, 1);
  made.count(0, 3, 10, 2);
  made.count(1, 4, 10, 2);
  made.count(1, 5, 10, 100000);
  made.count(1, 6, 10, 1);
  return made;
}

} // namespace

TEST(ReleasePlan, TakesTheFarthestOverAllStores)
{
  ReleasePlan made = plan();
  EXPECT_EQ(farthest(made, 1), (Taken{ { 1, 5 } }));
  EXPECT_EQ(farthest(made, 11), (Taken{ { 1, 5 }, { 0, 3 } }));
  EXPECT_EQ(farthest(made, 30), (Taken{ { 1, 5 }, { 0, 3 }, { 1, 4 } }));
}

TEST(ReleasePlan, NeverTakesWhatIsNeeded)
{
  ReleasePlan made = plan();
  EXPECT_EQ(farthest(made, 1000), (Taken{ { 1, 5 }, { 0, 3 }, { 1, 4 }, { 0, 2 }, { 1, 6 } }));
  ReleasePlan nothing;
  nothing.count(0, 1, 10, 0);
  EXPECT_TRUE(farthest(nothing, 5).empty());
}

} // namespace pointfront
