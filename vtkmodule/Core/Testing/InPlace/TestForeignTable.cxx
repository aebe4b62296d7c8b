#include "pointfront/InPlace/ForeignTree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <iterator>
#include <map>
#include <set>
#include <thread>
#include <tuple>

namespace pointfront
{
namespace
{
using Key = std::tuple<int, int, int, int>;

ForeignNode nodeAt(int level, int x, int y, std::uint32_t points = 3)
{
  ForeignNode node;
  node.level = level;
  node.x = x;
  node.y = y;
  node.points = points;
  return node;
}

Key keyOf(const ForeignNode& node)
{
  return { node.level, node.x, node.y, node.z };
}

/// A tree over a square, of `levels` levels, in pages of `step`; its nodes cannot be read.
///
///        0-0-0-0            a page of its two upper levels
///     1-0-0-0 ... 1-1-1-0
///   [2-0-0-0] ... [2-3-3-0]  pages of two levels each
class PagesInMemory final : public ForeignNodes
{
public:
  PagesInMemory(int levels, int step)
  {
    for (int level = 0; level < levels; ++level)
    {
      for (int cell = 0; cell < 1 << (2 * level); ++cell)
      {
        const int x = cell & ((1 << level) - 1);
        const int y = cell >> level;
        const int above = level % step;
        const Key page{ level - above, x >> above, y >> above, 0 };
        pages_[page].nodes.push_back(
          nodeAt(level, x, y, static_cast<std::uint32_t>(1 + (x + y) % 5)));
        points += pages_[page].nodes.back().points;
        if (above == 0 && level > 0)
        {
          pages_[{ level - step, x >> step, y >> step, 0 }].pages.push_back(nodeAt(level, x, y));
        }
      }
    }
  }
  Result<RawBytes> fetch(const ForeignNode&) const override { return RawBytes(0); }
  std::size_t storedBytes(const ForeignNode&) const override { return 0; }
  Result<void> decode(const Part&, const RawBytes&, PointBatch&) const override { return {}; }
  std::vector<Result<ForeignPage>> readPages(const std::vector<ForeignNode>& wanted) const override
  {
    ++rounds;
    std::vector<Result<ForeignPage>> read;
    for (const ForeignNode& page : wanted)
    {
      ++pagesRead;
      read.push_back(broken.count(keyOf(page)) > 0
          ? Result<ForeignPage>(makeError(Error::Kind::NotFound, "that page"))
          : Result<ForeignPage>(pages_.at(keyOf(page))));
    }
    return read;
  }
  ReadCost readCost() const override { return { 0.05, 1e6, 8, 1000 }; }
  std::vector<std::string> files() const override { return {}; }

  std::shared_ptr<ForeignTable> open(const std::shared_ptr<PagesInMemory>& self) const
  {
    ForeignTreeContent content;
    content.source.path = "tree";
    content.source.headerPointCount = points;
    content.side = 64.0;
    content.first = pages_.at({ 0, 0, 0, 0 });
    content.reader = self;
    auto table = ForeignTable::make(content, glm::dvec3(0.0));
    EXPECT_TRUE(table) << table.error().what;
    return table ? *table : nullptr;
  }

  std::uint64_t points = 0;
  std::set<Key> broken;
  mutable std::atomic<int> rounds{ 0 };
  mutable std::atomic<int> pagesRead{ 0 };

private:
  std::map<Key, ForeignPage> pages_;
};

struct Opened
{
  explicit Opened(int levels = 6, int step = 2)
    : pages(std::make_shared<PagesInMemory>(levels, step))
    , table(pages->open(pages))
  {
  }
  std::shared_ptr<PagesInMemory> pages;
  std::shared_ptr<ForeignTable> table;
};

/// All nodes below one, itself too, by their cells.
void walk(const ForeignTable& table, NodeIndex index, std::map<Key, Node>& found)
{
  const auto row = table.find(index);
  ASSERT_TRUE(row);
  EXPECT_TRUE(found.emplace(keyOf(row->cell), row->row).second);
  std::vector<NodeIndex> children;
  table.appendChildren(index, row->row, children);
  EXPECT_EQ(children.size(), row->row.childCount);
  for (const NodeIndex child : children)
  {
    EXPECT_GT(child, index);
    walk(table, child, found);
  }
}

TEST(ForeignTable, OfOnePageHasNoGaps)
{
  const Opened opened(4, 4);
  EXPECT_TRUE(opened.table->whole());
  EXPECT_EQ(opened.table->nodeCount(), 85u);
  EXPECT_EQ(opened.table->missingRows(), nullptr);
  std::uint64_t points = 0;
  for (NodeIndex i = 0; i < 85; ++i)
  {
    EXPECT_EQ(opened.table->node(i).firstPoint, points);
    points += opened.table->node(i).pointCount;
  }
  EXPECT_EQ(points, opened.pages->points);
  EXPECT_EQ(opened.table->node(0).pointsBelow, points);
}

TEST(ForeignTable, NumbersDoNotDependOnTheOrderInWhichPagesAreRead)
{
  const Opened forward;
  const Opened backward;
  std::map<Key, Node> first;
  walk(*forward.table, 0, first);
  ASSERT_EQ(first.size(), 1365u);
  std::vector<Node> rows;
  std::transform(first.begin(), first.end(), std::back_inserter(rows),
    [](const auto& node) { return node.second; });
  // The numbers of the last points lead to the last pages.
  std::sort(rows.begin(), rows.end(),
    [](const Node& a, const Node& b) { return a.firstPoint > b.firstPoint; });
  for (const Node& row : rows)
  {
    const auto [node, behind] = backward.table->nodesAround(row.firstPoint + row.pointCount - 1);
    EXPECT_EQ(behind, node + 1);
    const Node same = backward.table->node(node);
    EXPECT_EQ(same.firstPoint, row.firstPoint);
    EXPECT_EQ(same.pointCount, row.pointCount);
    EXPECT_EQ(same.parent, row.parent);
    EXPECT_EQ(same.firstChild, row.firstChild);
    EXPECT_EQ(same.pointsBelow, row.pointsBelow);
    EXPECT_EQ(same.centre, row.centre);
  }
  std::map<Key, Node> second;
  walk(*backward.table, 0, second);
  EXPECT_EQ(second.size(), first.size());
  EXPECT_FALSE(forward.table->fault() || backward.table->fault());
}

TEST(ForeignTable, ReadsThePagesThatSomebodyLooksInto)
{
  const Opened opened;
  EXPECT_EQ(opened.pages->pagesRead, 0);
  const Node root = opened.table->node(0);
  Node child;
  ASSERT_EQ(opened.table->peekChild(0, root, 3, child), RowState::Here);
  EXPECT_EQ(child.childCount, 4u);
  const NodeIndex last = root.firstChild + 3;
  for (std::uint8_t c = 0; c < 4; ++c)
  {
    Node below;
    EXPECT_EQ(opened.table->peekChild(last, child, c, below), RowState::Coming);
  }
  EXPECT_TRUE(opened.table->missingRows()->waiting());
  opened.table->waitForArrival(0);
  EXPECT_EQ(opened.pages->pagesRead, 4);
  EXPECT_EQ(opened.pages->rounds, 1) << "together";
  for (std::uint8_t c = 0; c < 4; ++c)
  {
    Node below;
    EXPECT_EQ(opened.table->peekChild(last, child, c, below), RowState::Here);
    EXPECT_EQ(below.parent, last);
  }
  EXPECT_FALSE(opened.table->missingRows()->waiting());
}

TEST(ForeignTable, AllPagesAreReadInRoundsOfSeveral)
{
  const Opened opened;
  ASSERT_TRUE(opened.table->readAll());
  EXPECT_EQ(opened.pages->pagesRead, 16 + 256);
  EXPECT_LE(opened.pages->rounds, 1 + 9);
  const std::vector<NodeIndex> nodes = opened.table->nodes();
  EXPECT_EQ(nodes.size(), 1365u);
  EXPECT_TRUE(std::is_sorted(nodes.begin(), nodes.end()));
}

/// A tree without an end, each node of which has a page: for its lower levels no numbers are set
/// aside.
class EndlessPages final : public ForeignNodes
{
public:
  static constexpr int levels = 29;
  static ForeignPage page(const ForeignNode& of)
  {
    ForeignPage found;
    found.nodes.push_back(nodeAt(of.level, of.x, of.y));
    for (int child = 0; child < 4 && of.level + 1 < levels; ++child)
    {
      found.pages.push_back(nodeAt(of.level + 1, 2 * of.x + (child & 1), 2 * of.y + (child >> 1)));
    }
    return found;
  }
  Result<RawBytes> fetch(const ForeignNode&) const override { return RawBytes(0); }
  std::size_t storedBytes(const ForeignNode&) const override { return 0; }
  Result<void> decode(const Part&, const RawBytes&, PointBatch&) const override { return {}; }
  std::vector<Result<ForeignPage>> readPages(const std::vector<ForeignNode>& wanted) const override
  {
    return { wanted.size(), Result<ForeignPage>(page(wanted.front())) };
  }
  std::vector<std::string> files() const override { return {}; }
};

TEST(ForeignTable, NodesForWhichNoNumbersWereSetAsideHaveThemToo)
{
  ForeignTreeContent content;
  content.source.headerPointCount = 1000000;
  content.side = 64.0;
  content.first = EndlessPages::page({});
  content.reader = std::make_shared<const EndlessPages>();
  const auto made = ForeignTable::make(content, glm::dvec3(0.0));
  ASSERT_TRUE(made) << made.error().what;
  const ForeignTable& table = **made;
  std::map<NodeIndex, Node> found;
  for (std::uint32_t path = 0; path < 4; ++path) // down to all corners
  {
    NodeIndex index = 0;
    for (Node row = table.node(0); !row.leaf(); row = table.node(index))
    {
      const NodeIndex child = row.firstChild + path;
      ASSERT_GT(child, index);
      ASSERT_EQ(table.node(child).parent, index);
      index = child;
      found[index] = table.node(index);
    }
  }
  EXPECT_EQ(found.size(), 4u * (EndlessPages::levels - 1));
  std::set<std::uint64_t> firstPoints;
  for (const auto& [index, row] : found)
  {
    EXPECT_EQ(table.nodesAround(row.firstPoint + 2).first, index);
    EXPECT_LT(row.firstPoint, std::uint64_t(1) << 48);
    firstPoints.insert(row.firstPoint);
  }
  EXPECT_EQ(firstPoints.size(), found.size());
  EXPECT_FALSE(table.fault());
}

TEST(ForeignTable, APageThatCannotBeReadIsAFaultAndTheOthersAreThere)
{
  const Opened opened;
  opened.pages->broken.insert({ 2, 3, 3, 0 });
  const Result<void> all = opened.table->readAll();
  ASSERT_FALSE(all);
  EXPECT_EQ(all.error().what, "that page");
  EXPECT_EQ(opened.table->takeFaults().size(), 1u);
  EXPECT_TRUE(opened.table->takeFaults().empty());
  EXPECT_EQ(opened.table->nodes().size(), 1365u - 85u);
  std::size_t lost = 0;
  for (NodeIndex parent = 1; parent < 5; ++parent)
  {
    const Node row = opened.table->node(parent);
    for (std::uint8_t c = 0; c < row.childCount; ++c)
    {
      Node child;
      lost += opened.table->peekChild(parent, row, c, child) == RowState::Lost ? 1 : 0;
    }
  }
  EXPECT_EQ(lost, 1u);
}

TEST(ForeignTable, ATreeThatLacksPointsSaysSoWhenAllIsRead)
{
  const auto pages = std::make_shared<PagesInMemory>(4, 2);
  ++pages->points;
  const auto table = pages->open(pages);
  EXPECT_FALSE(table->fault());
  const Result<void> all = table->readAll();
  ASSERT_FALSE(all);
  EXPECT_NE(all.error().what.find("lacks 1 of the"), std::string::npos) << all.error().what;
  EXPECT_TRUE(table->takeFaults().empty()) << "what there is can be drawn";
}

TEST(ForeignTable, SeveralThreadsLookAtOnce)
{
  const Opened opened;
  std::vector<std::map<Key, Node>> found(4);
  std::vector<std::thread> threads;
  for (std::map<Key, Node>& own : found)
  {
    threads.emplace_back([&] { walk(*opened.table, 0, own); });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  for (const std::map<Key, Node>& own : found)
  {
    EXPECT_EQ(own.size(), 1365u);
  }
}
} // namespace
} // namespace pointfront
