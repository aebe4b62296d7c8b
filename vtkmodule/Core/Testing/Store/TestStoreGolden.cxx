#include "GoldenFiles.h"
#include "SampleStore.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

namespace pointfront
{
namespace
{
// Two stores of each version, kept for ever. A change of the format gets a new version and new
// files; these stay, and stay readable. (POINTFRONT_WRITE_GOLDEN=FOLDER writes the newest there.)
const std::string smallFile = "version4.pfront";
const std::string largeFile = "version4-all-codecs.pfront";
constexpr std::uint32_t smallPoints = 3;
constexpr std::uint32_t largePoints = 260;

void expectSample(const std::string& path, const SampleStore& sample, std::uint32_t version)
{
  const auto opened = PointStore::open(path);
  ASSERT_TRUE(opened) << opened.error().what;
  const PointStore& store = **opened;
  ASSERT_EQ(store.description().version, version);
  // Older ones know nothing of splats.
  ASSERT_EQ(
    store.description().splatRadiusBase, version < 3 ? 0.0 : sample.description.splatRadiusBase);
  ASSERT_EQ(store.description().levels, 3u);
  ASSERT_EQ(store.description().layers[0].nodeCount, 5u);
  ASSERT_EQ(store.description().layers[1].pointCount, sample.nodes[4].pointCount);
  ASSERT_EQ(store.hierarchy()->roots(), sample.roots);
  ASSERT_EQ(store.description().schema, sample.description.schema);
  ASSERT_EQ(store.description().grid, sample.description.grid);
  ASSERT_EQ(store.hierarchy()->nodeCount(), sample.nodes.size());
  std::uint64_t number = 0;
  for (NodeIndex i = 0; i < sample.nodes.size(); ++i)
  {
    ASSERT_EQ(store.hierarchy()->node(i).firstPoint, number);
    number += sample.nodes[i].pointCount;
    const auto points = store.read(i, everyColumn(sample.description.schema));
    ASSERT_TRUE(points) << points.error().what;
    ASSERT_EQ(points->splatRadius, version < 3 ? 0.0f : sample.nodes[i].splatRadius);
    ASSERT_EQ(points->spacing, sample.nodes[i].spacing);
    ASSERT_EQ(points->layer, sample.nodes[i].layer);
    ASSERT_EQ(points->origin, sample.points[i].origin);
    ASSERT_EQ(points->positions, sample.points[i].positions);
    ASSERT_EQ(points->columns, sample.points[i].columns);
  }
  const auto report = store.verify();
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->ok) << report->firstError;
}
} // namespace

TEST(StoreGolden, EveryVersionStaysReadable)
{
  expectSample(goldenFile("version1.pfront"), makeSample(smallPoints), 1);
  expectSample(goldenFile("version1-all-codecs.pfront"), makeSample(largePoints), 1);
  expectSample(goldenFile("version2.pfront"), makeSample(smallPoints), 2);
  expectSample(goldenFile("version2-all-codecs.pfront"), makeSample(largePoints), 2);
  expectSample(goldenFile("version3.pfront"), makeSample(smallPoints), 3);
  expectSample(goldenFile("version3-all-codecs.pfront"), makeSample(largePoints), 3);
  expectSample(goldenFile(smallFile), makeSample(smallPoints), 4);
  expectSample(goldenFile(largeFile), makeSample(largePoints), 4);
}

TEST(StoreGolden, TheLargeOneHasEveryCodec)
{
  const SampleStore sample = makeSample(largePoints);
  std::set<std::uint8_t> codecs;
  for (const NodeColumns& points : sample.points)
  {
    const EncodedNode node = encodeNode(points, sample.description.schema);
    codecs.insert(node.positions.codec);
    for (const EncodedNode::Block& column : node.columns)
    {
      codecs.insert(column.codec);
    }
  }
  EXPECT_EQ(codecs, (std::set<std::uint8_t>{ 0, 1, 2, 3 }));
}

// Only the small one: Zstandard may compress differently in another release.
TEST(StoreGolden, TheFormatHasNotChanged)
{
  const std::string path = temporaryPath("a.pfront");
  writeSample(makeSample(smallPoints), path);
  EXPECT_TRUE(fileBytes(path) == fileBytes(goldenFile(smallFile)))
    << "what is written now differs from version 4: give the format a new version";
  if (const char* folder = std::getenv("POINTFRONT_WRITE_GOLDEN"))
  {
    writeSample(makeSample(smallPoints), std::string(folder) + "/" + smallFile);
    writeSample(makeSample(largePoints), std::string(folder) + "/" + largeFile);
  }
}

} // namespace pointfront
