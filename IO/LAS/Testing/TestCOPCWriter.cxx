#include "COPCChunks.h"
#include "COPCGrid.h"
#include "COPCLevels.h"
#include "COPCPages.h"
#include "COPCRecords.h"
#include "LASBytes.h"
#include "LAZIntegerDecoder.h"
#include "LAZIntegerEncoder.h"

#include "pointfront/Disk/OutputFile.h"
#include "pointfront/Disk/TemporaryFile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

using namespace pointfront;

namespace
{
using Key = std::tuple<int, unsigned, unsigned, unsigned>;

/// Records of 12 bytes: places only.
std::vector<std::byte> randomRecords(std::size_t count, std::int32_t most)
{
  std::mt19937 draw(30);
  std::uniform_int_distribution<std::int32_t> steps(0, most);
  std::vector<std::byte> records(count * 12);
  for (std::size_t i = 0; i < 3 * count; ++i)
  {
    storeNumber(records.data() + 4 * i, steps(draw));
  }
  return records;
}

LASTotals totalsOf(std::size_t count, std::int32_t most)
{
  LASTotals totals;
  totals.points = count;
  totals.high = GridPosition(most);
  return totals;
}

COPCNode node(int level, unsigned x, unsigned y, unsigned z, std::uint32_t points)
{
  COPCNode made;
  made.level = level;
  made.cell = { x, y, z };
  made.points = points;
  made.bytes = points;
  made.offset = 1000;
  return made;
}

/// All entries of all pages; the number of pages.
std::size_t readPages(const COPCPages& pages, std::uint64_t begin, std::uint64_t offset,
  std::uint64_t size, std::map<Key, std::int32_t>& found)
{
  std::size_t count = 1;
  for (std::uint64_t at = offset; at < offset + size; at += 32)
  {
    const std::byte* entry = pages.bytes.data() + (at - begin);
    const auto points = loadNumber<std::int32_t>(entry + 28);
    if (points == -1)
    {
      count += readPages(pages, begin, loadNumber<std::uint64_t>(entry + 16),
        static_cast<std::uint64_t>(loadNumber<std::int32_t>(entry + 24)), found);
      continue;
    }
    const Key key{ loadNumber<std::int32_t>(entry), loadNumber<std::uint32_t>(entry + 4),
      loadNumber<std::uint32_t>(entry + 8), loadNumber<std::uint32_t>(entry + 12) };
    EXPECT_TRUE(found.emplace(key, points).second);
  }
  return count;
}
} // namespace

/// LeakSanitizer calls it. LASzip 3.4 does not free the table of variable chunks
/// (Testing/Whole/leaks-of-libraries.txt).
extern "C" const char* __lsan_default_suppressions()
{
  return "leak:LASwritePoint::add_chunk_to_table";
}

TEST(LAZIntegerEncoder, TheDecoderGivesWhatWasAdded)
{
  std::mt19937 draw(31);
  std::vector<std::uint32_t> integers{ 0, 1, 2, 0xFFFFFFFFu, 0x80000000u, 0, 50000, 50001 };
  for (int i = 0; i < 20000; ++i)
  {
    integers.push_back(static_cast<std::uint32_t>(draw()) >> (draw() % 32));
  }
  LAZIntegerEncoder encoder;
  std::uint32_t before = 0;
  for (std::size_t i = 0; i < integers.size(); ++i)
  {
    encoder.add(before, integers[i], static_cast<int>(i % 2));
    before = integers[i];
  }
  const std::vector<std::byte> bytes = encoder.finish();
  LAZIntegerDecoder decoder({ bytes.data(), bytes.size() });
  before = 0;
  for (std::size_t i = 0; i < integers.size(); ++i)
  {
    const auto decoded = decoder.next(before, static_cast<int>(i % 2));
    ASSERT_EQ(decoded, integers[i]) << "integer " << i;
    before = integers[i];
  }
}

TEST(COPCGrid, CellsAreRunsOfTheOrderOnEveryLevel)
{
  constexpr std::int32_t most = 100000;
  const COPCGrid grid(totalsOf(1, most), {});
  const std::vector<std::byte> records = randomRecords(20000, most);
  std::vector<std::pair<std::uint64_t, glm::uvec3>> points;
  for (std::size_t i = 0; i < 20000; ++i)
  {
    const glm::uvec3 cell = grid.cell(records.data() + 12 * i);
    points.emplace_back(COPCGrid::key(cell), cell);
  }
  std::sort(
    points.begin(), points.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const int level : { 1, 2, 5, 9 })
  {
    std::set<Key> ended;
    Key current{ -1, 0, 0, 0 };
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const glm::uvec3 cell = points[i].second;
      const int shift = COPCGrid::keyLevels - level;
      const Key key{ level, cell.x >> shift, cell.y >> shift, cell.z >> shift };
      if (i > 0)
      {
        const int common = COPCGrid::commonLevels(points[i - 1].first, points[i].first);
        ASSERT_EQ(key == current, common >= level);
      }
      if (key != current)
      {
        ASSERT_EQ(ended.count(key), 0u);
        ended.insert(current);
        current = key;
      }
    }
  }
}

TEST(COPCGrid, PlanesOfCellsLieBetweenSteps)
{
  QuantisationGrid steps;
  steps.scale = glm::dvec3(0.01);
  for (const std::int32_t most : { 0, 1, 100, 12345, 1999999, 2147483646 })
  {
    const COPCGrid grid(totalsOf(1, most), steps);
    EXPECT_LT(grid.halfSize(), 0.005 * 1.01 * (double(most) + 1.0) + 0.01);
    for (const double plane : { 0.0, 0.5, 1.0 })
    {
      const double at = (grid.centre().x + (2.0 * plane - 1.0) * grid.halfSize()) / 0.01;
      if (most > 512)
      {
        EXPECT_NEAR(at - std::floor(at), 0.5, 1e-3) << most;
      }
    }
  }
}

TEST(COPCLevels, ASampleAboveAndTheRestInLeaves)
{
  COPCLevels few; // less than a leaf: all in the root
  EXPECT_EQ(few.place(0, -1, -1), 0);
  EXPECT_EQ(few.place(12, -1, -1), 0);
  COPCLevels many; // the cell of level 2 is the first that is not divided
  EXPECT_EQ(many.place(0, 1, 5), 0);
  EXPECT_EQ(many.place(8, 1, 5), 1);
  EXPECT_EQ(many.place(9, 1, 5), 2);
  EXPECT_EQ(many.place(20, 1, 5), 2);
  EXPECT_EQ(many.place(2, 0, 0), 0); // another leaf: its first point is a sample of the root
  EXPECT_EQ(many.place(20, 0, 0), 1); // a small leaf is part of its parent
  COPCLevels equal; // more than a leaf in one place
  EXPECT_EQ(equal.place(0, 21, 21), 0);
  EXPECT_EQ(equal.place(22, 21, 21), COPCLevels::deepest);
}

TEST(COPCPages, LargeTreesAreSeveralPagesThatNameEachNodeOnce)
{
  std::vector<COPCNode> nodes;
  for (int level = 0; level <= 7; ++level)
  {
    for (unsigned x = 0; x < (1u << level); ++x)
    {
      for (unsigned y = 0; y < (1u << level); ++y)
      {
        nodes.push_back(node(level, x, y, 0, 1 + x + y));
      }
    }
  }
  const COPCPages pages = COPCPages::compose(nodes, 777);
  EXPECT_EQ(pages.bytes.size() % 32, 0u);
  std::map<Key, std::int32_t> found;
  const std::size_t count = readPages(pages, 777, 777, pages.rootBytes, found);
  EXPECT_EQ(found.size(), nodes.size());
  EXPECT_EQ(count, 1u); // trees of 21 nodes below level 5 stay in the root's page
  for (unsigned x = 0; x < 512; ++x)
  {
    for (unsigned y = 0; y < 512; ++y)
    {
      for (int level = 8; level <= 9; ++level)
      {
        if (x < (1u << level) && y < (1u << level))
        {
          nodes.push_back(node(level, x, y, 0, 1));
        }
      }
    }
  }
  const COPCPages more = COPCPages::compose(nodes, 777);
  found.clear();
  EXPECT_EQ(readPages(more, 777, 777, more.rootBytes, found), 1u + 32u * 32u);
  EXPECT_EQ(found.size(), nodes.size());
  EXPECT_LT(more.rootBytes, 64u << 10);
}

TEST(COPCChunks, InnerNodesFollowTheLeavesDeepestFirst)
{
  const LASPointLayout layout = makeLASPointLayout(6, {});
  const std::string path = (std::filesystem::temp_directory_path() / "chunks.copc.laz").string();
  auto file = OutputFile::create(path);
  ASSERT_TRUE(file.ok());
  COPCMemory memory;
  memory.nodeBytes = 2000; // the root's points are compressed while they come
  COPCChunks chunks(layout, path, **file, 0, memory, folderOf(path));
  // Two cells of level 1, each with two of level 2. An inner node's points come between those of
  // its children.
  const std::vector<std::byte> record(layout.pointBytes);
  for (unsigned x = 0; x < 4; ++x)
  {
    ASSERT_TRUE(chunks.close(x % 2 == 0 ? 1 : 2).ok());
    for (int n = 0; n < 100; ++n)
    {
      ASSERT_TRUE(chunks.add(0, { 0, 0, 0 }, record.data()).ok());
      ASSERT_TRUE(chunks.add(1, { x / 2, 0, 0 }, record.data()).ok());
      ASSERT_TRUE(chunks.add(2, { x, 0, 0 }, record.data()).ok());
    }
  }
  ASSERT_TRUE(chunks.close(0).ok());
  ASSERT_TRUE(chunks.settle().ok());
  std::vector<COPCNode> nodes = chunks.nodes();
  std::sort(nodes.begin(), nodes.end(),
    [](const COPCNode& a, const COPCNode& b) { return a.offset < b.offset; });
  std::vector<std::array<unsigned, 3>> order; // level, x, points
  std::uint64_t end = 0;
  for (const COPCNode& node : nodes)
  {
    order.push_back({ static_cast<unsigned>(node.level), node.cell.x, node.points });
    EXPECT_EQ(node.offset, end);
    end += node.bytes;
  }
  const std::vector<std::array<unsigned, 3>> expected{ { 2, 0, 100 }, { 2, 1, 100 }, { 2, 2, 100 },
    { 2, 3, 100 }, { 1, 0, 200 }, { 1, 1, 200 }, { 0, 0, 400 } };
  EXPECT_EQ(order, expected);
  EXPECT_EQ(chunks.end(), end);
}

TEST(COPCRecords, AreInTheSameOrderWhateverTheMemory)
{
  constexpr std::size_t count = 30000;
  constexpr std::int32_t most = 60; // many places are shared
  const std::vector<std::byte> records = randomRecords(count, most);
  const COPCGrid grid(totalsOf(count, most), {});
  std::vector<std::vector<std::byte>> orders;
  for (const std::uint64_t memory : { std::uint64_t{ 1 } << 24, std::uint64_t{ 1 } << 10 })
  {
    COPCRecords sorted({ 12, memory, memory, std::filesystem::temp_directory_path().string() });
    ASSERT_TRUE(sorted.append(records.data(), 10000).ok());
    ASSERT_TRUE(sorted.append(records.data() + 12 * 10000, 20000).ok());
    ASSERT_TRUE(sorted.sort(grid, [](std::uint64_t) { return true; }).ok());
    std::vector<std::byte> order;
    std::uint64_t before = 0;
    for (;;)
    {
      const auto next = sorted.next();
      ASSERT_TRUE(next.ok());
      if (!*next)
      {
        break;
      }
      EXPECT_GE((*next)->key, before);
      before = (*next)->key;
      order.insert(order.end(), (*next)->bytes, (*next)->bytes + 12);
    }
    EXPECT_EQ(order.size(), records.size());
    orders.push_back(std::move(order));
    EXPECT_EQ(sorted.runs() > 1, memory < 100000);
  }
  EXPECT_EQ(orders[0], orders[1]);
}
