#include "CountedBytes.h"
#include "GoldenFiles.h"
#include "SampleStore.h"

#include "pointfront/Collection/PayloadCopy.h"
#include "pointfront/Payload/ColumnPieces.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace pointfront
{
namespace
{
/// The sample with some of its columns.
SampleStore sampleWith(std::uint32_t pointsPerNode, const ColumnSelection& columns)
{
  SampleStore sample = makeSample(pointsPerNode);
  AttributeSchema schema;
  for (const std::uint32_t c : columns)
  {
    schema.add(sample.description.schema[c]);
  }
  for (NodeColumns& points : sample.points)
  {
    std::vector<std::vector<std::byte>> kept;
    for (const std::uint32_t c : columns)
    {
      kept.push_back(std::move(points.columns[c]));
    }
    points.columns = std::move(kept);
    points.selection = everyColumn(schema);
  }
  sample.description.schema = std::move(schema);
  return sample;
}

void expectAllPoints(const PointStore& store, const SampleStore& sample)
{
  for (NodeIndex n = 0; n < sample.nodes.size(); ++n)
  {
    const auto points = store.read(n, everyColumn(sample.description.schema));
    ASSERT_TRUE(points) << points.error().what;
    EXPECT_EQ(points->positions, sample.points[n].positions);
    EXPECT_EQ(points->columns, sample.points[n].columns);
  }
  const auto report = store.verify();
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->ok) << report->firstError;
}

std::shared_ptr<const PointStore> storeOf(const SampleStore& sample)
{
  const std::string path = temporaryPath("pieces.pfront");
  writeSample(sample, path);
  const auto store = PointStore::open(path);
  EXPECT_TRUE(store) << store.error().what;
  return store ? *store : nullptr;
}

/// Reads of a node beside that of its record.
std::size_t readsOf(const PointStore& store, NodeIndex node)
{
  const auto fetched = store.fetch(node, everyColumn(store.description().schema));
  EXPECT_TRUE(fetched);
  return fetched ? fetched->runs.size() - 1 : 0;
}

const ColumnSelection drawn{ 0, 2, 4 }; // rgb, classification, normal
const ColumnSelection others{ 1, 3, 5, 6, 7, 8, 9, 10, 11 };
} // namespace

TEST(ColumnPieces, PutWhatPicturesMostlyWantInTheFirst)
{
  AttributeSchema schema;
  for (const char* const name :
    { "gps_time", "RGB", "intensity", "nir", "Classification", "normal", "splat_radius" })
  {
    schema.add({ name });
  }
  EXPECT_EQ(chooseColumnPieces(schema), (ColumnPieces{ 1, 0, 1, 1, 0, 0, 0 }));
  AttributeSchema grey;
  grey.add({ "gps_time" });
  grey.add({ "Intensity" });
  EXPECT_EQ(chooseColumnPieces(grey), (ColumnPieces{ 1, 0 }));
  EXPECT_TRUE(chooseColumnPieces({}).empty());
}

TEST(StorePieces, FirstOnesLieSideBySide)
{
  const SampleStore sample = makeSample(10000); // 3 MB
  const std::string path = temporaryPath("pieces.pfront");
  writeSample(sample, path);
  const auto line = CountedBytes::add();
  const auto near = PointStore::open(path);
  const auto far = PointStore::open(CountedBytes::addressOf(path));
  ASSERT_TRUE(near && far);
  expectAllPoints(**near, sample);
  std::vector<WantedNode> wanted;
  std::uint64_t needed = 0;
  for (NodeIndex n = 0; n < sample.nodes.size(); ++n)
  {
    wanted.push_back({ n, drawn });
    needed += (*near)->storedBytes(n, drawn);
  }
  EXPECT_EQ(readsOf(**near, 0), 2u);
  EXPECT_EQ(readsOf(**near, 1), 1u); // it is empty
  line->reset();
  for (const auto& fetched : (*far)->fetchAll(wanted, ReadStop{ false }))
  {
    ASSERT_TRUE(fetched) << fetched.error().what;
  }
  EXPECT_GE(line->bytes, needed);
  const std::uint64_t records = line->bytes - needed;
  EXPECT_LT(records, 2000u);
  // A run of second pieces ends after a MiB at most; the nodes' records are one request.
  const std::uint64_t all = fileBytes(path).size();
  EXPECT_LE(line->requests, 1 + (all - needed) / (PayloadPlaces::runBytes * 3 / 4) + 1);
  EXPECT_GT(all - needed, PayloadPlaces::runBytes) << "the sample is too small for two runs";
}

TEST(StorePieces, WithoutOtherColumnsThereIsOne)
{
  const SampleStore sample = sampleWith(5000, drawn);
  const auto store = storeOf(sample);
  ASSERT_TRUE(store);
  expectAllPoints(*store, sample);
  std::size_t bytes = 0;
  for (NodeIndex n = 0; n < sample.nodes.size(); ++n)
  {
    EXPECT_EQ(readsOf(*store, n), 1u);
    EXPECT_EQ(store->storedBytes(n, everyColumn(sample.description.schema)),
      encodeNode(sample.points[n], sample.description.schema).bytes());
    bytes += store->storedBytes(n, everyColumn(sample.description.schema));
  }
  EXPECT_LT(fileBytes(store->description().path).size() - bytes, 8000u);
}

TEST(StorePieces, MayHaveAllColumnsInTheSecond)
{
  const SampleStore sample = sampleWith(5000, others);
  const auto store = storeOf(sample);
  ASSERT_TRUE(store);
  expectAllPoints(*store, sample);
  EXPECT_EQ(readsOf(*store, 0), 2u);
}

TEST(StorePieces, OfAStoreWithoutColumnsAreOne)
{
  const SampleStore sample = sampleWith(100, {});
  const auto store = storeOf(sample);
  ASSERT_TRUE(store);
  expectAllPoints(*store, sample);
  EXPECT_EQ(readsOf(*store, 0), 1u);
}

TEST(StorePieces, OfOneNodeAreThere)
{
  for (const std::uint32_t points : { 0u, 1u, 200000u }) // 7 MB: no run waits for it
  {
    SampleStore sample = makeSample(points);
    sample.nodes = { sample.nodes[6] };
    sample.nodes[0].parent = noNode;
    sample.nodes[0].level = 0;
    sample.points = { sample.points[6] };
    sample.roots = { 0 };
    const auto store = storeOf(sample);
    ASSERT_TRUE(store);
    expectAllPoints(*store, sample);
  }
}

/// Whoever takes a payload as it lies in an older store, or in one of these, writes two pieces.
TEST(StorePieces, OfCopiedPayloadsAreThoseOfWrittenOnes)
{
  const SampleStore sample = makeSample(260);
  const AttributeSchema& schema = sample.description.schema;
  for (const char* const name : { "version1-all-codecs.pfront", "version2-all-codecs.pfront",
         "version3-all-codecs.pfront", "version4-all-codecs.pfront" })
  {
    const auto from = PointStore::open(goldenFile(name));
    ASSERT_TRUE(from) << from.error().what;
    PayloadCopy copy(**from);
    const std::string path = temporaryPath(name);
    const auto writer = StoreWriter::create(path, schema);
    ASSERT_TRUE(writer);
    std::vector<StoreWriter::PayloadId> payloads;
    for (NodeIndex n = 0; n < sample.nodes.size(); ++n)
    {
      const auto payload = copy.of(n, sample.nodes[n].pointCount);
      ASSERT_TRUE(payload) << payload.error().what;
      const EncodedNode facts = encodeNode(sample.points[n], schema);
      payloads.push_back((*writer)->append(*payload, facts.bounds, facts.ranges).value());
    }
    ASSERT_TRUE((*writer)->commit(sample.description, sample.nodes, sample.roots, payloads));
    const auto store = PointStore::open(path);
    ASSERT_TRUE(store) << store.error().what;
    EXPECT_EQ((*store)->description().version, 4u);
    expectAllPoints(**store, sample);
    EXPECT_EQ(readsOf(**store, 3), 2u);
  }
}

} // namespace pointfront
