#include "pointfront/Residency/FarLanes.h"

#include <gtest/gtest.h>

#include <memory>

namespace pointfront
{
namespace
{
const int farStores[2] = {};

std::shared_ptr<ReadStop> stopOf()
{
  return std::make_shared<ReadStop>(false);
}
} // namespace

TEST(FarLanes, EachServerHasItsOwnDepth)
{
  FarLanes lanes;
  const ReadCost two{ 0.05, 0.0, 2, 0 };
  EXPECT_TRUE(lanes.open(7, two));
  const FarLanes::Ticket first = lanes.enter(&farStores[0], 7, stopOf());
  EXPECT_TRUE(lanes.open(7, two));
  lanes.enter(&farStores[1], 7, stopOf());
  EXPECT_FALSE(lanes.open(7, two));
  EXPECT_TRUE(lanes.open(8, two)) << "another server";
  lanes.leave(first);
  EXPECT_TRUE(lanes.open(7, two));
  EXPECT_EQ(lanes.count(&farStores[0]), 0u);
  EXPECT_EQ(lanes.count(&farStores[1]), 1u);
}

TEST(FarLanes, ThreadsAreBounded)
{
  FarLanes lanes;
  const ReadCost many{ 0.05, 0.0, 1000, 0 };
  std::uint64_t server = 0;
  while (lanes.open(server, many))
  {
    while (lanes.open(server, many))
    {
      lanes.enter(&farStores[0], server, stopOf());
    }
    ++server;
  }
  EXPECT_EQ(lanes.count(), FarLanes::mostOnAll);
  EXPECT_EQ(server, FarLanes::mostOnAll / FarLanes::mostOnALane);
  EXPECT_FALSE(lanes.open(99, many));
}

TEST(FarLanes, StopsTheBatchesOfAStore)
{
  FarLanes lanes;
  const auto own = stopOf();
  const auto other = stopOf();
  lanes.enter(&farStores[0], 7, own);
  lanes.enter(&farStores[1], 7, other);
  lanes.stop(&farStores[0]);
  EXPECT_TRUE(*own);
  EXPECT_FALSE(*other);
  lanes.stopAll();
  EXPECT_TRUE(*other);
}

} // namespace pointfront
