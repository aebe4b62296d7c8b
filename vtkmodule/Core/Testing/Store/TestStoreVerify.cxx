#include "ForgedStore.h"
#include "SampleStore.h"

#include "pointfront/Store/DescriptionSection.h"
#include "pointfront/Store/NodeTableSection.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace pointfront
{
namespace
{
std::string verifyFault(const std::string& path)
{
  const auto opened = PointStore::open(path);
  EXPECT_TRUE(opened) << opened.error().what;
  if (!opened)
  {
    return {};
  }
  const auto report = (*opened)->verify();
  EXPECT_TRUE(report);
  EXPECT_EQ(report->ok, report->firstError.empty());
  return report->firstError;
}

/// Writes a sample after `change` and gives what verify() says.
template <typename Change>
std::string faultAfter(const Change& change)
{
  SampleStore sample = makeSample(50);
  change(sample);
  const std::string path = temporaryPath("wrong.pfront");
  writeSample(sample, path);
  return verifyFault(path);
}

template <typename Change>
std::string faultOfDescription(const Change& change)
{
  const std::string path = temporaryPath("wrong.pfront");
  writeSample(makeSample(50), path);
  ForgedStore forged(path);
  const std::vector<std::byte> section = forged.section(SectionKind::Description);
  auto stored = decodeDescription(section.data(), section.size());
  EXPECT_TRUE(stored);
  change(*stored);
  forged.replaceSection(SectionKind::Description, encodeDescription(*stored));
  forged.write(path);
  return verifyFault(path);
}

bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}
} // namespace

TEST(StoreVerify, FindsWhatChecksumsCannot)
{
  const auto leaves = [](SampleStore& s) { s.nodes[5].halfSize.x *= 0.9f; };
  EXPECT_TRUE(contains(faultAfter(leaves), "node 5: points lie outside its box"));
  const auto childLeaves = [](SampleStore& s) { s.nodes[5].halfSize.y *= 100.0f; };
  EXPECT_TRUE(contains(faultAfter(childLeaves), "node 5: its box leaves the box of its parent"));
  const auto sphere = [](SampleStore& s) { s.nodes[4].radius *= 0.5f; };
  EXPECT_TRUE(contains(faultAfter(sphere), "outside its sphere"));
  // The sphere of the root holds the points of all below it.
  const auto rootSphere = [](SampleStore& s) { s.nodes[0].radius *= 0.95f; };
  EXPECT_TRUE(contains(faultAfter(rootSphere), "from the centre of node 0"));
  const auto bounds = [](StoredDescription& d) { d.gridBounds.high.z += 1; };
  EXPECT_TRUE(contains(faultOfDescription(bounds), "the bounds are not those of the points"));
  const auto tooNarrow = [](StoredDescription& d)
  { d.description.ranges[0].components[1][1] -= 1.0; };
  EXPECT_TRUE(contains(faultOfDescription(tooNarrow), "'rgb' has values outside"));
  const auto tooWide = [](StoredDescription& d)
  { d.description.ranges[1].components[0][1] += 1.0; };
  EXPECT_TRUE(contains(faultOfDescription(tooWide), "the range of attribute 'intensity'"));
}

TEST(StoreVerify, ReportsProgressAndCanBeCancelled)
{
  const std::string path = temporaryPath("a.pfront");
  writeSample(makeSample(500), path);
  const auto store = PointStore::open(path);
  ASSERT_TRUE(store);
  double last = 0.0;
  const auto report = (*store)->verify(
    [&](const Progress& progress)
    {
      EXPECT_STREQ(progress.phase, "verifying");
      EXPECT_GE(progress.fraction, last);
      EXPECT_EQ(progress.total, 3000u);
      last = progress.fraction;
      return true;
    });
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->ok);
  EXPECT_EQ(last, 1.0);
  const auto cancelled = (*store)->verify([](const Progress&) { return false; });
  ASSERT_FALSE(cancelled);
  EXPECT_EQ(cancelled.error().kind, Error::Kind::Cancelled);
}

TEST(StoreThreads, ReadAtTheSameTime)
{
  const SampleStore sample = makeSample(3000);
  const std::string path = temporaryPath("a.pfront");
  writeSample(sample, path);
  const auto opened = PointStore::open(path);
  ASSERT_TRUE(opened);
  const PointStore& store = **opened;
  const ColumnSelection columns = everyColumn(sample.description.schema);
  std::atomic<int> wrong{ 0 };
  std::vector<std::thread> threads;
  for (unsigned t = 0; t < 4; ++t)
  {
    threads.emplace_back(
      [&, t]
      {
        for (NodeIndex k = 0; k < 4 * sample.nodes.size(); ++k)
        {
          const auto node = static_cast<NodeIndex>((k + t) % sample.nodes.size());
          const auto points = store.read(node, columns);
          const bool same = points && points->positions == sample.points[node].positions &&
            points->columns == sample.points[node].columns;
          wrong += same ? 0 : 1;
        }
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  EXPECT_EQ(wrong, 0);
}

TEST(StoreThreads, EncodingGivesTheSameBytesOnEveryThread)
{
  const SampleStore sample = makeSample(5000);
  const EncodedNode here = encodeNode(sample.points[3], sample.description.schema);
  EncodedNode there;
  std::thread([&] { there = encodeNode(sample.points[3], sample.description.schema); }).join();
  EXPECT_EQ(here.positions.bytes, there.positions.bytes);
  ASSERT_EQ(here.columns.size(), there.columns.size());
  for (std::size_t c = 0; c < here.columns.size(); ++c)
  {
    EXPECT_EQ(here.columns[c].bytes, there.columns[c].bytes);
    EXPECT_EQ(here.columns[c].codec, there.columns[c].codec);
    EXPECT_EQ(here.columns[c].checksum, there.columns[c].checksum);
  }
  EXPECT_EQ(here.bounds, there.bounds);
}

TEST(StoreVerify, NamesTheLowestFaultWhicheverThreadIsFirst)
{
  SampleStore sample = makeSample(50);
  for (const NodeIndex node : { 6u, 5u, 3u })
  {
    sample.nodes[node].halfSize.x *= 0.5f;
  }
  const std::string path = temporaryPath("wrong.pfront");
  writeSample(sample, path);
  for (int run = 0; run < 50; ++run)
  {
    ASSERT_TRUE(contains(verifyFault(path), "node 3: points lie outside its box"));
  }
}

TEST(NodeTable, NamesWhatIsWrong)
{
  const SampleStore sound = makeSample(10);
  const auto faultAfter = [&](const auto& change)
  {
    std::vector<Node> nodes = sound.nodes;
    change(nodes);
    return nodeTableFault(nodes, 2, 60);
  };
  using Nodes = std::vector<Node>;
  EXPECT_EQ(faultAfter([](Nodes&) {}), "");
  EXPECT_NE(nodeTableFault(sound.nodes, 1, 60), ""); // layer 1 is not there
  EXPECT_NE(nodeTableFault(sound.nodes, 2, 61), "");
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(contains(faultAfter([&](Nodes& n) { n[2].radius = nan; }), "node 2"));
  EXPECT_TRUE(contains(faultAfter([&](Nodes& n) { n[2].halfSize.y = -1.0f; }), "node 2"));
  const float infinite = std::numeric_limits<float>::infinity();
  for (const float radius : { nan, -1.0f, infinite })
  {
    EXPECT_TRUE(contains(faultAfter([&](Nodes& n) { n[3].splatRadius = radius; }), "node 3"));
  }
  EXPECT_TRUE(contains(faultAfter([&](Nodes& n) { n[6].centre.z = nan; }), "node 6"));
  EXPECT_TRUE(contains(faultAfter([](Nodes& n) { n[2].parent = 2; }), "another parent"));
  EXPECT_TRUE(contains(faultAfter([](Nodes& n) { n[0].parent = 2; }), "come before"));
  EXPECT_TRUE(contains(faultAfter([](Nodes& n) { n[3].parent = 1; }), "another parent"));
  EXPECT_TRUE(contains(faultAfter([](Nodes& n) { n[3].parent = noNode; }), "another parent"));
  EXPECT_TRUE(contains(faultAfter([](Nodes& n) { n[2].firstChild = 1; }), "outside the table"));
  EXPECT_TRUE(contains(faultAfter([](Nodes& n) { n[2].childCount = 9; }), "outside the table"));
  EXPECT_TRUE(contains(faultAfter([](Nodes& n) { n[6].firstChild = 5; }), "names a first child"));
  EXPECT_TRUE(contains(faultAfter([](Nodes& n) { n[6].level = 3; }), "level"));
  EXPECT_TRUE(contains(faultAfter([](Nodes& n) { n[1].level = 1; }), "not at level 0"));
  EXPECT_TRUE(contains(faultAfter([](Nodes& n) { n[6].layer = 1; }), "layer"));
  EXPECT_TRUE(contains(faultAfter([](Nodes& n) { n[2].pointsBelow += 1; }), "add up"));
  EXPECT_TRUE(contains(faultAfter([](Nodes& n) { n[6].pointsBelow = UINT64_MAX; }), "node 2"));
}

} // namespace pointfront
