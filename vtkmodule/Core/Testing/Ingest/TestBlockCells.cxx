#include "TestBuildClouds.h"

#include "pointfront/Ingest/BlockCells.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <tuple>

namespace pointfront
{
namespace
{
constexpr unsigned shift = 4;
constexpr std::size_t recordBytes = RecordLayout::positionBytes + 5; // class, number

struct Block
{
  explicit Block(std::vector<TreePosition> p)
    : positions(std::move(p))
    , records(bytes())
  {
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
      std::byte* record = records.data() + i * recordBytes;
      setPosition(record, positions[i]);
      const auto number = static_cast<std::uint32_t>(i);
      record[RecordLayout::positionBytes] = std::byte(classOf(i));
      std::memcpy(record + RecordLayout::positionBytes + 1, &number, sizeof(number));
    }
  }
  static std::uint8_t classOf(std::size_t i) { return i % 3 == 0 ? 7 : 2; }
  std::size_t bytes() const { return positions.size() * recordBytes; }

  std::vector<TreePosition> positions;
  std::vector<std::byte> records;
};

std::uint32_t numberIn(const std::byte* record)
{
  std::uint32_t number;
  std::memcpy(&number, record + RecordLayout::positionBytes + 1, sizeof(number));
  return number;
}

/// Scatters the block and checks that its runs say what is there, in input order.
std::vector<CellRun> checkedRuns(BlockCells& cells, const Block& block)
{
  cells.begin(block.positions.size());
  for (std::size_t i = 0; i < block.positions.size(); ++i)
  {
    cells.add(block.positions[i], Block::classOf(i));
  }
  const std::vector<CellRun> runs = cells.order();
  std::vector<std::byte> sorted(block.bytes());
  cells.scatter(block.records.data(), recordBytes, sorted.data());
  const std::byte* record = sorted.data();
  std::set<std::uint32_t> seen;
  std::set<std::tuple<int, std::uint32_t, std::uint32_t, std::uint32_t>> cellsSeen;
  for (const CellRun& run : runs)
  {
    EXPECT_TRUE(cellsSeen.insert({ run.objectClass, run.cell.x, run.cell.y, run.cell.z }).second);
    std::int64_t before = -1;
    for (std::uint32_t i = 0; i < run.count; ++i, record += recordBytes)
    {
      const TreePosition p = positionOf(record);
      const std::uint32_t number = numberIn(record);
      EXPECT_EQ(p, block.positions[number]);
      EXPECT_EQ(
        TreePosition(p.x >> cells.runShift(), p.y >> cells.runShift(), p.z >> cells.runShift()),
        run.cell);
      EXPECT_EQ(Block::classOf(number), run.objectClass);
      EXPECT_LT(before, std::int64_t(number));
      before = number;
      seen.insert(number);
    }
  }
  EXPECT_EQ(record, sorted.data() + sorted.size());
  EXPECT_EQ(seen.size(), block.positions.size());
  return runs;
}

std::vector<TreePosition> randomPositions(std::size_t count, std::uint32_t side)
{
  test::Random random(5);
  std::vector<TreePosition> positions;
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto axis = [&] { return static_cast<std::uint32_t>(random.next() % side); };
    positions.emplace_back(axis(), axis(), axis());
  }
  return positions;
}

TEST(BlockCells, BringARecordsBlockIntoTheOrderOfItsCells)
{
  BlockCells cells(shift);
  const std::vector<CellRun> runs = checkedRuns(cells, Block(randomPositions(5000, 48)));
  EXPECT_EQ(cells.runShift(), shift);
  EXPECT_EQ(runs.size(), 2u * 27u); // two classes
  EXPECT_EQ(runs.front().objectClass, 2);
  EXPECT_EQ(runs.back().objectClass, 7);
  EXPECT_EQ(checkedRuns(cells, Block(randomPositions(300, 16))).size(), 2u); // used again
}

TEST(BlockCells, TakeLargerCellsForPointsInAnyOrder)
{
  BlockCells cells(shift);
  const std::vector<CellRun> runs = checkedRuns(cells, Block(randomPositions(20000, 4096)));
  EXPECT_GT(cells.runShift(), shift);
  EXPECT_LE(runs.size(), 20000u / 64u);
}

TEST(BlockCells, CountTheFineCellsWhateverTheRunsAre)
{
  BlockCells cells(shift);
  const Block block(randomPositions(4000, 1024));
  checkedRuns(cells, block);
  cells.begin(block.positions.size());
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::uint64_t> expected;
  for (const TreePosition& p : block.positions)
  {
    cells.add(p, 2);
    ++expected[{ p.x >> shift, p.y >> shift, p.z >> shift }];
  }
  ClassCounts counts(shift);
  cells.countInto(counts);
  ASSERT_EQ(counts.shift(), shift);
  ASSERT_EQ(counts.classes().size(), 1u);
  const CellTable& table = counts.classes().at(2);
  EXPECT_EQ(table.size(), expected.size());
  for (const CellTable::Entry& entry : table.entries())
  {
    EXPECT_EQ((expected[{ entry.cell.x, entry.cell.y, entry.cell.z }]), entry.value);
  }
}

TEST(CellTable, FindsCellsThatAllPreferTheSamePlaceOfTheirTile)
{
  // Every fourth cell along an axis, or of a plane: one place of 16, so tiles overflow.
  for (const TreePosition& along : { TreePosition(4, 0, 0), { 0, 4, 0 }, { 0, 0, 4 }, { 4, 8, 0 } })
  {
    CellTable table(0);
    for (std::uint32_t i = 0; i < 5000; ++i)
    {
      table.at(i * along) += i + 1;
    }
    EXPECT_EQ(table.size(), 5000u);
    for (std::uint32_t i = 0; i < 5000; ++i)
    {
      ASSERT_EQ(table.find(i * along), i + 1);
      ASSERT_EQ(table.find(i * along + TreePosition(1)), 0u);
    }
  }
}

} // namespace
} // namespace pointfront
