#include "pointfront/Residency/Residency.h"

#include "MadeUpReader.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <random>
#include <thread>

namespace pointfront
{
namespace
{

using test::MadeUpReader;
using State = ResidencySnapshot::State;

/// One loader: reads happen in the order of the queue. Room for `nodes` nodes of `reader`.
ResidencyOptions roomFor(const MadeUpReader& reader, std::size_t nodes, unsigned threads = 1)
{
  ResidencyOptions options;
  options.budgetBytes = nodes * reader.trueBytes(0, {});
  options.loaderThreads = threads;
  return options;
}

std::vector<LoadRequest> wish(const std::vector<NodeIndex>& nodes)
{
  std::vector<LoadRequest> requests;
  for (const NodeIndex node : nodes)
  {
    requests.push_back({ node, 100.0 - double(requests.size()), false });
  }
  return requests;
}

using Nodes = std::vector<NodeIndex>;

} // namespace

TEST(Residency, BringsInWhatIsAskedForByPriority)
{
  const auto reader = std::make_shared<MadeUpReader>();
  reader->closeGate();
  Residency residency(reader, 100, roomFor(*reader, 10));
  residency.request({ { 9, 0.5, false } });
  reader->awaitReads(1); // 9 is under way and cannot be overtaken any more
  residency.request({ { 1, 1.0, false }, { 2, 5.0, false }, { 3, 7.0, true }, { 4, 2.0, false } });
  EXPECT_EQ(residency.state(9), State::Absent);
  EXPECT_EQ(residency.find(9), nullptr);
  reader->openGate();
  residency.waitUntilIdle();
  EXPECT_EQ(reader->order(), (Nodes{ 9, 2, 4, 1, 3 }));
  ASSERT_EQ(residency.state(2), State::Resident);
  EXPECT_EQ(residency.find(2)->size(), 100u);
  EXPECT_EQ(residency.find(2)->node, 2u);
  const ResidencyStatistics s = residency.statistics();
  EXPECT_EQ(s.residentNodes, 5u);
  EXPECT_EQ(s.residentBytes, 5 * reader->trueBytes(0, {}));
  EXPECT_EQ(s.pending + s.loading, 0u);
  EXPECT_EQ(s.bytesRead, 5 * reader->storedBytes(0, {}));
  EXPECT_EQ(residency.arrivals(), 5u);
}

TEST(Residency, ANewWishListCancelsWhatHasNotBegun)
{
  const auto reader = std::make_shared<MadeUpReader>();
  reader->closeGate();
  Residency residency(reader, 100, roomFor(*reader, 10));
  residency.request(wish({ 1, 2, 3 }));
  reader->awaitReads(1);
  residency.request(wish({ 3, 4 }));
  reader->openGate();
  residency.waitUntilIdle();
  EXPECT_EQ(reader->order(), (Nodes{ 1, 3, 4 }));
  EXPECT_EQ(residency.statistics().cancelled, 1u);
  EXPECT_EQ(residency.statistics().requested, 4u);
  EXPECT_EQ(residency.state(2), State::Absent);
}

TEST(Residency, WhatDoesNotFitWaitsUntilTheFarthestUnderTheFrontIsReleased)
{
  const auto reader = std::make_shared<MadeUpReader>();
  Residency residency(reader, 100, roomFor(*reader, 4));
  residency.request(wish({ 0, 1, 2, 3, 4, 5 }));
  residency.waitUntilIdle(); // returns although two wait
  EXPECT_EQ(residency.statistics().residentNodes, 4u);
  EXPECT_EQ(residency.statistics().pending, 2u);
  EXPECT_FALSE(residency.exhausted()) << "nobody has tried to make room yet";
  // node:      0 1 2 3
  // distance:  0 1 3 3   two must go: both of distance 3
  residency.release([](NodeIndex n) { return n == 0 ? 0u : n == 1 ? 1u : 3u; });
  residency.waitUntilIdle();
  EXPECT_EQ(residency.state(1), State::Resident);
  EXPECT_EQ(residency.state(2), State::Absent);
  EXPECT_EQ(residency.state(3), State::Absent);
  EXPECT_EQ(residency.state(4), State::Resident);
  EXPECT_EQ(residency.state(5), State::Resident);
  EXPECT_EQ(residency.statistics().released, 2u);
  EXPECT_EQ(residency.statistics().residentBytesMax, 4 * reader->trueBytes(0, {}));
}

TEST(Residency, TheFrontItselfStaysAndTheResidencyIsExhausted)
{
  const auto reader = std::make_shared<MadeUpReader>();
  Residency residency(reader, 100, roomFor(*reader, 3));
  residency.request(wish({ 0, 1, 2, 3 }));
  residency.waitUntilIdle();
  residency.release([](NodeIndex) { return 0u; });
  residency.waitUntilIdle();
  EXPECT_TRUE(residency.exhausted());
  EXPECT_EQ(residency.state(3), State::Absent);
  residency.setBudgetBytes(4 * reader->trueBytes(0, {}));
  residency.waitUntilIdle();
  EXPECT_EQ(residency.state(3), State::Resident);
  EXPECT_FALSE(residency.statistics().pending);
}

TEST(Residency, OptionalRequestsNeverMakeRoom)
{
  const auto reader = std::make_shared<MadeUpReader>();
  Residency residency(reader, 100, roomFor(*reader, 2));
  residency.request({ { 0, 1.0, false }, { 1, 1.0, false }, { 2, 9.0, true } });
  residency.waitUntilIdle();
  residency.release([](NodeIndex) { return 5u; });
  EXPECT_EQ(residency.state(0), State::Resident);
  EXPECT_EQ(residency.state(1), State::Resident);
  EXPECT_EQ(residency.statistics().released, 0u);
}

TEST(Residency, ReleasedPointsCountUntilTheyAreDropped)
{
  const auto reader = std::make_shared<MadeUpReader>();
  Residency residency(reader, 100, roomFor(*reader, 2));
  residency.request(wish({ 0, 1 }));
  residency.waitUntilIdle();
  std::shared_ptr<const NodeColumns> held = residency.find(0);
  residency.request(wish({ 2 }));
  residency.release([](NodeIndex n) { return n == 0 ? 2u : 1u; });
  residency.waitUntilIdle();
  EXPECT_EQ(residency.state(0), State::Absent);
  EXPECT_EQ(residency.state(2), State::Absent) << "its room is still taken";
  EXPECT_EQ(residency.statistics().residentBytes, 2 * reader->trueBytes(0, {}));
  // A second release does not take more for the same want.
  residency.release([](NodeIndex) { return 1u; });
  EXPECT_EQ(residency.state(1), State::Resident);
  EXPECT_FALSE(residency.exhausted());
  EXPECT_EQ(held->size(), 100u);
  held.reset();
  residency.waitUntilIdle();
  EXPECT_EQ(residency.state(2), State::Resident);
}

TEST(Residency, PointsOutliveTheResidency)
{
  const auto reader = std::make_shared<MadeUpReader>();
  std::shared_ptr<const NodeColumns> held;
  {
    Residency residency(reader, 100, roomFor(*reader, 2));
    residency.request(wish({ 5 }));
    residency.waitUntilIdle();
    held = residency.find(5);
  }
  ASSERT_NE(held, nullptr);
  EXPECT_EQ(held->positions.back(), glm::u32vec3(99));
}

TEST(Residency, AFailureIsReportedOnceAndNotTriedAgain)
{
  const auto reader = std::make_shared<MadeUpReader>();
  reader->breakNode(1);
  reader->throwAt(2);
  Residency residency(reader, 100, roomFor(*reader, 10));
  for (int again = 0; again < 3; ++again)
  {
    residency.request(wish({ 0, 1, 2 }));
    residency.waitUntilIdle();
  }
  EXPECT_EQ(residency.state(0), State::Resident);
  EXPECT_EQ(residency.state(1), State::Failed);
  EXPECT_EQ(residency.state(2), State::Failed);
  EXPECT_EQ(reader->order(), (Nodes{ 0, 1, 2 }));
  const std::vector<Error> errors = residency.takeErrors();
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_EQ(errors[0].kind, Error::Kind::Corrupt);
  EXPECT_NE(errors[1].what.find("node 2: made to throw"), std::string::npos);
  EXPECT_TRUE(residency.takeErrors().empty());
  EXPECT_EQ(residency.statistics().failed, 2u);
  EXPECT_EQ(residency.statistics().residentBytes, reader->trueBytes(0, {}));
}

TEST(Residency, ANodeLargerThanTheBudgetIsRefusedAloud)
{
  const auto reader = std::make_shared<MadeUpReader>();
  ResidencyOptions options = roomFor(*reader, 1);
  options.budgetBytes -= 1;
  Residency residency(reader, 100, options);
  residency.request(wish({ 3 }));
  residency.waitUntilIdle();
  EXPECT_EQ(residency.state(3), State::Failed);
  const std::vector<Error> errors = residency.takeErrors();
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].kind, Error::Kind::NoMemory);
  EXPECT_TRUE(reader->order().empty());
  residency.setBudgetBytes(options.budgetBytes + 1);
  residency.request(wish({ 3 }));
  residency.waitUntilIdle();
  EXPECT_EQ(residency.state(3), State::Resident);
}

TEST(Residency, AReaderThatPromisedTooLittleDoesNotBreakTheBudget)
{
  const auto reader = std::make_shared<MadeUpReader>();
  reader->promised = 64;
  Residency residency(reader, 100, roomFor(*reader, 2));
  residency.request(wish({ 0, 1, 2 }));
  residency.waitUntilIdle();
  EXPECT_EQ(residency.statistics().residentNodes, 2u);
  EXPECT_EQ(residency.statistics().residentBytes, 2 * reader->trueBytes(0, {}));
  EXPECT_LE(residency.statistics().residentBytesMax, 2 * reader->trueBytes(0, {}));
  residency.request(wish({ 2 }));
  residency.release([](NodeIndex n) { return n + 1; });
  residency.waitUntilIdle();
  EXPECT_EQ(residency.state(0), State::Resident);
  EXPECT_EQ(residency.state(1), State::Absent);
}

TEST(Residency, NewColumnsAreReadWhileTheOldStay)
{
  const auto reader = std::make_shared<MadeUpReader>();
  ResidencyOptions options = roomFor(*reader, 20);
  Residency residency(reader, 100, options);
  residency.request(wish({ 0, 1, 2, 3 }));
  residency.waitUntilIdle();
  const std::uint64_t arrivals = residency.arrivals();
  const std::uint64_t revision = residency.revision();
  reader->closeGate();
  residency.setColumns({ 0, 2 });
  EXPECT_EQ(residency.columns(), (ColumnSelection{ 0, 2 }));
  reader->awaitReads(1);
  for (NodeIndex n = 0; n < 4; ++n)
  {
    EXPECT_EQ(residency.state(n), State::Resident);
    ASSERT_NE(residency.find(n), nullptr);
    EXPECT_TRUE(residency.find(n)->selection.empty());
  }
  reader->openGate();
  residency.waitUntilIdle();
  for (NodeIndex n = 0; n < 4; ++n)
  {
    EXPECT_EQ(residency.find(n)->selection, (ColumnSelection{ 0, 2 }));
  }
  EXPECT_EQ(residency.arrivals(), arrivals + 4);
  EXPECT_GT(residency.revision(), revision);
  EXPECT_EQ(residency.statistics().residentBytes, 4 * reader->trueBytes(0, { 0, 2 }));
  // Fewer columns are there already.
  residency.setColumns({ 2 });
  residency.waitUntilIdle();
  EXPECT_EQ(reader->order().size(), 8u);
}

TEST(Residency, NodesThatAreDrawnAreReadAgainFirst)
{
  const auto reader = std::make_shared<MadeUpReader>();
  Residency residency(reader, 100, roomFor(*reader, 40));
  residency.request(wish({ 0, 1, 2, 3, 4 }));
  residency.waitUntilIdle();
  reader->closeGate();
  residency.setColumns({ 1 });
  reader->awaitReads(1);
  residency.request(wish({ 9 }));
  EXPECT_NE(residency.find(4), nullptr);
  reader->openGate();
  residency.waitUntilIdle();
  const Nodes order = reader->order();
  ASSERT_EQ(order.size(), 11u);
  EXPECT_EQ(order[6], 4u) << "drawn with old columns";
  EXPECT_EQ(order[7], 9u) << "needed and missing";
}

TEST(Residency, NewColumnsArriveEvenWhenTheBudgetHoldsNothingElse)
{
  const auto reader = std::make_shared<MadeUpReader>();
  ResidencyOptions options;
  options.budgetBytes = 2 * reader->trueBytes(0, { 0 }) + 16;
  options.loaderThreads = 2;
  Residency residency(reader, 100, options);
  residency.request(wish({ 0, 1 }));
  residency.waitUntilIdle();
  residency.setColumns({ 0 });
  residency.waitUntilIdle();
  residency.release([](NodeIndex) { return 0u; });
  residency.waitUntilIdle();
  for (const NodeIndex n : { 0, 1 })
  {
    ASSERT_EQ(residency.state(n), State::Resident);
    EXPECT_EQ(residency.find(n)->selection, ColumnSelection{ 0 });
  }
  EXPECT_LE(residency.statistics().residentBytesMax, options.budgetBytes);
}

TEST(Residency, AFailureOfOneColumnIsForgottenWithIt)
{
  const auto reader = std::make_shared<MadeUpReader>();
  Residency residency(reader, 100, roomFor(*reader, 20));
  residency.setColumns({ 0 });
  reader->breakNode(1);
  residency.request(wish({ 1 }));
  residency.waitUntilIdle();
  EXPECT_EQ(residency.state(1), State::Failed);
  reader->mendNode(1);
  residency.setColumns({ 1 });
  EXPECT_EQ(residency.state(1), State::Absent);
  residency.request(wish({ 1 }));
  residency.waitUntilIdle();
  EXPECT_EQ(residency.state(1), State::Resident);
}

TEST(Residency, ALowerBudgetIsReachedByTheNextRelease)
{
  const auto reader = std::make_shared<MadeUpReader>();
  Residency residency(reader, 100, roomFor(*reader, 4));
  residency.request(wish({ 0, 1, 2, 3 }));
  residency.waitUntilIdle();
  residency.setBudgetBytes(2 * reader->trueBytes(0, {}));
  residency.release([](NodeIndex n) { return n; });
  EXPECT_EQ(residency.statistics().residentNodes, 2u);
  EXPECT_EQ(residency.state(0), State::Resident);
  EXPECT_EQ(residency.state(1), State::Resident);
}

TEST(Residency, TellsOfEachArrivalAndWakesWhoWaits)
{
  const auto reader = std::make_shared<MadeUpReader>();
  reader->closeGate();
  Residency residency(reader, 100, roomFor(*reader, 10));
  std::atomic<int> told{ 0 };
  residency.setArrivalFunction([&] { ++told; });
  residency.request(wish({ 0, 1 }));
  reader->letThrough(1);
  residency.waitForArrival(0);
  EXPECT_EQ(residency.arrivals(), 1u);
  EXPECT_EQ(residency.state(0), State::Resident);
  reader->openGate();
  residency.waitForArrival(1);
  residency.waitForArrival(2); // nothing more comes: it ends nevertheless
  EXPECT_EQ(residency.arrivals(), 2u);
  residency.setArrivalFunction(nullptr);
  EXPECT_EQ(told, 2);
}

TEST(Residency, EndsCleanlyWithReadsUnderWay)
{
  const auto reader = std::make_shared<MadeUpReader>();
  reader->closeGate();
  auto residency = std::make_unique<Residency>(reader, 100, roomFor(*reader, 10, 3));
  residency->request(wish({ 0, 1, 2, 3, 4, 5 }));
  reader->awaitReads(1);
  residency->request({});
  std::thread opener([&] { reader->openGate(); });
  residency.reset(); // waits for the one
  opener.join();
  EXPECT_EQ(reader->order().size(), 1u);
}

} // namespace pointfront
