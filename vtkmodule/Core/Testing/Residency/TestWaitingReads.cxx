#include "pointfront/Residency/WaitingReads.h"

#include "MadeUpReader.h"

#include <gtest/gtest.h>

namespace pointfront
{

using test::MadeUpReader;

namespace
{

constexpr std::uint32_t points = 100;

LoadRequest wish(NodeIndex node, double priority, bool optional = false)
{
  return { node, priority, optional, points };
}

/// Reads of nodes of equal size, none of which is in memory, under a budget for some of them.
struct Waiting
{
  explicit Waiting(std::size_t nodesThatFit)
    : budget(std::make_shared<MemoryBudget>(nodesThatFit * reader->trueBytes(0, {})))
    , cache(budget)
    , reads(reader, budget)
  {
  }
  /// Node and turn of what is read next, until nothing is left.
  std::vector<std::pair<NodeIndex, int>> order()
  {
    std::vector<std::pair<NodeIndex, int>> all;
    while (const auto choice = reads.choose(cache, false))
    {
      all.emplace_back(choice->request.node, choice->turn);
      reads.take(*choice);
    }
    return all;
  }

  std::shared_ptr<MadeUpReader> reader = std::make_shared<MadeUpReader>(points);
  std::shared_ptr<MemoryBudget> budget;
  NodeCache cache;
  WaitingReads reads;
};

using Order = std::vector<std::pair<NodeIndex, int>>;

} // namespace

TEST(WaitingReads, WhatIsDrawnThenWhatIsNeededThenOtherColumnsThenTheRest)
{
  Waiting waiting(10);
  waiting.reads.replace({ wish(1, 5.0), wish(2, 9.0, true), wish(3, 7.0) });
  waiting.reads.readAgain(wish(4, 0.0));
  waiting.reads.readAgain(wish(5, WaitingReads::drawnNow));
  EXPECT_EQ(waiting.reads.size(), 5u);
  EXPECT_EQ(waiting.order(), (Order{ { 5, 0 }, { 3, 1 }, { 1, 1 }, { 4, 2 }, { 2, 4 } }));
  EXPECT_EQ(waiting.reads.size(), 0u);
}

TEST(WaitingReads, BytesAreOfAllButWhatIsOptional)
{
  Waiting waiting(10);
  const std::size_t one = waiting.reader->trueBytes(0, {});
  waiting.reads.replace({ wish(1, 5.0), wish(2, 9.0, true), wish(3, 7.0) });
  waiting.reads.readAgain(wish(4, 0.0));
  EXPECT_EQ(waiting.reads.bytes(), 3 * one);
  waiting.reads.learn(1, 2 * one);
  EXPECT_EQ(waiting.reads.bytes(), 4 * one);
  waiting.reads.cancelReread(4);
  EXPECT_EQ(waiting.reads.bytes(), 3 * one);
  waiting.reads.clear();
  EXPECT_EQ(waiting.reads.bytes(), 0u);
}

TEST(WaitingReads, WhatIsLargerThanTheBudgetIsListedAndWaitsNoMore)
{
  Waiting waiting(2);
  const std::size_t one = waiting.reader->trueBytes(0, {});
  waiting.reads.learn(1, 3 * one);
  const WaitingReads::Replaced replaced = waiting.reads.replace({ wish(1, 5.0), wish(2, 4.0) });
  EXPECT_EQ(replaced.change.added, 2u);
  ASSERT_EQ(replaced.tooLarge.size(), 1u);
  EXPECT_EQ(replaced.tooLarge[0], std::make_pair(NodeIndex(1), 3 * one));
  EXPECT_EQ(replaced.limit, 2 * one);
  EXPECT_EQ(waiting.order(), (Order{ { 2, 1 } }));
  EXPECT_FALSE(waiting.reads.mayFit(1, 2 * one));
  EXPECT_TRUE(waiting.reads.mayFit(1, 3 * one));
  EXPECT_TRUE(waiting.reads.mayFit(7, 0)) << "nothing is known of it";
}

TEST(WaitingReads, WhatDoesNotFitLetsSmallerOnesPass)
{
  Waiting waiting(4);
  const std::size_t one = waiting.reader->trueBytes(0, {});
  waiting.reads.learn(1, 3 * one);
  waiting.reads.replace({ wish(1, 5.0), wish(2, 4.0) });
  ASSERT_TRUE(waiting.budget->reserve(2 * one));
  EXPECT_EQ(waiting.order(), (Order{ { 2, 1 } }));
  waiting.budget->giveBack(one);
  EXPECT_EQ(waiting.order(), (Order{ { 1, 1 } }));
}

TEST(WaitingReads, OldPointsMayGoWhenNothingElseFitsAndNobodyDrawsThem)
{
  Waiting waiting(1);
  const std::size_t one = waiting.reader->trueBytes(0, {});
  ASSERT_TRUE(waiting.budget->reserve(one));
  waiting.cache.insert(4, waiting.reader->read(4, {}).value(), one);
  waiting.reads.setColumns(ColumnSelection(), { wish(4, 0.0) });
  EXPECT_FALSE(waiting.reads.choose(waiting.cache, false));
  auto held = waiting.cache.find(4)->points;
  EXPECT_FALSE(waiting.reads.choose(waiting.cache, true)) << "somebody draws them";
  held.reset();
  const auto choice = waiting.reads.choose(waiting.cache, true);
  ASSERT_TRUE(choice);
  EXPECT_EQ(choice->request.node, 4u);
  EXPECT_TRUE(choice->reread);
  EXPECT_TRUE(choice->inPlaceOfOld);
}

} // namespace pointfront
