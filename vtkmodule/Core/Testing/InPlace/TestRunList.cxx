#include "pointfront/InPlace/RunList.h"

#include <gtest/gtest.h>

#include <random>

namespace pointfront
{
namespace
{
using Numbers = Run; // testing::Test has a Run of its own
using Runs = std::vector<Numbers>;

Runs decode(const std::vector<std::byte>& bytes, bool& sound)
{
  RunListReader reader(bytes.data(), bytes.size());
  Runs runs;
  for (Numbers run; reader.next(run);)
  {
    runs.push_back(run);
  }
  sound = reader.sound();
  return runs;
}

TEST(RunList, GivesBackRunsOfAnySize)
{
  const Runs runs{ { 0, 1 }, { 2, 1 }, { 5, 2 }, { 8, 3 }, { 1000, 130 },
    { std::uint64_t(1) << 40, 1 }, { (std::uint64_t(1) << 40) + 2, std::uint64_t(1) << 33 } };
  RunListWriter writer;
  for (const auto& run : runs)
  {
    writer.add(run);
  }
  writer.finish();
  EXPECT_EQ(writer.runCount(), runs.size());
  bool sound = false;
  EXPECT_EQ(decode(writer.bytes(), sound), runs);
  EXPECT_TRUE(sound);
}

TEST(RunList, JoinsRunsThatTouch)
{
  RunListWriter writer;
  writer.add({ 3, 2 });
  writer.add({ 5, 1 });
  writer.add({ 6, 4 });
  writer.finish();
  bool sound = false;
  EXPECT_EQ(decode(writer.bytes(), sound), (Runs{ { 3, 7 } }));
}

TEST(RunList, BytesTakenAwayInBetweenAreTheSameBytes)
{
  std::mt19937_64 random(7);
  RunListWriter whole;
  RunListWriter parts;
  std::vector<std::byte> joined;
  std::uint64_t at = 0;
  for (int i = 0; i < 1000; ++i)
  {
    at += random() % 500;
    const Numbers run{ at, 1 + random() % 20 };
    at += run.count;
    whole.add(run);
    parts.add(run);
    if (i % 37 == 0)
    {
      const std::vector<std::byte> bytes = parts.take();
      joined.insert(joined.end(), bytes.begin(), bytes.end());
    }
  }
  whole.finish();
  parts.finish();
  joined.insert(joined.end(), parts.bytes().begin(), parts.bytes().end());
  EXPECT_EQ(joined, whole.bytes());
}

TEST(RunList, AnOrderWithoutRunsCostsTwoBytesAPoint)
{
  // One point in 500, in random order: the worst that a leaf of 10 M points and 20 k can have.
  std::mt19937_64 random(1);
  RunListWriter writer;
  std::uint64_t points = 0;
  for (std::uint64_t at = 0; at < 10000000; at += 1 + random() % 999, ++points)
  {
    writer.add({ at, 1 });
  }
  writer.finish();
  EXPECT_LT(writer.bytes().size(), 2 * points);
  EXPECT_GT(writer.bytes().size(), points);
}

TEST(RunList, DamagedBytesAreToldFromAnEnd)
{
  RunListWriter writer;
  writer.add({ 1000000, 1000000 });
  writer.finish();
  std::vector<std::byte> cut = writer.bytes();
  cut.pop_back();
  bool sound = true;
  decode(cut, sound);
  EXPECT_FALSE(sound);
  decode(std::vector<std::byte>(20, std::byte(0xff)), sound);
  EXPECT_FALSE(sound);
  decode({}, sound);
  EXPECT_TRUE(sound);
}
} // namespace
} // namespace pointfront
