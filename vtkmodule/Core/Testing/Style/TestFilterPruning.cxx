#include "GoldenFiles.h"
#include "SampleStore.h"

#include "pointfront/Style/ClassHeights.h"
#include "pointfront/Style/FilterPruning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

namespace pointfront
{
namespace
{

using Verdict = NodePruning::Verdict;

/// Nodes of the sample whose own points have one that passes, by looking at each.
std::vector<bool> nodesThatPass(const SampleStore& sample, const PointFilter& filter)
{
  std::vector<bool> passes(sample.nodes.size(), false);
  for (NodeIndex i = 0; i < sample.nodes.size(); ++i)
  {
    const auto count = static_cast<std::uint32_t>(sample.points[i].size());
    std::vector<std::uint8_t> keep(count);
    filter.evaluate(sample.points[i], sample.description.schema, 0, count, keep.data());
    passes[i] = std::find(keep.begin(), keep.end(), 1) != keep.end();
  }
  return passes;
}

} // namespace

TEST(FilterPruning, NodesWithoutAPointThatPassesAreLeftOut)
{
  const SampleStore sample = makeSample(60);
  const std::string path = temporaryPath("a.pfront");
  writeSample(sample, path);
  const auto store = PointStore::open(path);
  ASSERT_TRUE(store) << store.error().what;
  std::size_t left = 0;
  std::size_t out = 0;
  for (const char* text :
    { "classification == 6", "classification != 2", "x > 900", "identity < 3e17", "shift[0] > 5.4",
      "gps_time in {100000}", "classification == 6 and x < 0", "small < -32700",
      "small not in [-32000, 32700]", "z > 1e9", "rgb.g in [100, 100]", "global_height > 0.9",
      "global_height not in [0.05, 0.9]", "global_height > 1", "horizontality <= 0.01",
      "horizontality > 0.99", "horizontality < 0" })
  {
    SCOPED_TRACE(text);
    StyleSheet sheet;
    sheet.where = *FilterExpression::parse(text);
    StoreSurroundings surroundings;
    surroundings.heights = std::make_shared<const ClassHeights>(*store);
    const auto layers = sheet.resolveAll((*store)->description(), surroundings);
    ASSERT_TRUE(layers) << layers.error().what;
    const auto pruning = pruningOf(**store, *layers);
    ASSERT_TRUE(pruning) << pruning.error().what;
    ASSERT_EQ(pruning->size(), 2u);
    ASSERT_TRUE((*pruning)[0]);
    EXPECT_EQ((*pruning)[0], (*pruning)[1]); // equal filters are judged once
    const auto passes = nodesThatPass(sample, layers->front().styles.front()->filter);
    for (NodeIndex i = 0; i < sample.nodes.size(); ++i)
    {
      const Verdict verdict = (*pruning)[0]->of(i);
      EXPECT_TRUE(!passes[i] || verdict == Verdict::Draw) << i;
      for (NodeIndex above = sample.nodes[i].parent; passes[i] && above != noNode;
           above = sample.nodes[above].parent)
      {
        EXPECT_NE((*pruning)[0]->of(above), Verdict::Skip) << above;
      }
      (verdict == Verdict::Draw ? left : out) += 1;
    }
  }
  EXPECT_GT(left, 10u);
  EXPECT_GT(out, 30u);
}

TEST(FilterPruning, OneConditionThatKnowsIsEnough)
{
  const SampleStore sample = makeSample(20);
  const std::string path = temporaryPath("b.pfront");
  writeSample(sample, path);
  const auto store = PointStore::open(path);
  ASSERT_TRUE(store);
  StyleSheet sheet;
  sheet.where = *FilterExpression::parse("classification == 6");
  const auto layers = sheet.resolveAll((*store)->description());
  const auto pruning = pruningOf(**store, *layers);
  ASSERT_TRUE(pruning && (*pruning)[0]);
  // Nodes 5 and 6 alone have class 6; 0 and 2 lie above them.
  const std::vector<Verdict> expected{ Verdict::Descend, Verdict::Skip, Verdict::Descend,
    Verdict::Skip, Verdict::Skip, Verdict::Draw, Verdict::Draw };
  for (NodeIndex i = 0; i < expected.size(); ++i)
  {
    EXPECT_EQ((*pruning)[0]->of(i), expected[i]) << i;
  }
}

TEST(FilterPruning, AStyleWithoutAFilterLeavesNothingOut)
{
  const SampleStore sample = makeSample(20);
  const std::string path = temporaryPath("c.pfront");
  writeSample(sample, path);
  const auto store = PointStore::open(path);
  ASSERT_TRUE(store);
  StyleSheet sheet;
  sheet.classes[6].where = *FilterExpression::parse("x > 0");
  sheet.classes[9].visible = false;
  const auto layers = sheet.resolveAll((*store)->description());
  const auto pruning = pruningOf(**store, *layers);
  ASSERT_TRUE(pruning);
  for (std::size_t l = 0; l < layers->size(); ++l)
  {
    const bool filtered = (*layers)[l].visible() && !(*layers)[l].styles[0]->filter.empty();
    EXPECT_EQ((*pruning)[l] != nullptr, filtered) << l;
  }
}

TEST(FilterPruning, StoresThatKnowNothingOfTheirNodesAreDrawnWhole)
{
  const auto store = PointStore::open(goldenFile("version2.pfront"));
  ASSERT_TRUE(store);
  StyleSheet sheet;
  sheet.where = *FilterExpression::parse("classification == 99");
  const auto layers = sheet.resolveAll((*store)->description());
  ASSERT_TRUE(layers);
  const auto pruning = pruningOf(**store, *layers);
  ASSERT_TRUE(pruning);
  EXPECT_EQ((*pruning)[0], nullptr);
}

} // namespace pointfront
