#include "pointfront/Export/StoreExport.h"

#include <gtest/gtest.h>

namespace pointfront
{

namespace
{

/// A made-up store, grid 0.5, one column "classification":
///
///                 0  x 0..30, spacing 8, 2 points: x = 0 (class 2), 30 (class 6)
///              /     \                                                              .
///   x 0..10  1        2  x 20..30, spacing 4, 1 point: x = 20 (class 2)
///  spacing 4            \                                                           .
///  x = 10 (class 6)      3  x 25..25, spacing 2, 1 point: x = 25 (class 9)
class MadeUpStore final : public NodeReader
{
public:
  MadeUpStore()
  {
    description.path = "made-up";
    description.grid.scale = glm::dvec3(0.5);
    description.pointCount = 5;
    description.bounds = Bounds{ glm::dvec3(0.0), glm::dvec3(30.0, 0.0, 0.0) };
    Attribute classification;
    classification.name = "classification";
    description.schema.add(classification);
    description.ranges = { ColumnRange{ { { 2.0, 9.0 } } } };
    nodes = { node(0, 30, 8, 2, 1, 2), node(0, 10, 4, 1, noNode, 0), node(20, 30, 4, 1, 3, 1),
      node(25, 25, 2, 1, noNode, 0) };
    nodes[1].parent = nodes[2].parent = 0;
    nodes[3].parent = 2;
  }

  Result<NodeColumns> decode(const FetchedNode& fetched) const override
  {
    const NodeIndex index = fetched.node;
    const ColumnSelection& columns = fetched.columns;
    if (index == broken)
    {
      return makeError(Error::Kind::Corrupt, "node is broken");
    }
    struct Point
    {
      std::uint32_t x;
      std::uint8_t code;
    };
    static const std::vector<std::vector<Point>> points = { { { 0, 2 }, { 30, 6 } }, { { 10, 6 } },
      { { 20, 2 } }, { { 25, 9 } } };
    NodeColumns out;
    out.node = index;
    out.selection = columns;
    out.columns.resize(columns.size());
    for (const Point& point : points[index])
    {
      out.positions.emplace_back(2 * point.x, 0u, 0u);
      out.columns[0].push_back(std::byte{ point.code });
    }
    return out;
  }
  std::size_t decodedBytes(NodeIndex, std::uint32_t, const ColumnSelection&) const override
  {
    return 0;
  }
  std::size_t storedBytes(NodeIndex, const ColumnSelection&) const override { return 0; }

  HierarchyTable hierarchy() const { return HierarchyTable(nodes, { 0 }, Refinement::Add); }

  StoreDescription description;
  std::vector<Node> nodes;
  NodeIndex broken = noNode;

private:
  static Node node(double low, double high, float spacing, std::uint32_t points,
    NodeIndex firstChild, std::uint8_t children)
  {
    Node n;
    n.centre = { 0.5 * (low + high), 0.0, 0.0 };
    n.halfSize = { static_cast<float>(0.5 * (high - low)), 0.0f, 0.0f };
    n.spacing = spacing;
    n.pointCount = points;
    n.firstChild = firstChild;
    n.childCount = children;
    return n;
  }
};

class RecordingSink final : public PointSink
{
public:
  Result<void> begin(const SinkDescription& description) override
  {
    begun = description;
    return {};
  }
  Result<void> append(const PointBatch& batch) override
  {
    for (std::size_t i = 0; i < batch.size(); ++i)
    {
      x.push_back(batch.positions[i].x);
      classes.push_back(std::to_integer<int>(batch.columns[0][i]));
    }
    return full ? Result<void>(makeError(Error::Kind::Unwritable, "disk full")) : Result<void>();
  }
  Result<void> finish() override
  {
    finished = true;
    return {};
  }

  SinkDescription begun;
  std::vector<double> x;
  std::vector<int> classes;
  bool full = false;
  bool finished = false;
};

Result<ExportReport> exportMadeUp(const MadeUpStore& store, const ExportSelection& selection,
  RecordingSink& sink, const ProgressFunction& progress = {})
{
  return exportPoints(store.description, store.hierarchy(), store, selection, sink, progress);
}

} // namespace

/// A format that holds the largest value that was seen might not hold the next.
TEST(StoreExport, OfSampledRangesExpectsWhatTheTypeHolds)
{
  MadeUpStore store;
  store.description.rangesAreSampled = true;
  RecordingSink sink;
  ASSERT_TRUE(exportMadeUp(store, {}, sink));
  EXPECT_EQ(sink.begun.largest, std::vector<double>{ 255.0 });
}

TEST(StoreExport, GivesEveryPointOnceInTheOrderOfTheNodes)
{
  const MadeUpStore store;
  RecordingSink sink;
  const auto report = exportMadeUp(store, {}, sink);
  ASSERT_TRUE(report);
  EXPECT_EQ(report.value().pointsWritten, 5u);
  EXPECT_EQ(sink.x, (std::vector<double>{ 0.0, 30.0, 10.0, 20.0, 25.0 }));
  EXPECT_EQ(sink.classes, (std::vector<int>{ 2, 6, 6, 2, 9 }));
  EXPECT_EQ(sink.begun.pointCount, 5u);
  EXPECT_EQ(sink.begun.largest, std::vector<double>{ 9.0 });
  EXPECT_TRUE(sink.finished);
}

TEST(StoreExport, BoxIsClosedAndSkipsNodesOutside)
{
  const MadeUpStore store;
  RecordingSink sink;
  ExportSelection selection;
  selection.box = Bounds{ glm::dvec3(20.0, -1.0, -1.0), glm::dvec3(25.0, 1.0, 1.0) };
  const auto report = exportMadeUp(store, selection, sink);
  ASSERT_TRUE(report);
  EXPECT_EQ(sink.x, (std::vector<double>{ 20.0, 25.0 }));
  EXPECT_EQ(report.value().pointsRead, 4u); // node 1 was not decoded
  EXPECT_EQ(sink.begun.pointCount, 0u); // not known before
}

TEST(StoreExport, KeepsTheClassesAskedFor)
{
  const MadeUpStore store;
  RecordingSink sink;
  ExportSelection selection;
  selection.classes = { 6, 9 };
  ASSERT_TRUE(exportMadeUp(store, selection, sink));
  EXPECT_EQ(sink.x, (std::vector<double>{ 30.0, 10.0, 25.0 }));
}

TEST(StoreExport, SpacingStopsAtTheFirstLevelThatIsDenseEnough)
{
  const MadeUpStore store;
  const std::vector<std::pair<double, std::size_t>> cases = { { 100.0, 2 }, { 8.0, 2 }, { 7.9, 4 },
    { 4.0, 4 }, { 3.0, 5 }, { 0.0, 5 } };
  for (const auto& [spacing, points] : cases)
  {
    RecordingSink sink;
    ExportSelection selection;
    selection.spacing = spacing;
    ASSERT_TRUE(exportMadeUp(store, selection, sink));
    EXPECT_EQ(sink.x.size(), points) << "spacing " << spacing;
  }
}

TEST(StoreExport, ClassesWithoutClassificationAreAnError)
{
  MadeUpStore store;
  store.description.schema = AttributeSchema();
  RecordingSink sink;
  ExportSelection selection;
  selection.classes = { 2 };
  const auto report = exportMadeUp(store, selection, sink);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().kind, Error::Kind::BadArgument);
}

TEST(StoreExport, ErrorsOfReaderAndSinkComeThrough)
{
  MadeUpStore store;
  RecordingSink full;
  full.full = true;
  const auto unwritable = exportMadeUp(store, {}, full);
  ASSERT_FALSE(unwritable);
  EXPECT_EQ(unwritable.error().kind, Error::Kind::Unwritable);
  EXPECT_FALSE(full.finished);

  store.broken = 2;
  RecordingSink sink;
  const auto corrupt = exportMadeUp(store, {}, sink);
  ASSERT_FALSE(corrupt);
  EXPECT_EQ(corrupt.error().kind, Error::Kind::Corrupt);
  EXPECT_FALSE(sink.finished);
}

} // namespace pointfront
