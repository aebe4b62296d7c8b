#include "SampleStore.h"

#include <gtest/gtest.h>

namespace pointfront
{
namespace
{
class StoreRoundTrip : public testing::TestWithParam<std::uint32_t>
{
};
} // namespace

TEST_P(StoreRoundTrip, GivesBackEveryBit)
{
  const SampleStore sample = makeSample(GetParam());
  const std::string path = temporaryPath(std::to_string(GetParam()) + ".pfront");
  writeSample(sample, path);
  const auto opened = PointStore::open(path);
  ASSERT_TRUE(opened) << opened.error().what;
  const PointStore& store = **opened;
  const ColumnSelection columns = everyColumn(sample.description.schema);
  ASSERT_EQ(store.hierarchy()->nodeCount(), sample.nodes.size());
  EXPECT_EQ(store.hierarchy()->roots(), sample.roots);
  for (NodeIndex i = 0; i < sample.nodes.size(); ++i)
  {
    const auto points = store.read(i, columns);
    ASSERT_TRUE(points) << points.error().what;
    EXPECT_EQ(points->node, i);
    const Node& row = sample.nodes[i];
    EXPECT_EQ(points->halfSize, row.halfSize);
    EXPECT_EQ(points->spacing, row.spacing);
    EXPECT_EQ(points->splatRadius, row.splatRadius);
    EXPECT_EQ(points->layer, row.layer);
    EXPECT_EQ(points->firstPoint, store.hierarchy()->node(i).firstPoint);
    EXPECT_EQ(points->origin, sample.points[i].origin);
    EXPECT_EQ(points->positions, sample.points[i].positions);
    EXPECT_EQ(points->columns, sample.points[i].columns);
    const auto count = static_cast<std::uint32_t>(points->size());
    EXPECT_EQ(points->bytes(), store.decodedBytes(i, count, columns));
  }
  const auto report = store.verify();
  ASSERT_TRUE(report) << report.error().what;
  EXPECT_TRUE(report->ok) << report->firstError;
  EXPECT_EQ(report->nodesChecked, sample.nodes.size());
  EXPECT_EQ(report->pointsChecked, store.description().pointCount);
}

INSTANTIATE_TEST_SUITE_P(NodeSizes, StoreRoundTrip,
  testing::Values(0u, 1u, 2u, 31u, 32u, 33u, 127u, 128u, 129u, 4096u, 70000u));

TEST(Store, DescribesWhatWasWritten)
{
  const SampleStore sample = makeSample(100);
  const std::string path = temporaryPath("a.pfront");
  writeSample(sample, path);
  const auto opened = PointStore::open(path);
  ASSERT_TRUE(opened) << opened.error().what;
  const StoreDescription& d = (*opened)->description();
  EXPECT_EQ(d.path, path);
  EXPECT_EQ(d.version, 4u);
  EXPECT_EQ(d.splatRadiusBase, 0.25);
  EXPECT_EQ(d.fileBytes, fileBytes(path).size());
  EXPECT_EQ(d.pointCount, 600u);
  EXPECT_EQ(d.grid, sample.description.grid);
  EXPECT_EQ(d.crsWkt, sample.description.crsWkt);
  EXPECT_EQ(d.structure, "octree");
  EXPECT_EQ(d.refinement, Refinement::Add);
  EXPECT_EQ(d.levels, 3u);
  EXPECT_EQ(d.schema, sample.description.schema);
  EXPECT_EQ(d.schema[5].description, "an extra dimension");
  EXPECT_EQ(d.generator, "sample");
  ASSERT_EQ(d.layers.size(), 2u);
  EXPECT_EQ(d.layers[0].name, "ground");
  EXPECT_EQ(d.layers[0].pointCount, 500u);
  EXPECT_EQ(d.layers[0].nodeCount, 5u);
  EXPECT_EQ(d.layers[1].objectClass, 6u);
  EXPECT_EQ(d.layers[1].pointCount, 100u);
  ASSERT_EQ(d.metadata.size(), 2u);
  EXPECT_EQ(d.metadata[0].owner, "LASF_Projection");
  EXPECT_EQ(d.metadata[0].id, 2112u);
  EXPECT_EQ(d.metadata[0].payload, sample.description.metadata[0].payload);
  ASSERT_EQ(d.ranges.size(), d.schema.size());
  EXPECT_EQ(d.ranges[2].components[0], (std::array<double, 2>{ 2.0, 6.0 }));
  EXPECT_EQ(d.ranges[3].components[0], (std::array<double, 2>{ 1e5, 1e5 + 99 * 0.25 }));
  EXPECT_DOUBLE_EQ(d.bounds.low.y, 850070.0);
  EXPECT_DOUBLE_EQ(d.bounds.high.y, 850000.0 + (7000 + 99 * 7) * 0.01);
}

TEST(Store, ReadsOnlyTheColumnsThatAreAskedFor)
{
  const SampleStore sample = makeSample(20000);
  const std::string path = temporaryPath("a.pfront");
  writeSample(sample, path);
  const auto opened = PointStore::open(path);
  ASSERT_TRUE(opened) << opened.error().what;
  const PointStore& store = **opened;
  const ColumnSelection some{ 1, 10 };
  const auto points = store.read(2, some);
  ASSERT_TRUE(points) << points.error().what;
  EXPECT_EQ(points->selection, some);
  ASSERT_EQ(points->columns.size(), 2u);
  EXPECT_EQ(points->columns[0], sample.points[2].columns[1]);
  EXPECT_EQ(points->columns[1], sample.points[2].columns[10]);
  const auto count = static_cast<std::uint32_t>(points->size());
  EXPECT_EQ(points->bytes(), store.decodedBytes(2, count, some));
  const ColumnSelection all = everyColumn(sample.description.schema);
  EXPECT_LT(store.storedBytes(2, {}), store.storedBytes(2, some));
  EXPECT_LT(store.storedBytes(2, some), store.storedBytes(2, all));
}

TEST(Store, SameInputGivesTheSameBytes)
{
  const SampleStore sample = makeSample(3000);
  writeSample(sample, temporaryPath("a.pfront"));
  writeSample(makeSample(3000), temporaryPath("b.pfront"));
  EXPECT_EQ(fileBytes(temporaryPath("a.pfront")), fileBytes(temporaryPath("b.pfront")));
}

} // namespace pointfront
