#include "pointfront/Residency/DiskLane.h"

#include <gtest/gtest.h>

namespace pointfront
{
namespace
{

using Milliseconds = std::chrono::milliseconds;

/// Any pointers: stores on disk 1, 1, 1 and 2.
const int stores[4] = {};

DiskLane::Clock::time_point at(int ms)
{
  return DiskLane::Clock::time_point() + Milliseconds(ms);
}

} // namespace

TEST(DiskLane, LetsOneReadInAtATime)
{
  DiskLane lane(Milliseconds(100));
  EXPECT_FALSE(lane.busy(at(0)));
  const DiskLane::Ticket first = lane.enter(&stores[0], 1, at(0));
  EXPECT_TRUE(lane.busy(at(99)));
  EXPECT_EQ(lane.freeAt(at(50)), at(100));
  lane.leave(first);
  EXPECT_FALSE(lane.busy(at(60)));
  EXPECT_EQ(lane.freeAt(at(60)), std::nullopt);
}

TEST(DiskLane, AnOverdueReadHoldsUpItsOwnStoreOnly)
{
  DiskLane lane(Milliseconds(100));
  const DiskLane::Ticket hanging = lane.enter(&stores[0], 1, at(0));
  EXPECT_FALSE(lane.busy(at(100)));
  EXPECT_EQ(lane.overdue(at(100)), 1u);
  EXPECT_TRUE(lane.overdue(&stores[0], at(100)));
  EXPECT_FALSE(lane.overdue(&stores[1], at(100)));
  EXPECT_TRUE(lane.barred(&stores[0], 1, at(100)));
  EXPECT_FALSE(lane.barred(&stores[1], 1, at(100)));
  const DiskLane::Ticket second = lane.enter(&stores[1], 1, at(100));
  EXPECT_TRUE(lane.busy(at(150)));
  lane.leave(second);
  lane.leave(hanging);
  EXPECT_FALSE(lane.barred(&stores[0], 1, at(300)));
}

TEST(DiskLane, ADiskWithTwoOverdueReadsGetsNoThird)
{
  DiskLane lane(Milliseconds(100));
  lane.enter(&stores[0], 1, at(0));
  const DiskLane::Ticket second = lane.enter(&stores[1], 1, at(100));
  EXPECT_TRUE(lane.barred(&stores[2], 1, at(200)));
  EXPECT_FALSE(lane.barred(&stores[3], 2, at(200)));
  lane.leave(second);
  EXPECT_FALSE(lane.barred(&stores[2], 1, at(200)));
}

} // namespace pointfront
