// A table that is read by pages: the same rows, a bounded memory, no waiting where none is allowed,
// and damage that is met late.

#include "ForgedStore.h"
#include "FrontScene.h"
#include "SampleStore.h"
#include "TerrainPages.h"

#include "pointfront/Front/RenderFront.h"
#include "pointfront/Store/NodeTableSection.h"

#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <new>
#include <random>
#include <thread>

namespace pointfront
{
namespace
{
using test::Terrain;
using test::TerrainPages;
using test::terrainTable;

constexpr std::size_t smallCache = 12 * sizeof(NodePage);

bool sameRow(const Node& a, const Node& b)
{
  return a.centre == b.centre && a.halfSize == b.halfSize && a.radius == b.radius &&
    a.spacing == b.spacing && a.splatRadius == b.splatRadius && a.pointCount == b.pointCount &&
    a.pointsBelow == b.pointsBelow && a.firstPoint == b.firstPoint && a.parent == b.parent &&
    a.firstChild == b.firstChild && a.childCount == b.childCount && a.level == b.level &&
    a.layer == b.layer;
}

/// Pages of a terrain, some of which cannot be read, or only when the test says so.
class TrickyPages final : public NodePageSource
{
public:
  explicit TrickyPages(int levels)
    : pages_(levels)
  {
  }
  NodeIndex nodeCount() const override { return pages_.nodeCount(); }
  Result<void> read(std::uint32_t page, NodePage& rows) const override
  {
    std::unique_lock<std::mutex> lock(mutex_);
    ++reads;
    open_.wait(lock, [&] { return !held_; });
    if (throws > 0)
    {
      --throws;
      throw std::bad_alloc();
    }
    if (page == damaged)
    {
      return makeError(Error::Kind::Corrupt, "page " + std::to_string(page) + " is damaged");
    }
    Result<void> done = pages_.read(page, rows);
    if (page == denying)
    {
      rows[7].parent += 1;
    }
    return done;
  }
  void hold(bool held)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    held_ = held;
    open_.notify_all();
  }

  std::uint32_t damaged = 0xffffffffu;
  std::uint32_t denying = 0xffffffffu; ///< its row 7 names another parent
  mutable int reads = 0;
  mutable int throws = 0; ///< so many reads find no memory

private:
  TerrainPages pages_;
  mutable std::mutex mutex_;
  mutable std::condition_variable open_;
  bool held_ = false;
};

/// A view down on the whole terrain.
View overview()
{
  const double s = Terrain::sizeMetres;
  return View::perspective(
    { 0.5 * s, 0.5 * s, s }, { 0.5 * s, 0.51 * s, 0 }, { 0, 0, 1 }, 0.9, 1.0, 1e7, 800, 600);
}

FrontLimits limitsOf(double errorPx)
{
  FrontLimits limits;
  limits.targetErrorPx = errorPx;
  limits.movesPerFrame = 100000;
  return limits;
}
} // namespace

TEST(NodePage, RowsComeBack)
{
  const Terrain terrain(6);
  NodePage rows;
  for (std::uint32_t r = 0; r < nodePageRows; ++r)
  {
    rows[r] = terrain.row(60 + r);
  }
  std::vector<std::byte> bytes(nodePageBytes);
  encodeNodePage(rows.data(), nodePageRows, 1, bytes.data());
  NodePage read;
  const TableLimits limits{ terrain.nodeCount(), 1 };
  ASSERT_EQ(decodeNodePage(bytes.data(), 1, limits, read), "");
  for (std::uint32_t r = 0; r < nodePageRows; ++r)
  {
    EXPECT_TRUE(sameRow(read[r], rows[r])) << r;
  }
  EXPECT_NE(
    decodeNodePage(bytes.data(), 2, limits, read).find("number 1 instead of 2"), std::string::npos);
  for (std::size_t at = 0; at < bytes.size(); at += 37)
  {
    bytes[at] ^= std::byte(4);
    EXPECT_NE(decodeNodePage(bytes.data(), 1, limits, read).find("checksum"), std::string::npos);
    bytes[at] ^= std::byte(4);
  }
}

TEST(PagedNodeTable, HasTheRowsOfTheSource)
{
  const Terrain terrain(8);
  const auto table = terrainTable(8, smallCache);
  ASSERT_EQ(table->nodeCount(), terrain.nodeCount());
  std::mt19937 random(5);
  for (int i = 0; i < 20000; ++i)
  {
    const auto index = static_cast<NodeIndex>(random() % terrain.nodeCount());
    ASSERT_TRUE(sameRow(table->node(index), terrain.row(index))) << index;
  }
  EXPECT_EQ(nodeTableFault(*table, 1, std::uint64_t(terrain.nodeCount()) * 10000), "");
  EXPECT_FALSE(table->fault());
}

TEST(PagedNodeTable, HoldsNoMoreThanItsCache)
{
  const auto table = terrainTable(14, std::size_t(1) << 20); // 9 * 10^7 nodes
  std::mt19937 random(6);
  for (int i = 0; i < 5000; ++i)
  {
    table->node(static_cast<NodeIndex>(random() % table->nodeCount()));
  }
  EXPECT_GT(table->pagesRead(), 4000u);
  EXPECT_LE(table->cachedBytes(), std::size_t(1) << 20);
  EXPECT_GT(table->cachedBytes(), std::size_t(1) << 19);
}

TEST(PagedNodeTable, RowsOfThePagesUsedLastAreNotReadAgain)
{
  const auto table = terrainTable(8, smallCache);
  for (int round = 0; round < 3; ++round)
  {
    for (std::uint32_t page = 0; page < 12; ++page)
    {
      table->node(page * nodePageRows + static_cast<NodeIndex>(round));
    }
  }
  EXPECT_EQ(table->pagesRead(), 12u);
  table->node(12 * nodePageRows); // in the place of page 0, which was used before the others
  table->node(1 * nodePageRows);
  EXPECT_EQ(table->pagesRead(), 13u);
  table->node(0);
  EXPECT_EQ(table->pagesRead(), 14u);
}

TEST(PagedNodeTable, PeekingDoesNotWait)
{
  auto source = std::make_unique<TrickyPages>(6);
  TrickyPages& pages = *source;
  const PagedNodeTable table(std::move(source), { 0 }, Refinement::Add);
  pages.hold(true);
  Node row;
  EXPECT_EQ(table.peek(100, row), RowState::Coming); // returns although nobody can read
  EXPECT_EQ(table.peek(101, row), RowState::Coming);
  EXPECT_EQ(table.arrivals(), 0u);
  pages.hold(false);
  table.waitForArrival(0);
  EXPECT_EQ(table.arrivals(), 1u);
  ASSERT_EQ(table.peek(100, row), RowState::Here);
  EXPECT_TRUE(sameRow(row, Terrain(6).row(100)));
  EXPECT_EQ(pages.reads, 1) << "two rows of one page";
  table.waitForArrival(1); // nothing is coming: returns
}

/// Who retries for ever has a program that hangs.
TEST(PagedNodeTable, APageThatFindsNoMemoryIsLostAndToldAndNobodyWaits)
{
  auto source = std::make_unique<TrickyPages>(6);
  TrickyPages& pages = *source;
  const PagedNodeTable table(std::move(source), { 0 }, Refinement::Add);
  Node row;
  pages.throws = 1;
  EXPECT_EQ(table.peek(100, row), RowState::Coming);
  table.missingRows()->readNext();
  EXPECT_FALSE(table.missingRows()->waiting());
  table.waitForArrival(1); // nothing is coming: returns
  EXPECT_EQ(table.peek(100, row), RowState::Lost);
  ASSERT_TRUE(table.fault());
  EXPECT_EQ(table.fault()->kind, Error::Kind::NoMemory);
}

TEST(PagedNodeTable, ADamagedPageIsLostAndReportedOnce)
{
  auto source = std::make_unique<TrickyPages>(6);
  source->damaged = 2;
  TrickyPages& pages = *source;
  const PagedNodeTable table(std::move(source), { 0 }, Refinement::Add);
  EXPECT_FALSE(table.fault());
  for (int i = 0; i < 3; ++i)
  {
    const Node row = table.node(130);
    EXPECT_EQ(row.pointCount, 0u);
    EXPECT_TRUE(row.leaf());
    EXPECT_EQ(row.parent, noNode);
  }
  EXPECT_EQ(pages.reads, 1);
  Node row;
  EXPECT_EQ(table.peek(131, row), RowState::Lost);
  ASSERT_TRUE(table.fault());
  EXPECT_EQ(table.fault()->what, "page 2 is damaged");
  EXPECT_EQ(table.takeFaults().size(), 1u);
  EXPECT_EQ(table.takeFaults().size(), 0u);
  EXPECT_TRUE(table.fault()) << "stays";
}

TEST(PagedNodeTable, AChildThatDeniesItsParentIsLost)
{
  auto source = std::make_unique<TrickyPages>(6);
  source->denying = 1;
  const PagedNodeTable table(std::move(source), { 0 }, Refinement::Add);
  const Node child = table.node(67);
  const Node parent = table.node(child.parent - 1);
  const auto number = static_cast<std::uint8_t>(67 - parent.firstChild);
  EXPECT_TRUE(table.childOf(child.parent - 1, parent, number).parent == noNode);
  Node row;
  EXPECT_EQ(table.peekChild(child.parent - 1, parent, number, row), RowState::Lost);
  ASSERT_EQ(table.takeFaults().size(), 1u) << "once";
}

// A front over a table that comes page by page gets where it gets over one in memory.
TEST(PagedNodeTable, TheFrontSettlesAsOverATableInMemory)
{
  const Terrain terrain(8);
  std::vector<Node> nodes(terrain.nodeCount());
  for (NodeIndex i = 0; i < terrain.nodeCount(); ++i)
  {
    nodes[i] = terrain.row(i);
  }
  test::ScriptedResidency residency;
  residency.otherwise = ResidencySnapshot::State::Resident;
  const auto settled = [&](const std::shared_ptr<const Hierarchy>& table, std::size_t cached)
  {
    RenderFront front(table);
    for (int u = 0; u < 100000; ++u)
    {
      const std::uint64_t seen = table->arrivals();
      const FrontDelta& delta = front.update(overview(), residency, limitsOf(0.3));
      if (delta.complete)
      {
        EXPECT_GT(delta.frontLength, cached);
        return delta.draw;
      }
      if (delta.rowsComing)
      {
        table->waitForArrival(seen);
      }
    }
    ADD_FAILURE() << "never complete";
    return std::vector<DrawItem>();
  };
  const auto inMemory = settled(
    std::make_shared<HierarchyTable>(nodes, std::vector<NodeIndex>{ 0 }, Refinement::Add), 100);
  for (const std::size_t cacheBytes : { smallCache, PagedNodeTable::defaultCacheBytes })
  {
    const auto paged = settled(terrainTable(8, cacheBytes), 100);
    ASSERT_EQ(paged.size(), inMemory.size());
    for (std::size_t i = 0; i < paged.size(); ++i)
    {
      EXPECT_EQ(paged[i].node, inMemory[i].node);
      EXPECT_EQ(paged[i].pointCount, inMemory[i].pointCount);
    }
  }
}

TEST(PagedNodeTable, TheFrontDrawsTheParentOfALostPage)
{
  for (const Refinement refinement : { Refinement::Add, Refinement::Replace })
  {
    auto source = std::make_unique<TrickyPages>(6);
    source->damaged = 1; // nodes 56 to 111, of level 3: children of 13 (one of them) to 27
    const auto table =
      std::make_shared<PagedNodeTable>(std::move(source), std::vector<NodeIndex>{ 0 }, refinement);
    RenderFront front(table);
    test::ScriptedResidency residency;
    residency.otherwise = ResidencySnapshot::State::Resident;
    const FrontDelta* delta = nullptr;
    for (int u = 0; u < 1000; ++u)
    {
      const std::uint64_t seen = table->arrivals();
      delta = &front.update(overview(), residency, limitsOf(0.3));
      if (delta->complete)
      {
        break;
      }
      table->waitForArrival(delta->rowsComing ? seen : seen + 1);
    }
    ASSERT_TRUE(delta->complete);
    EXPECT_GT(delta->failedNodes, 10u);
    EXPECT_GE(delta->errorPx, 1.0) << "what is on screen there is the parent";
    std::size_t parents = 0;
    for (const DrawItem& item : delta->draw)
    {
      EXPECT_TRUE(item.node < nodePageRows || item.node >= 2 * nodePageRows);
      parents += item.node >= 15 && item.node <= 20 ? 1 : 0;
    }
    EXPECT_EQ(parents, 6u) << "all of their children are lost";
    EXPECT_EQ(table->takeFaults().size(), 1u);
  }
}

TEST(PagedNodeTable, ServesManyThreads)
{
  const Terrain terrain(9);
  const auto table = terrainTable(9, 4 * smallCache);
  std::atomic<int> wrong{ 0 };
  std::vector<std::thread> threads;
  for (unsigned t = 0; t < 4; ++t)
  {
    threads.emplace_back(
      [&, t]
      {
        std::mt19937 random(t);
        Node row;
        for (int i = 0; i < 5000; ++i)
        {
          const auto index = static_cast<NodeIndex>(random() % terrain.nodeCount());
          if (t % 2 == 0)
          {
            row = table->node(index);
          }
          else if (table->peek(index, row) != RowState::Here)
          {
            continue;
          }
          wrong += sameRow(row, terrain.row(index)) ? 0 : 1;
        }
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  EXPECT_EQ(wrong, 0);
}

// The file of an open store: a page that is damaged behind the roots'.
TEST(PagedNodeTable, AStoreWithADamagedPageOpensAndIsReadableElsewhere)
{
  SampleStore sample = makeSample(1);
  sample.nodes.clear();
  sample.points.clear();
  const NodeIndex count = 200; // a root with 199 children: the last pages hold leaves only
  const SampleStore few = makeSample(2);
  for (NodeIndex i = 0; i < count; ++i)
  {
    Node node;
    node.centre = few.nodes[0].centre;
    node.halfSize = 2.0f * few.nodes[0].halfSize;
    node.radius = 2.0f * few.nodes[0].radius;
    node.spacing = 1.0f;
    node.pointCount = 2;
    node.pointsBelow = i == 0 ? 2 * count : 2;
    node.parent = i == 0 ? noNode : 0;
    node.firstChild = i == 0 ? 1 : noNode;
    node.childCount = i == 0 ? 199 : 0;
    node.level = i == 0 ? 0 : 1;
    sample.nodes.push_back(node);
    sample.points.push_back(few.points[0]);
  }
  sample.roots = { 0 };
  const std::string sound = temporaryPath("sound.pfront");
  writeSample(sample, sound);
  EXPECT_TRUE((*PointStore::open(sound))->verify()->ok);

  ForgedStore forged(sound);
  const std::uint64_t page = forged.footer.find(SectionKind::NodeTable)->offset + 2 * nodePageBytes;
  forged.bytes()[static_cast<std::size_t>(page) + 100] ^= std::byte(1);
  const std::string path = temporaryPath("damaged.pfront");
  writeFile(path, forged.bytes());
  const auto opened = PointStore::open(path);
  ASSERT_TRUE(opened) << opened.error().what;
  const PointStore& store = **opened;
  EXPECT_TRUE(store.read(0, {}));
  EXPECT_TRUE(store.read(111, {}));
  const auto lost = store.read(121, {});
  ASSERT_FALSE(lost);
  EXPECT_EQ(lost.error().kind, Error::Kind::Corrupt);
  EXPECT_NE(lost.error().what.find("node 121"), std::string::npos) << lost.error().what;
  EXPECT_TRUE(store.read(180, {}));
  const auto report = store.verify();
  ASSERT_TRUE(report);
  EXPECT_FALSE(report->ok);
  EXPECT_NE(report->firstError.find("node 112 to node 167"), std::string::npos)
    << report->firstError;
  EXPECT_NE(report->firstError.find("(byte " + std::to_string(page) + ")"), std::string::npos)
    << report->firstError;
}

} // namespace pointfront
