#include "pointfront/Residency/RequestQueue.h"

#include <gtest/gtest.h>

namespace pointfront
{
namespace
{

std::vector<NodeIndex> order(const RequestQueue& queue)
{
  std::vector<NodeIndex> nodes;
  for (const LoadRequest& request : queue)
  {
    nodes.push_back(request.node);
  }
  return nodes;
}

using Nodes = std::vector<NodeIndex>;

} // namespace

TEST(RequestQueue, NeededThenPriorityThenAgeThenNode)
{
  RequestQueue queue;
  queue.replace({ { 7, 2.0, false } });
  const auto change = queue.replace({ { 1, 9.0, true }, { 5, 2.0, false }, { 4, 2.0, false },
    { 7, 2.0, false }, { 3, 5.0, false } });
  EXPECT_EQ(change.added, 4u);
  EXPECT_EQ(change.cancelled, 0u);
  EXPECT_EQ(order(queue), (Nodes{ 3, 7, 4, 5, 1 }));
}

TEST(RequestQueue, ReplacingCancelsWhatIsNotWantedAnyMore)
{
  RequestQueue queue;
  queue.replace({ { 1, 1.0, false }, { 2, 2.0, false }, { 3, 3.0, false } });
  const auto change = queue.replace({ { 2, 9.0, false }, { 4, 1.0, false }, { 2, 1.0, false } });
  EXPECT_EQ(change.added, 1u);
  EXPECT_EQ(change.cancelled, 2u);
  EXPECT_EQ(order(queue), (Nodes{ 2, 4 })) << "one entry a node, the first counts";
  EXPECT_EQ(queue.replace({}).cancelled, 2u);
  EXPECT_TRUE(queue.empty());
}

TEST(RequestQueue, AddsChangesAndCancelsOne)
{
  RequestQueue queue;
  EXPECT_TRUE(queue.add({ 1, 1.0, false }));
  EXPECT_TRUE(queue.add({ 2, 2.0, false }));
  EXPECT_FALSE(queue.add({ 1, 3.0, false }));
  EXPECT_EQ(order(queue), (Nodes{ 1, 2 }));
  EXPECT_TRUE(queue.contains(2));
  EXPECT_TRUE(queue.cancel(2));
  EXPECT_FALSE(queue.cancel(2));
  EXPECT_EQ(order(queue), Nodes{ 1 });
  queue.clear();
  EXPECT_EQ(queue.size(), 0u);
}

} // namespace pointfront
