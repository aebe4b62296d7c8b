#include "MadeUpReader.h"

#include "pointfront/Residency/LoadScheduler.h"
#include "pointfront/Residency/Residency.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <vector>

namespace pointfront
{
namespace
{
using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

/// Nodes behind a line with a round trip. A batch that is held waits until it is stopped or let go.
class FarReader final : public NodeReader
{
public:
  explicit FarReader(std::uint64_t server, ReadCost cost = { 0.02, 12.5e6, 4, 1u << 20 })
    : server_(server)
    , cost_(cost)
  {
  }
  std::vector<Result<FetchedNode>> fetchAll(
    const std::vector<WantedNode>& wanted, const ReadStop& stop) const override
  {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      batches_.emplace_back();
      for (const WantedNode& want : wanted)
      {
        batches_.back().push_back(want.node);
      }
    }
    const int now = ++under;
    int most = underMost;
    while (most < now && !underMost.compare_exchange_weak(most, now))
    {
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(cost_.roundTripSeconds));
    while (held && !stop)
    {
      std::this_thread::sleep_for(milliseconds(1));
    }
    --under;
    std::vector<Result<FetchedNode>> fetched;
    for (const WantedNode& want : wanted)
    {
      fetched.push_back(
        stop ? makeError(Error::Kind::Cancelled, "stopped") : made_.fetch(want.node, want.columns));
    }
    return fetched;
  }
  Result<NodeColumns> decode(const FetchedNode& fetched) const override
  {
    return made_.decode(fetched);
  }
  std::size_t decodedBytes(
    NodeIndex node, std::uint32_t points, const ColumnSelection& columns) const override
  {
    return made_.decodedBytes(node, points, columns);
  }
  std::size_t storedBytes(NodeIndex node, const ColumnSelection& columns) const override
  {
    return made_.storedBytes(node, columns);
  }
  std::optional<std::uint64_t> place(NodeIndex node) const override
  {
    return placeOf ? std::optional<std::uint64_t>(placeOf(node)) : std::nullopt;
  }
  std::uint64_t disk() const override { return server_; }
  ReadCost readCost() const override { return cost_; }

  std::vector<std::vector<NodeIndex>> batches() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return batches_;
  }
  void breakNode(NodeIndex node) { made_.breakNode(node); }

  std::function<std::uint64_t(NodeIndex)> placeOf; ///< none: nobody knows
  std::atomic<bool> held{ false };
  mutable std::atomic<int> under{ 0 };
  mutable std::atomic<int> underMost{ 0 };

private:
  test::MadeUpReader made_;
  std::uint64_t server_;
  ReadCost cost_;
  mutable std::mutex mutex_;
  mutable std::vector<std::vector<NodeIndex>> batches_;
};

std::vector<LoadRequest> farWish(NodeIndex first, NodeIndex count)
{
  std::vector<LoadRequest> requests;
  for (NodeIndex n = first; n < first + count; ++n)
  {
    requests.push_back({ n, 0.5 - n * 1e-4, false, 100, 0 });
  }
  return requests;
}

std::shared_ptr<LoadScheduler> farScheduler(unsigned threads)
{
  LoadSchedulerOptions options;
  options.threads = threads;
  return std::make_shared<LoadScheduler>(options);
}

template <typename Condition>
bool farSoon(const Condition& condition)
{
  const Clock::time_point end = Clock::now() + std::chrono::seconds(20);
  while (!condition() && Clock::now() < end)
  {
    std::this_thread::sleep_for(milliseconds(1));
  }
  return condition();
}
} // namespace

TEST(FarLoading, WantedNodesComeInBatchesInTheirOrder)
{
  const auto reader = std::make_shared<FarReader>(7);
  Residency store(reader, 1000, farScheduler(2));
  store.request(farWish(0, 200));
  store.waitUntilIdle();
  EXPECT_EQ(store.arrivals(), 200u);
  const auto batches = reader->batches();
  EXPECT_LE(batches.size(), 5u) << "rounds, not nodes";
  std::set<NodeIndex> all;
  for (const auto& batch : batches)
  {
    EXPECT_TRUE(std::is_sorted(batch.begin(), batch.end())) << "most urgent first";
    all.insert(batch.begin(), batch.end());
  }
  EXPECT_EQ(all.size(), 200u);
  EXPECT_TRUE(store.takeErrors().empty());
}

TEST(FarLoading, ABatchHasWhatLiesNearItsFirstNodeInTheFile)
{
  // Nodes lie in the file in another order than they are wanted: 0, 50, 1, 51, ...
  const auto reader = std::make_shared<FarReader>(7, ReadCost{ 0.02, 12.5e6, 1, 10000 });
  reader->placeOf = [](NodeIndex node) { return node % 50 * 2 + node / 50; };
  Residency store(reader, 1000, farScheduler(1));
  store.request(farWish(0, 100));
  store.waitUntilIdle();
  EXPECT_EQ(store.arrivals(), 100u);
  const auto batches = reader->batches();
  EXPECT_GT(batches.size(), 3u);
  for (const auto& batch : batches)
  {
    const auto [low, high] = std::minmax_element(batch.begin(), batch.end(),
      [&](NodeIndex a, NodeIndex b) { return reader->placeOf(a) < reader->placeOf(b); });
    EXPECT_EQ(reader->placeOf(*high) - reader->placeOf(*low), batch.size() - 1) << "neighbours";
  }
}

TEST(FarLoading, AsManyBatchesAsTheSourceTakesAreUnderWay)
{
  // So little at once that each node is a batch.
  const auto reader = std::make_shared<FarReader>(7, ReadCost{ 0.02, 12.5e6, 4, 1 });
  const auto scheduler = farScheduler(2);
  {
    Residency store(reader, 1000, scheduler);
    store.request(farWish(0, 40));
    store.waitUntilIdle();
    EXPECT_EQ(store.arrivals(), 40u);
    EXPECT_EQ(reader->underMost, 4);
    EXPECT_LE(scheduler->statistics().threads, 2u + 4u);
  }
  EXPECT_TRUE(farSoon([&] { return scheduler->statistics().threads == 2u; })) << "given back";
}

TEST(FarLoading, AFarStoreHoldsUpNoDisk)
{
  const auto scheduler = farScheduler(2);
  const auto far = std::make_shared<FarReader>(7);
  far->held = true;
  Residency hanging(far, 1000, scheduler);
  hanging.request(farWish(0, 500));
  ASSERT_TRUE(farSoon([&] { return far->under == 4; }));
  const auto other = std::make_shared<FarReader>(8);
  Residency second(other, 1000, scheduler);
  Residency disk(std::make_shared<test::MadeUpReader>(), 1000, scheduler);
  second.request(farWish(0, 100));
  disk.request(farWish(0, 100));
  disk.waitUntilIdle();
  second.waitUntilIdle();
  EXPECT_EQ(disk.arrivals(), 100u);
  EXPECT_EQ(second.arrivals(), 100u);
  EXPECT_EQ(hanging.arrivals(), 0u);
  far->held = false;
  hanging.waitUntilIdle();
  EXPECT_EQ(hanging.arrivals(), 500u);
}

TEST(FarLoading, WhatTheViewNoLongerWantsIsStoppedAndCanComeLater)
{
  const auto reader = std::make_shared<FarReader>(7);
  reader->held = true;
  Residency store(reader, 1000, farScheduler(2));
  store.request(farWish(0, 10));
  ASSERT_TRUE(farSoon([&] { return reader->under == 1; }));
  store.request(farWish(5, 10)); // half of the batch is still wanted
  std::this_thread::sleep_for(milliseconds(30));
  EXPECT_EQ(store.arrivals(), 0u);
  store.request(farWish(500, 10));
  ASSERT_TRUE(farSoon(
    [&]
    {
      return store.state(0) == ResidencySnapshot::State::Absent &&
        store.statistics().loading <= 10u;
    }));
  reader->held = false;
  store.waitUntilIdle();
  EXPECT_EQ(store.state(0), ResidencySnapshot::State::Absent);
  EXPECT_EQ(store.state(505), ResidencySnapshot::State::Resident);
  EXPECT_EQ(store.statistics().failed, 0u);
  store.request(farWish(0, 10));
  store.waitUntilIdle();
  EXPECT_EQ(store.state(0), ResidencySnapshot::State::Resident);
  EXPECT_TRUE(store.takeErrors().empty());
}

TEST(FarLoading, LeavingDoesNotWaitForTheLine)
{
  const auto reader = std::make_shared<FarReader>(7);
  const auto scheduler = farScheduler(2);
  reader->held = true;
  {
    Residency store(reader, 1000, scheduler);
    store.request(farWish(0, 10));
    ASSERT_TRUE(farSoon([&] { return reader->under == 1; }));
  }
  EXPECT_TRUE(farSoon([&] { return reader->under == 0; })) << "it was told to stop";
}

TEST(FarLoading, AnErrorOfOneNodeIsItsOwn)
{
  const auto reader = std::make_shared<FarReader>(7);
  reader->breakNode(3);
  Residency store(reader, 1000, farScheduler(2));
  store.request(farWish(0, 10));
  store.waitUntilIdle();
  EXPECT_EQ(store.state(3), ResidencySnapshot::State::Failed);
  EXPECT_EQ(store.statistics().residentNodes, 9u);
  EXPECT_EQ(store.takeErrors().size(), 1u);
}

TEST(FarLoading, TheBudgetHolds)
{
  const auto reader = std::make_shared<FarReader>(7);
  LoadSchedulerOptions options;
  options.threads = 2;
  options.budgetBytes = 20 * reader->decodedBytes(0, 100, {});
  const auto scheduler = std::make_shared<LoadScheduler>(options);
  Residency store(reader, 1000, scheduler);
  store.request(farWish(0, 200));
  store.waitUntilIdle();
  EXPECT_LE(scheduler->statistics().residentBytesMax, options.budgetBytes);
  EXPECT_EQ(store.statistics().residentNodes, 20u);
}

} // namespace pointfront
