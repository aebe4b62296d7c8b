// Detail that grows from frame to frame: what is shown of nodes, by time as a value.

#include "pointfront/Plan/DetailGrowth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <vector>

using namespace pointfront;

namespace
{

constexpr std::uint32_t allPoints = 1000;
constexpr double duration = 0.2;

//        0
//     1     2
//    3 4
class Growing
{
public:
  explicit Growing(bool ordered)
    : ordered_(ordered)
  {
    const NodeIndex parents[] = { noNode, 0, 0, 1, 1 };
    for (NodeIndex n = 0; n < 5; ++n)
    {
      auto node = std::make_shared<NodeColumns>();
      node->node = n;
      node->parent = parents[n];
      node->positions.resize(allPoints);
      nodes.push_back(node);
    }
  }
  /// A frame whose front draws that many points of nodes, `passed` seconds after the last one.
  void frame(double passed, const std::map<NodeIndex, std::uint32_t>& drawn, bool moving = false)
  {
    seconds += passed;
    growth.begin({ seconds, duration, moving }, ordered_);
    shown.clear();
    for (const auto& [node, points] : drawn)
    {
      shown[node] = growth.grow(nodes[node], points);
    }
    leaving = growth.finish();
  }
  /// Points of a node as if all were of their size.
  double amount(NodeIndex node) const
  {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < shown.at(node).points; ++i)
    {
      sum += shown.at(node).growth.of(i);
    }
    return sum;
  }
  bool whole(NodeIndex node, std::uint32_t points) const
  {
    return shown.at(node).points == points && shown.at(node).spread == points &&
      shown.at(node).growth.whole();
  }

  std::vector<std::shared_ptr<const NodeColumns>> nodes;
  DetailGrowth growth;
  std::map<NodeIndex, DetailGrowth::Shown> shown;
  std::vector<DetailGrowth::Leaving> leaving;
  double seconds = 1.0e6;

private:
  bool ordered_;
};

} // namespace

TEST(PointGrowth, IsTheWholeSizeUnlessSaid)
{
  const PointGrowth whole;
  EXPECT_TRUE(whole.whole());
  EXPECT_EQ(whole.of(0), 1.0f);
  EXPECT_EQ(whole.of(1u << 30), 1.0f);
  EXPECT_EQ(whole.fullPoints(77), 77u);
}

TEST(PointGrowth, FallsAlongTheOrder)
{
  const PointGrowth growth{ 5.0f, 0.25f }; // 1 up to point 16, 0 from point 20 on
  EXPECT_FALSE(growth.whole());
  EXPECT_EQ(growth.of(16), 1.0f);
  EXPECT_EQ(growth.of(18), 0.5f);
  EXPECT_EQ(growth.of(20), 0.0f);
  EXPECT_EQ(growth.of(4000), 0.0f);
  EXPECT_EQ(growth.fullPoints(20), 17u);
  EXPECT_EQ(growth.fullPoints(9), 9u);
  EXPECT_EQ((PointGrowth{ 0.5f, 0.25f }).fullPoints(9), 0u);
  EXPECT_EQ((PointGrowth{ 0.5f, 0.0f }).fullPoints(9), 0u);
  // A point that counts as full has its full size to the last bit.
  for (int falling = 1; falling <= 400; ++falling)
  {
    for (int shown = falling; shown <= 6 * falling; shown += 1 + falling / 50)
    {
      const PointGrowth some{ float(shown) / float(falling), 1.0f / float(falling) };
      const std::uint32_t full = some.fullPoints(5u * unsigned(falling));
      ASSERT_TRUE(full == 0 || some.of(full - 1) == 1.0f) << shown << " of " << falling;
    }
  }
}

TEST(DetailGrowth, WhatIsSeenFirstIsThereAtOnce)
{
  for (const bool ordered : { true, false })
  {
    Growing scene(ordered);
    scene.frame(0.0, { { 0, 700 }, { 1, 30 } });
    EXPECT_TRUE(scene.whole(0, 700));
    EXPECT_TRUE(scene.whole(1, 30));
    EXPECT_FALSE(scene.growth.growing());
  }
}

TEST(DetailGrowth, WithoutADurationNothingGrows)
{
  Growing scene(true);
  for (const std::uint32_t points : { 10u, 900u, 20u })
  {
    scene.growth.begin({ scene.seconds += 0.01, 0.0, true }, true);
    const DetailGrowth::Shown shown = scene.growth.grow(scene.nodes[0], points);
    EXPECT_TRUE(shown.growth.whole());
    EXPECT_EQ(shown.points, points);
    EXPECT_FALSE(scene.growth.growing());
  }
}

/// As a node arrives: from nothing to all of it, in `duration`, by steps that are all alike.
TEST(DetailGrowth, ANodeGrowsFromNothing)
{
  Growing scene(true);
  scene.frame(0.0, { { 0, allPoints } });
  double before = 0.0, largest = 0.0;
  int frames = 0;
  for (; frames < 100; ++frames)
  {
    scene.frame(0.01, { { 0, allPoints }, { 1, 500 } });
    const double now = scene.amount(1);
    EXPECT_GE(now, before);
    largest = std::max(largest, now - before);
    before = now;
    EXPECT_TRUE(scene.whole(0, allPoints));
    if (!scene.growth.growing())
    {
      break;
    }
  }
  EXPECT_EQ(frames + 1, 20);
  EXPECT_TRUE(scene.whole(1, 500));
  EXPECT_LE(largest, 1.3 * 500 / 20);
}

/// The frames that a slow machine draws are fewer, and the end is the same; a long pause before is
/// no reason to skip the growth.
TEST(DetailGrowth, APauseIsNoGrowth)
{
  Growing scene(true);
  scene.frame(0.0, { { 0, allPoints } });
  scene.frame(3600.0, { { 0, allPoints }, { 1, 500 } });
  EXPECT_TRUE(scene.growth.growing());
  EXPECT_LT(scene.amount(1), 300.0);
  scene.frame(3600.0, { { 0, allPoints }, { 1, 500 } });
  EXPECT_FALSE(scene.growth.growing());
  EXPECT_TRUE(scene.whole(1, 500));
}

/// In motion a prefix that changes by a few points a frame shows points that have no size when
/// they come or go.
TEST(DetailGrowth, InMotionTheLastPointsOfAPrefixAreSmall)
{
  Growing scene(true);
  scene.frame(0.0, { { 0, 500 } }, true);
  std::vector<float> before;
  for (std::uint32_t points = 500; points > 300; points -= 5)
  {
    scene.frame(0.03, { { 0, points } }, true);
    const DetailGrowth::Shown& shown = scene.shown.at(0);
    std::vector<float> sizes(allPoints, 0.0f);
    for (std::uint32_t i = 0; i < shown.points; ++i)
    {
      sizes[i] = shown.growth.of(i);
    }
    EXPECT_EQ(shown.points, points);
    EXPECT_EQ(sizes[points / 2], 1.0f);
    EXPECT_LT(sizes[points - 1], 0.05f);
    for (std::size_t i = 0; i < before.size(); ++i)
    {
      EXPECT_LT(std::abs(sizes[i] - before[i]), 0.15f);
    }
    before = std::move(sizes);
  }
  scene.frame(0.03, { { 0, 305 } }, true);
  EXPECT_FALSE(scene.growth.growing()); // the same again is the same
  EXPECT_FALSE(scene.growth.whole()); // and at rest there is more
}

/// At rest all of it gets its size.
TEST(DetailGrowth, AtRestNothingIsLeftOfIt)
{
  Growing scene(true);
  scene.frame(0.0, { { 0, 500 }, { 1, 20 } }, true);
  scene.frame(0.03, { { 0, 480 }, { 1, 18 } }, true);
  EXPECT_FALSE(scene.growth.whole());
  scene.frame(0.02, { { 0, 500 }, { 1, 20 } });
  EXPECT_TRUE(scene.growth.growing());
  for (int i = 0; i < 20 && scene.growth.growing(); ++i)
  {
    scene.frame(0.02, { { 0, 500 }, { 1, 20 } });
  }
  EXPECT_FALSE(scene.growth.growing());
  EXPECT_TRUE(scene.growth.whole());
  EXPECT_TRUE(scene.whole(0, 500));
  EXPECT_TRUE(scene.whole(1, 20));
}

TEST(DetailGrowth, ANodeThatIsAllThereIsWholeInMotion)
{
  Growing scene(true);
  scene.frame(0.0, { { 0, allPoints } }, true);
  EXPECT_TRUE(scene.whole(0, allPoints));
}

/// A branch that comes into view is no detail of nodes that were seen.
TEST(DetailGrowth, ABranchThatComesIntoViewIsThereAtOnce)
{
  Growing scene(true);
  scene.frame(0.0, { { 2, 400 } });
  scene.frame(0.01, { { 2, 400 }, { 4, 100 } });
  EXPECT_TRUE(scene.whole(4, 100));
}

/// A node that grew beside the view would be small where nobody saw anything before.
TEST(DetailGrowth, WhatComesInFromTheSideIsThereAtOnce)
{
  for (const bool ordered : { true, false })
  {
    Growing scene(ordered);
    scene.frame(0.0, { { 0, allPoints } });
    scene.growth.begin({ scene.seconds + 0.01, duration, true }, ordered);
    scene.growth.grow(scene.nodes[0], allPoints);
    EXPECT_TRUE(scene.growth.grow(scene.nodes[1], allPoints, false).growth.whole());
    EXPECT_FALSE(scene.growth.grow(scene.nodes[2], allPoints, true).growth.whole());
  }
}

TEST(DetailGrowth, ThePlacesOfTheLastFrameAreThoseItsSidesHeld)
{
  DetailGrowth growth;
  const Bounds left{ { -2, 0, 0 }, { -1, 1, 1 } }, across{ { -2, 0, 0 }, { 1, 1, 1 } };
  GrowthMoment right{ 1.0, duration, true, {} };
  right.sides[0] = { 1, 0, 0, 0 }; // x >= 0
  growth.begin(right, true);
  EXPECT_TRUE(growth.saw(left)) << "before the first frame nothing is known";
  growth.begin({ 1.01, duration, true, {} }, true);
  EXPECT_FALSE(growth.saw(left));
  EXPECT_TRUE(growth.saw(across));
  growth.begin({ 1.02, duration, true, {} }, true);
  EXPECT_TRUE(growth.saw(left)) << "a view without sides sees all";
}

/// A tree whose children replace their parents: the parent stays until they have their size.
TEST(DetailGrowth, WhatIsReplacedGoesLast)
{
  Growing scene(false);
  scene.frame(0.0, { { 0, allPoints } });
  double before = 0.0;
  for (int i = 1; i <= 10; ++i)
  {
    scene.frame(0.02, { { 1, allPoints }, { 2, allPoints } });
    const double entering = scene.shown.at(1).growth.of(0);
    const double leaving = scene.leaving.empty() ? 0.0 : scene.leaving[0].growth.of(0);
    EXPECT_GE(entering, before);
    EXPECT_NEAR(std::max(entering, leaving), 1.0, 1e-6) << "step " << i;
    before = entering;
    if (i < 10)
    {
      ASSERT_EQ(scene.leaving.size(), 1u) << "step " << i;
      EXPECT_EQ(scene.leaving[0].node, scene.nodes[0]);
      EXPECT_EQ(scene.leaving[0].points, allPoints);
    }
  }
  scene.frame(0.02, { { 1, allPoints }, { 2, allPoints } });
  EXPECT_TRUE(scene.leaving.empty());
  EXPECT_FALSE(scene.growth.growing());
  EXPECT_TRUE(scene.whole(1, allPoints));
}

/// And back: children stay until their parent has its size.
TEST(DetailGrowth, AParentReplacesItsChildren)
{
  Growing scene(false);
  scene.frame(0.0, { { 1, allPoints }, { 2, allPoints } });
  scene.frame(0.05, { { 0, allPoints } });
  ASSERT_EQ(scene.leaving.size(), 2u);
  EXPECT_EQ(scene.leaving[0].node, scene.nodes[1]);
  EXPECT_EQ(scene.leaving[1].node, scene.nodes[2]);
  EXPECT_NEAR(scene.shown.at(0).growth.of(0), 0.5, 1e-6);
}

/// A frame of the same moment shows nothing of what replaces, all of what is replaced.
TEST(DetailGrowth, WithoutTimeNothingChanges)
{
  Growing scene(false);
  scene.frame(0.0, { { 0, allPoints } });
  scene.frame(0.0, { { 1, allPoints }, { 2, allPoints } });
  EXPECT_EQ(scene.shown.at(1).points, 0u);
  ASSERT_EQ(scene.leaving.size(), 1u);
  EXPECT_TRUE(scene.leaving[0].growth.whole());
}

/// Nodes are pinned by the plan of a frame only: one that left the memory is not kept.
TEST(DetailGrowth, WhatLeftTheMemoryIsNotKept)
{
  Growing scene(false);
  scene.frame(0.0, { { 0, allPoints } });
  scene.nodes[0].reset();
  scene.frame(0.02, { { 1, allPoints }, { 2, allPoints } });
  EXPECT_TRUE(scene.leaving.empty());
}

/// The view went elsewhere: nothing is drawn twice for what nobody replaces.
TEST(DetailGrowth, WhatNobodyReplacesIsGoneAtOnce)
{
  Growing scene(false);
  scene.frame(0.0, { { 3, allPoints }, { 2, allPoints } });
  scene.frame(0.02, { { 2, allPoints } });
  EXPECT_TRUE(scene.leaving.empty());
  EXPECT_FALSE(scene.growth.growing());
}
