#include "pointfront/Front/NodeRequests.h"
#include "pointfront/Front/SeenResidency.h"

#include "FrontScene.h"

#include <gtest/gtest.h>

namespace pointfront
{
namespace
{

using test::ScriptedResidency;
using State = ResidencySnapshot::State;

std::vector<NodeIndex> nodesOf(const FrontDelta& delta)
{
  std::vector<NodeIndex> nodes;
  for (const LoadRequest& request : delta.requests)
  {
    nodes.push_back(request.node);
  }
  return nodes;
}

LoadRequest wanted(NodeIndex node, double priority)
{
  return { node, priority, false, 10, 0 };
}

} // namespace

TEST(NodeRequests, AbsentNodesAreAskedForAndFailedOnesCounted)
{
  ScriptedResidency residency;
  residency.set(1, State::Resident);
  residency.set(2, State::Failed);
  NodeRequests requests;
  FrontDelta delta;
  for (int update = 0; update < 2; ++update) // the second knows nothing of the first
  {
    requests.begin(residency);
    EXPECT_EQ(requests.require(wanted(0, 1.0)), State::Absent);
    EXPECT_EQ(requests.require(wanted(1, 1.0)), State::Resident);
    EXPECT_EQ(requests.require(wanted(2, 1.0)), State::Failed);
    requests.countFailed();
    requests.finish(8, delta);
    EXPECT_EQ(nodesOf(delta), std::vector<NodeIndex>{ 0 });
    EXPECT_EQ(delta.failedNodes, 2u);
    EXPECT_EQ(requests.missing(), 1u);
  }
}

TEST(NodeRequests, TheMostUrgentAreHandedOut)
{
  const ScriptedResidency residency;
  NodeRequests requests;
  FrontDelta delta;
  requests.begin(residency);
  requests.prefetch(wanted(9, 100.0));
  requests.require(wanted(3, 1.0));
  requests.require(wanted(5, 2.0));
  requests.require(wanted(4, 2.0));
  requests.finish(8, delta);
  EXPECT_EQ(nodesOf(delta), (std::vector<NodeIndex>{ 4, 5, 3, 9 }));
  EXPECT_TRUE(delta.requests.back().optional);
  EXPECT_EQ(requests.missing(), 3u) << "the view does not need the optional one";
  requests.finish(2, delta);
  EXPECT_EQ(nodesOf(delta), (std::vector<NodeIndex>{ 4, 5 }));
}

TEST(SeenResidency, IsExhaustedWhenItSaysSoOfTheSameRequests)
{
  ScriptedResidency residency;
  residency.tellRevisions();
  residency.full = true;
  SeenResidency seen;
  seen.begin(residency);
  seen.finish(residency, true, 1);
  EXPECT_FALSE(seen.exhausted()) << "it cannot speak of the first requests yet";
  EXPECT_FALSE(seen.unchanged(residency, 1));
  seen.begin(residency);
  seen.finish(residency, true, 1);
  EXPECT_TRUE(seen.exhausted());
  EXPECT_TRUE(seen.unchanged(residency, 1));
  seen.begin(residency);
  seen.finish(residency, false, 1);
  EXPECT_FALSE(seen.exhausted()) << "of another view";
}

TEST(SeenResidency, WhatComesWhileAnUpdateLooksIsNewsToTheNext)
{
  ScriptedResidency residency;
  residency.tellRevisions();
  residency.full = true;
  SeenResidency seen;
  for (int update = 0; update < 2; ++update)
  {
    seen.begin(residency);
    residency.set(7, State::Resident);
    seen.finish(residency, true, 1);
    EXPECT_FALSE(seen.exhausted());
    EXPECT_FALSE(seen.unchanged(residency, 1));
  }
}

} // namespace pointfront
