// A front that knows which nodes a filter leaves out: what it draws of the others is what it draws
// without knowing, and it never names those that are left out.

#include "pointfront/Detail/ViewDetail.h"
#include "pointfront/Front/RenderFront.h"
#include "pointfront/Front/ViewMargin.h"

#include "FrontScene.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace pointfront
{
namespace
{

using test::ScriptedResidency;
using Verdict = NodePruning::Verdict;

enum class Pruner
{
  Front,
  ViewDetail
};

/// A third of the nodes has points that pass; all above them are descended.
std::vector<Verdict> someVerdicts(const Hierarchy& tree, std::uint32_t seed)
{
  std::mt19937 random(seed);
  std::vector<Verdict> verdicts(tree.nodeCount(), Verdict::Skip);
  for (NodeIndex n = tree.nodeCount(); n-- > 0;)
  {
    verdicts[n] = random() % 3 == 0 ? Verdict::Draw : verdicts[n];
    const NodeIndex parent = tree.node(n).parent;
    if (verdicts[n] != Verdict::Skip && parent != noNode && verdicts[parent] == Verdict::Skip)
    {
      verdicts[parent] = Verdict::Descend;
    }
  }
  return verdicts;
}

struct PrunedView
{
  PrunedView(Pruner way, std::shared_ptr<const Hierarchy> hierarchy)
    : tree(std::move(hierarchy))
  {
    if (way == Pruner::Front)
    {
      selection = std::make_unique<RenderFront>(tree);
    }
    else
    {
      selection = std::make_unique<ViewDetail>(tree);
    }
    limits.targetErrorPx = 2.0;
    limits.overviewPoints = 3000;
    limits.layers.resize(1);
    limits.prefetchSiblings = true;
  }

  /// Everything that is asked for comes; points of each node that is drawn in the end.
  std::map<NodeIndex, std::uint32_t> settle(const std::vector<Verdict>& verdicts)
  {
    const FrontDelta* delta = &selection->update(view, residency, limits);
    for (int update = 0; update < 2000 && !delta->complete; ++update)
    {
      for (const LoadRequest& request : delta->requests)
      {
        EXPECT_TRUE(verdicts.empty() || verdicts[request.node] == Verdict::Draw) << request.node;
      }
      residency.load(delta->requests);
      delta = &selection->update(view, residency, limits);
    }
    EXPECT_TRUE(delta->complete);
    std::map<NodeIndex, std::uint32_t> drawn;
    for (const DrawItem& item : delta->draw)
    {
      drawn[item.node] = item.pointCount;
    }
    return drawn;
  }

  std::shared_ptr<const Hierarchy> tree;
  std::unique_ptr<DetailSelection> selection;
  ScriptedResidency residency;
  FrontLimits limits;
  View view =
    View::perspective({ 900, 300, 200 }, { 0, 0, 0 }, { 0, 0, 1 }, 0.9, 0.1, 1e5, 800, 600);
};

class NodePruningOf : public ::testing::TestWithParam<std::tuple<Pruner, Refinement>>
{
protected:
  static std::shared_ptr<const Hierarchy> tree(std::uint32_t seed)
  {
    test::TreeShape shape;
    shape.seed = seed;
    shape.refinement = std::get<1>(GetParam());
    return test::randomTree(shape);
  }
};

} // namespace

INSTANTIATE_TEST_SUITE_P(Selections, NodePruningOf,
  ::testing::Combine(::testing::Values(Pruner::Front, Pruner::ViewDetail),
    ::testing::Values(Refinement::Add, Refinement::Replace)));

TEST_P(NodePruningOf, DrawsWhatIsLeftAndNeverNamesTheOthers)
{
  std::size_t left = 0;
  std::size_t out = 0;
  for (std::uint32_t seed = 1; seed <= 4; ++seed)
  {
    SCOPED_TRACE(seed);
    const auto hierarchy = tree(seed);
    PrunedView whole(std::get<0>(GetParam()), hierarchy);
    const auto everything = whole.settle({});
    PrunedView pruned(std::get<0>(GetParam()), hierarchy);
    const auto verdicts = someVerdicts(*hierarchy, seed);
    pruned.limits.layers[0].pruning = std::make_shared<const NodePruning>(verdicts);
    const auto drawn = pruned.settle(verdicts);
    for (const auto& [node, points] : everything)
    {
      if (verdicts[node] == Verdict::Draw)
      {
        const auto found = drawn.find(node);
        ASSERT_TRUE(found != drawn.end()) << node;
        EXPECT_EQ(found->second, points) << node;
        ++left;
      }
      else
      {
        EXPECT_EQ(drawn.count(node), 0u) << node;
        ++out;
      }
    }
    EXPECT_LE(drawn.size(), everything.size());
  }
  EXPECT_GT(left, 20u);
  EXPECT_GT(out, 20u);
}

TEST_P(NodePruningOf, AFilterMayComeAndGoBetweenTwoFrames)
{
  const auto hierarchy = tree(5);
  PrunedView view(std::get<0>(GetParam()), hierarchy);
  const auto everything = view.settle({});
  const auto verdicts = someVerdicts(*hierarchy, 5);
  view.limits.layers[0].pruning = std::make_shared<const NodePruning>(verdicts);
  const FrontDelta& next = view.selection->update(view.view, view.residency, view.limits);
  EXPECT_FALSE(next.draw.empty());
  for (const DrawItem& item : next.draw)
  {
    EXPECT_EQ(verdicts[item.node], Verdict::Draw) << "in the very next frame";
  }
  view.limits.layers[0].pruning = nullptr;
  EXPECT_EQ(view.settle({}), everything);
}

TEST_P(NodePruningOf, AStoreWithoutAnythingThatPassesIsCompleteAndEmpty)
{
  const auto hierarchy = tree(6);
  PrunedView view(std::get<0>(GetParam()), hierarchy);
  const std::vector<Verdict> nothing(hierarchy->nodeCount(), Verdict::Skip);
  view.limits.layers[0].pruning = std::make_shared<const NodePruning>(nothing);
  EXPECT_TRUE(view.settle(nothing).empty());
}

TEST(NodePruning, TheMarginAheadOfTheMotionKnowsItToo)
{
  const auto hierarchy = test::randomTree({});
  const auto verdicts = someVerdicts(*hierarchy, 7);
  std::vector<LayerLimits> layers(1);
  layers[0].pruning = std::make_shared<const NodePruning>(verdicts);
  const auto from = [](double x) {
    return View::perspective({ x, 300, 200 }, { 0, 0, 0 }, { 0, 0, 1 }, 0.9, 0.1, 1e5, 800, 600);
  };
  ViewMargin margin(hierarchy);
  ScriptedResidency nothing;
  margin.ahead(from(1000.0), 4.0, nothing, 8.0, 500, layers);
  const auto& ahead = margin.ahead(from(990.0), 4.0, nothing, 8.0, 500, layers);
  EXPECT_FALSE(ahead.empty());
  for (const LoadRequest& request : ahead)
  {
    EXPECT_EQ(verdicts[request.node], Verdict::Draw) << request.node;
  }
}

} // namespace pointfront
