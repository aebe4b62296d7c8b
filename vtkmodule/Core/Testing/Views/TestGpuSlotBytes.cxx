#include "pointfront/Views/GpuSlotBytes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

using namespace pointfront;

TEST(GpuSlotBytes, ASmallBudgetOfOneCloudIsUsedWhole)
{
  for (const int streams : { 0, 1, 3 })
  {
    for (std::int64_t slots = 1; slots <= 8; ++slots)
    {
      const std::int64_t budget = slots * GpuSlotBytes::of(streams);
      EXPECT_EQ(GpuSlotBytes::slotsWithin(budget, streams, 1), static_cast<std::uint64_t>(slots));
      EXPECT_EQ(GpuSlotBytes::slotsWithin(budget - 1, streams, 1),
        static_cast<std::uint64_t>(std::max<std::int64_t>(1, slots - 1)));
    }
  }
}

TEST(GpuSlotBytes, ALargeBudgetLeavesRoomForPartlyEmptyBlocks)
{
  const std::int64_t budget = 9000 * GpuSlotBytes::of(1);
  EXPECT_EQ(GpuSlotBytes::slotsWithin(budget, 1, 1), 8000u);
  EXPECT_EQ(GpuSlotBytes::slotsWithin(budget, 1, 90), 7920u) << "and of a slot for each cloud";
  EXPECT_EQ(GpuSlotBytes::slotsWithin(GpuSlotBytes::of(1), 1, 90), 1u);
}
