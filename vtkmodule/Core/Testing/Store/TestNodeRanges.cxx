#include "SampleStore.h"

#include "pointfront/Disk/InputFile.h"
#include "pointfront/Store/ColumnStatistics.h"
#include "pointfront/Store/NodeRangesSection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>

namespace pointfront
{
namespace
{

bool within(const ValueRange& inner, const ValueRange& outer)
{
  return inner.empty() || (outer.low <= inner.low && inner.high <= outer.high);
}

ValueRange valuesOf(const SampleStore& sample, NodeIndex node, std::uint32_t column, std::size_t c)
{
  const NodeColumns& points = sample.points[node];
  const auto range =
    rangeOf(points.columns[column].data(), sample.description.schema[column], points.size());
  return { range.components[c][0], range.components[c][1] };
}

/// One root with `count` leaves below it; leaf i holds one value, `valueOf(i)`.
template <typename ValueOf>
std::shared_ptr<const NodeRanges> rangesOfLeaves(
  NodeIndex count, ValueOf valueOf, const std::string& path)
{
  AttributeSchema schema;
  schema.add({ "value", ScalarType::Float64, 1 });
  NodeRangesWriter writer(schema);
  std::vector<Node> nodes(1);
  std::vector<std::uint32_t> payloads;
  for (NodeIndex i = 0; i <= count; ++i)
  {
    EncodedNode node;
    const double value = i == 0 ? 0.0 : valueOf(i - 1);
    ColumnRange range = emptyRange(schema[0]);
    if (i > 0)
    {
      range.components[0] = { value, value };
      nodes.emplace_back();
      nodes.back().parent = 0;
    }
    node.ranges = { range };
    writer.add(node.bounds, node.ranges);
    payloads.push_back(i);
  }
  const std::vector<std::byte> bytes = writer.encode(nodes, payloads);
  writeFile(path, bytes);
  auto file = InputFile::open(path);
  EXPECT_TRUE(file);
  const SectionEntry section{ SectionKind::NodeRanges, 0, 0, bytes.size() };
  const NodeRangesFile stored(std::move(*file), section, count + 1, rangeComponents(schema));
  const auto ranges = stored.read(rangeComponent(schema, 0, 0), noNode);
  EXPECT_TRUE(ranges) << (ranges ? "" : ranges.error().what);
  return ranges ? *ranges : nullptr;
}

} // namespace

TEST(NodeRanges, AStoreKnowsTheValuesOfEachNodeAndOfAllBelow)
{
  const SampleStore sample = makeSample(50);
  const std::string path = temporaryPath("a.pfront");
  writeSample(sample, path);
  const auto store = PointStore::open(path);
  ASSERT_TRUE(store) << store.error().what;
  const AttributeSchema& schema = sample.description.schema;
  for (std::uint32_t column = 0; column < schema.size(); ++column)
  {
    for (std::uint32_t c = 0; c < schema[column].components; ++c)
    {
      const auto read = (*store)->nodeRanges(rangeComponent(schema, column, c));
      ASSERT_TRUE(read && *read);
      const NodeRanges& ranges = **read;
      ASSERT_EQ(ranges.nodeCount(), sample.nodes.size());
      for (NodeIndex i = 0; i < sample.nodes.size(); ++i)
      {
        const ValueRange own = valuesOf(sample, i, column, c);
        // Seven nodes have fewer bounds than there are marks: nothing is rounded.
        EXPECT_EQ(ranges.own(i).empty(), own.empty());
        if (!own.empty())
        {
          EXPECT_EQ(ranges.own(i).low, own.low) << schema[column].name << ' ' << i;
          EXPECT_EQ(ranges.own(i).high, own.high) << schema[column].name << ' ' << i;
        }
        for (NodeIndex above = i; above != noNode; above = sample.nodes[above].parent)
        {
          EXPECT_TRUE(within(own, ranges.below(above)));
        }
      }
    }
  }
  const auto x = (*store)->nodeRanges(0);
  ASSERT_TRUE(x && *x);
  EXPECT_TRUE((*x)->own(1).empty()); // it has no points of its own
  EXPECT_FALSE((*x)->below(1).empty());
  EXPECT_EQ((*x)->own(5).low,
    static_cast<double>(sample.points[5].origin.x) +
      std::min_element(sample.points[5].positions.begin(), sample.points[5].positions.end(),
        [](const auto& a, const auto& b) { return a.x < b.x; })
        ->x);
}

TEST(NodeRanges, ManyValuesAreRoundedOutwards)
{
  constexpr unsigned seed = 3;
  constexpr NodeIndex leaves = 40000; // more than one chunk of codes, and more than are sampled
  std::mt19937_64 random(seed);
  std::vector<double> values;
  for (NodeIndex i = 0; i < leaves; ++i)
  {
    // Two strips of a flight, and one point in a thousand without a time.
    values.push_back(i % 1000 == 0 ? 0.0 : 3e8 + double(i % 2) * 1e4 + double(random() % 1000));
  }
  const auto ranges = rangesOfLeaves(
    leaves, [&](NodeIndex i) { return values[i]; }, temporaryPath("many"));
  ASSERT_TRUE(ranges);
  double widest = 0.0;
  for (NodeIndex i = 0; i < leaves; ++i)
  {
    const ValueRange own = ranges->own(i + 1);
    ASSERT_TRUE(within({ values[i], values[i] }, own)) << i << " seed " << seed;
    ASSERT_TRUE(within(own, ranges->below(0)));
    widest = values[i] > 0.0 ? std::max(widest, own.high - own.low) : widest;
  }
  // 256 marks over 2,000 values: outliers and the gap between strips cost the others nothing.
  EXPECT_LT(widest, 40.0);
  EXPECT_TRUE(ranges->own(0).empty());
}

TEST(NodeRanges, MoreNodesThanAreSampledAreRoundedOutwardsToo)
{
  constexpr NodeIndex leaves = 600000;
  const auto valueOf = [](NodeIndex i) { return double(i % 2) * 1e6 + double(i % 977); };
  const auto ranges = rangesOfLeaves(leaves, valueOf, temporaryPath("sampled"));
  ASSERT_TRUE(ranges);
  for (NodeIndex i = 0; i < leaves; ++i)
  {
    const ValueRange own = ranges->own(i + 1);
    ASSERT_TRUE(within({ valueOf(i), valueOf(i) }, own)) << i;
    ASSERT_LT(own.high - own.low, 40.0) << i;
  }
}

TEST(NodeRanges, OneValueEverywhereTakesNoCodes)
{
  const auto ranges = rangesOfLeaves(
    20000, [](NodeIndex) { return 7.0; }, temporaryPath("constant"));
  ASSERT_TRUE(ranges);
  EXPECT_TRUE(ranges->own(0).empty()); // a node without points is told from the others
  EXPECT_EQ(ranges->own(1).low, 7.0);
  EXPECT_EQ(ranges->below(0).high, 7.0);
}

TEST(NodeRanges, OnlyTheFirstNodesAreReadWhereThatIsEnough)
{
  const std::string path = temporaryPath("part");
  ASSERT_TRUE(rangesOfLeaves(
    40000, [](NodeIndex i) { return double(i); }, path));
  AttributeSchema schema;
  schema.add({ "value", ScalarType::Float64, 1 });
  auto file = InputFile::open(path);
  ASSERT_TRUE(file);
  const std::uint64_t bytes = (*file)->bytes();
  const NodeRangesFile stored(
    std::move(*file), { SectionKind::NodeRanges, 0, 0, bytes }, 40001, rangeComponents(schema));
  const auto ranges = stored.read(rangeComponent(schema, 0, 0), 5);
  ASSERT_TRUE(ranges);
  EXPECT_GE((*ranges)->nodeCount(), 5u);
  EXPECT_LT((*ranges)->nodeCount(), 40001u);
}

} // namespace pointfront
