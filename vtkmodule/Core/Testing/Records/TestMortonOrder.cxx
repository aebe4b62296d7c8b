#include "TestBuildClouds.h"

#include "pointfront/Records/MortonOrder.h"

#include <gtest/gtest.h>

#include <numeric>

namespace pointfront
{
namespace
{
using test::Random;

std::vector<std::byte> packed(const std::vector<TreePosition>& positions)
{
  std::vector<std::byte> records(positions.size() * RecordLayout::positionBytes);
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    setPosition(records.data() + i * RecordLayout::positionBytes, positions[i]);
  }
  return records;
}

/// The definition: compare the interleaved bits from the highest down, z before y before x.
bool referenceLess(const TreePosition& a, const TreePosition& b)
{
  for (int bit = 31; bit >= 0; --bit)
  {
    for (int axis = 2; axis >= 0; --axis)
    {
      const unsigned bitA = (a[axis] >> bit) & 1u;
      const unsigned bitB = (b[axis] >> bit) & 1u;
      if (bitA != bitB)
      {
        return bitA < bitB;
      }
    }
  }
  return false;
}

/// Random positions of `bits` bits, every third one a copy of an earlier one.
std::vector<TreePosition> positionsOf(std::size_t count, unsigned bits)
{
  Random random(bits);
  std::vector<TreePosition> positions;
  const std::uint32_t mask = bits == 32 ? ~0u : (1u << bits) - 1;
  for (std::size_t i = 0; i < count; ++i)
  {
    positions.push_back(i % 3 == 2
        ? positions[random.next() % i]
        : TreePosition(std::uint32_t(random.next()) & mask, std::uint32_t(random.next()) & mask,
            std::uint32_t(random.next()) & mask));
  }
  return positions;
}

TEST(MortonOrder, ComparesAsInterleavedBitsDo)
{
  const std::vector<TreePosition> positions = positionsOf(300, 32);
  for (const TreePosition& a : positions)
  {
    for (const TreePosition& b : positions)
    {
      ASSERT_EQ(mortonLess(a, b), referenceLess(a, b));
    }
  }
}

TEST(MortonOrder, SortsStablyForEveryNumberOfBits)
{
  for (const unsigned bits : { 0u, 1u, 4u, 20u, 21u, 22u, 32u })
  {
    const std::vector<TreePosition> positions = positionsOf(2000, bits);
    const std::vector<std::byte> records = packed(positions);
    std::vector<std::uint32_t> expected(positions.size());
    std::iota(expected.begin(), expected.end(), 0u);
    std::stable_sort(expected.begin(), expected.end(),
      [&](std::uint32_t a, std::uint32_t b) { return referenceLess(positions[a], positions[b]); });
    EXPECT_EQ(
      mortonOrder({ records.data(), RecordLayout::positionBytes }, positions.size()), expected)
      << bits << " bits";
  }
  EXPECT_TRUE(mortonOrder({}, 0).empty());
}

TEST(MortonOrder, FindsTheSmallestCommonCell)
{
  const OctreeCell cell = commonCell({ 4, 5, 6 }, { 7, 7, 7 });
  EXPECT_EQ(cell.log2Side, 2u);
  EXPECT_EQ(cell.origin, TreePosition(4, 4, 4));
  EXPECT_EQ(commonCell({ 9, 9, 9 }, { 9, 9, 9 }).log2Side, 0u);
  EXPECT_EQ(commonCell({ 0, 0, 0 }, { 0, ~0u, 0 }).log2Side, 32u);
  EXPECT_EQ(commonCell({ 0, 0, 0 }, { 0, ~0u, 0 }).origin, TreePosition(0));
  EXPECT_EQ(octantOf({ 4, 0, 4 }, 3), 5u);
}

} // namespace
} // namespace pointfront
