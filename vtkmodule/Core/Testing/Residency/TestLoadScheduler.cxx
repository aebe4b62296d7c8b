// Several stores on one scheduler (SMOOTH-8).

#include "pointfront/Residency/LoadScheduler.h"
#include "pointfront/Residency/Residency.h"

#include "MadeUpReader.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace pointfront
{
namespace
{

using test::MadeUpReader;
using State = ResidencySnapshot::State;
using std::chrono::milliseconds;

std::vector<LoadRequest> wish(NodeIndex first, NodeIndex end, double priority = 1.0)
{
  std::vector<LoadRequest> requests;
  for (NodeIndex n = first; n < end; ++n)
  {
    requests.push_back({ n, priority, false });
  }
  return requests;
}

std::uint32_t needed(NodeIndex)
{
  return 0;
}

/// `count` stores of 100 nodes each, in one memory that holds `nodes` of them.
struct Scene
{
  explicit Scene(std::size_t count, std::size_t nodes = 1000, unsigned threads = 2,
    milliseconds overdueAfter = std::chrono::minutes(10))
  {
    LoadSchedulerOptions options;
    options.budgetBytes = nodes * MadeUpReader().trueBytes(0, {});
    options.threads = threads;
    options.overdueAfter = overdueAfter;
    scheduler = std::make_shared<LoadScheduler>(options);
    for (std::size_t s = 0; s < count; ++s)
    {
      readers.push_back(std::make_shared<MadeUpReader>());
      readers.back()->diskNumber = s;
      stores.push_back(std::make_unique<Residency>(readers.back(), 100, scheduler, 100 * (s + 1)));
    }
  }
  void waitUntilIdle() const
  {
    for (const auto& store : stores)
    {
      store->waitUntilIdle();
    }
  }
  std::shared_ptr<LoadScheduler> scheduler;
  std::vector<std::shared_ptr<MadeUpReader>> readers;
  std::vector<std::unique_ptr<Residency>> stores;
};

/// Counts how many fetch and decode at a time. Both take a moment.
class Watched final : public NodeReader
{
public:
  struct Counts
  {
    std::atomic<int> fetching{ 0 };
    std::atomic<int> fetchingMax{ 0 };
    std::atomic<int> decoding{ 0 };
    std::atomic<int> decodingMax{ 0 };
  };
  explicit Watched(std::shared_ptr<Counts> counts)
    : counts_(std::move(counts))
  {
  }
  Result<FetchedNode> fetch(NodeIndex node, const ColumnSelection& columns) const override
  {
    pass(counts_->fetching, counts_->fetchingMax, milliseconds(1));
    return FetchedNode{ node, columns, {}, 1 };
  }
  Result<NodeColumns> decode(const FetchedNode& fetched) const override
  {
    pass(counts_->decoding, counts_->decodingMax, milliseconds(5));
    NodeColumns result;
    result.node = fetched.node;
    return result;
  }
  std::size_t decodedBytes(NodeIndex, std::uint32_t, const ColumnSelection&) const override
  {
    return sizeof(NodeColumns);
  }
  std::size_t storedBytes(NodeIndex, const ColumnSelection&) const override { return 1; }

private:
  static void pass(std::atomic<int>& now, std::atomic<int>& max, milliseconds time)
  {
    const int there = ++now;
    int most = max;
    while (most < there && !max.compare_exchange_weak(most, there))
    {
    }
    std::this_thread::sleep_for(time);
    --now;
  }
  std::shared_ptr<Counts> counts_;
};

} // namespace

TEST(LoadScheduler, ReadsOneAtATimeAndDecodesInParallelOverAllStores)
{
  LoadSchedulerOptions options;
  options.threads = 4;
  options.overdueAfter = std::chrono::seconds(60);
  const auto scheduler = std::make_shared<LoadScheduler>(options);
  const auto counts = std::make_shared<Watched::Counts>();
  std::vector<std::unique_ptr<Residency>> stores;
  for (int s = 0; s < 5; ++s)
  {
    stores.push_back(
      std::make_unique<Residency>(std::make_shared<Watched>(counts), 100, scheduler));
    stores.back()->request(wish(0, 12));
  }
  for (const auto& store : stores)
  {
    store->waitUntilIdle();
    EXPECT_EQ(store->arrivals(), 12u);
  }
  EXPECT_EQ(counts->fetchingMax, 1);
  EXPECT_GT(counts->decodingMax, 1);
  EXPECT_EQ(scheduler->statistics().threads, 4u);
}

TEST(LoadScheduler, AHundredStoresShareThreadsAndMemory)
{
  Scene scene(100, 250);
  for (const auto& store : scene.stores)
  {
    store->request(wish(0, 5));
    store->release(needed);
  }
  scene.waitUntilIdle();
  const LoadSchedulerStatistics s = scene.scheduler->statistics();
  EXPECT_EQ(s.stores, 100u);
  EXPECT_EQ(s.threads, 2u);
  EXPECT_EQ(s.residentBytes, 250 * scene.readers[0]->trueBytes(0, {}));
  EXPECT_EQ(s.residentBytesMax, s.residentBytes);
  EXPECT_EQ(s.decodedBytes, s.residentBytes) << "nothing was read twice";
  EXPECT_GT(s.decodeSeconds, 0.0);
  EXPECT_GT(s.fetchSeconds, 0.0);
}

TEST(LoadScheduler, TheLargestErrorOfAllStoresComesFirst)
{
  Scene scene(3, 1000, 1);
  scene.readers[0]->closeGate();
  scene.stores[0]->request({ { 9, 100.0, false } });
  scene.readers[0]->awaitReads(1);
  // While that one is read:
  scene.readers[1]->breakNode(1);
  std::vector<NodeIndex> order;
  std::mutex mutex;
  for (NodeIndex s = 0; s < 3; ++s)
  {
    scene.stores[s]->setArrivalFunction(
      [&, s]
      {
        const std::lock_guard<std::mutex> lock(mutex);
        order.push_back(s);
      });
  }
  scene.stores[1]->request({ { 1, 5.0, false }, { 2, 90.0, true } });
  scene.stores[2]->request({ { 1, 7.0, false }, { 2, 3.0, false } });
  scene.readers[0]->openGate();
  scene.waitUntilIdle();
  EXPECT_EQ(order, (std::vector<NodeIndex>{ 0, 2, 1, 2, 1 }));
}

TEST(LoadScheduler, MemoryIsTakenFromTheFarthestOfAllStores)
{
  Scene scene(3, 6);
  scene.stores[0]->request(wish(0, 3));
  scene.stores[0]->release([](NodeIndex n) { return n; }); // 0, 1, 2 levels under its front
  scene.stores[1]->request(wish(0, 3));
  scene.stores[1]->release([](NodeIndex n) { return n == 0 ? 0u : 5u + n; });
  scene.waitUntilIdle();
  scene.stores[2]->request(wish(0, 3));
  scene.stores[2]->release(needed);
  scene.waitUntilIdle();
  for (NodeIndex n = 0; n < 3; ++n)
  {
    EXPECT_EQ(scene.stores[2]->state(n), State::Resident);
  }
  EXPECT_EQ(scene.stores[0]->state(2), State::Absent);
  EXPECT_EQ(scene.stores[0]->state(1), State::Resident);
  EXPECT_EQ(scene.stores[1]->state(2), State::Absent);
  EXPECT_EQ(scene.stores[1]->state(1), State::Absent);
  EXPECT_EQ(scene.stores[1]->state(0), State::Resident);
  // A node that any front needs stays, whoever asks.
  for (int again = 0; again < 2; ++again)
  {
    scene.stores[2]->request(wish(3, 9));
    scene.stores[2]->release(needed);
    scene.waitUntilIdle();
  }
  EXPECT_EQ(scene.stores[0]->state(0), State::Resident);
  EXPECT_EQ(scene.stores[1]->state(0), State::Resident);
  EXPECT_TRUE(scene.stores[2]->exhausted());
}

TEST(LoadScheduler, AStoresOwnBudgetHoldsInsideTheCommonOne)
{
  Scene scene(2, 10);
  const std::size_t one = scene.readers[0]->trueBytes(0, {});
  scene.stores[0]->setBudgetBytes(3 * one);
  EXPECT_EQ(scene.stores[0]->budgetBytes(), 3 * one);
  EXPECT_EQ(scene.stores[1]->budgetBytes(), 10 * one);
  scene.stores[0]->request(wish(0, 6));
  scene.stores[1]->request(wish(0, 20));
  scene.waitUntilIdle();
  EXPECT_EQ(scene.stores[0]->statistics().residentNodes, 3u);
  EXPECT_EQ(scene.stores[1]->statistics().residentNodes, 7u);
  // Its own shortage is not paid for by others.
  scene.stores[1]->request({});
  scene.stores[1]->release([](NodeIndex) { return 9u; });
  scene.stores[0]->request(wish(10, 12));
  scene.stores[0]->release([](NodeIndex n) { return n < 10 ? 1u : 0u; });
  scene.waitUntilIdle();
  EXPECT_EQ(scene.stores[0]->state(10), State::Resident);
  EXPECT_EQ(scene.stores[0]->statistics().residentBytesMax, 3 * one);
  EXPECT_EQ(scene.stores[1]->statistics().residentNodes, 7u);
}

TEST(LoadScheduler, AStoreThatGoesGivesItsMemoryToTheOthers)
{
  Scene scene(2, 6);
  scene.stores[0]->request(wish(0, 6));
  scene.stores[0]->waitUntilIdle();
  scene.stores[1]->request(wish(0, 6));
  scene.stores[1]->release(needed);
  EXPECT_EQ(scene.stores[1]->statistics().residentNodes, 0u);
  scene.stores[0].reset();
  scene.stores[1]->waitUntilIdle();
  EXPECT_EQ(scene.stores[1]->statistics().residentNodes, 6u);
  EXPECT_EQ(scene.scheduler->statistics().stores, 1u);
}

TEST(LoadScheduler, RemovalWithdrawsWhatWaitsAndWaitsForTheRunningReadOnly)
{
  Scene scene(2);
  scene.readers[0]->closeGate();
  scene.stores[0]->request(wish(0, 50));
  scene.readers[0]->awaitReads(1);
  std::thread opener(
    [&]
    {
      while (scene.scheduler->statistics().stores > 1)
      {
        std::this_thread::yield(); // until the removal has begun
      }
      scene.readers[0]->letThrough(1);
    });
  scene.stores[0].reset();
  opener.join();
  EXPECT_EQ(scene.readers[0]->order().size(), 1u);
  EXPECT_EQ(scene.scheduler->statistics().residentBytes, 0u);
}

TEST(LoadScheduler, AHangingReadHoldsUpNobodyElse)
{
  Scene scene(4, 1000, 2, milliseconds(30));
  for (const std::size_t hanging : { 0, 1 })
  {
    scene.readers[hanging]->closeGate();
    scene.stores[hanging]->request(wish(0, 3, 100.0)); // the most urgent of all
  }
  scene.readers[0]->awaitReads(1);
  scene.stores[2]->request(wish(0, 20));
  scene.stores[3]->request(wish(0, 20));
  scene.stores[2]->waitUntilIdle();
  scene.stores[3]->waitUntilIdle();
  EXPECT_EQ(scene.stores[2]->arrivals(), 20u);
  EXPECT_EQ(scene.stores[3]->arrivals(), 20u);
  scene.readers[1]->awaitReads(1);
  std::this_thread::sleep_for(milliseconds(60));
  EXPECT_EQ(scene.scheduler->statistics().overdueReads, 2u);
  EXPECT_LE(scene.scheduler->statistics().threads, 4u);
  // One that hangs is not waited for when its store goes; its memory follows when it comes back.
  scene.stores[0].reset();
  EXPECT_EQ(scene.scheduler->statistics().stores, 3u);
  scene.readers[0]->openGate();
  scene.readers[1]->openGate();
  scene.stores[1]->waitUntilIdle();
  EXPECT_EQ(scene.stores[1]->arrivals(), 3u);
  const std::size_t one = scene.readers[0]->trueBytes(0, {});
  for (int wait = 0; wait < 1000 && scene.scheduler->statistics().residentBytes != 43 * one; ++wait)
  {
    std::this_thread::sleep_for(milliseconds(1));
  }
  EXPECT_EQ(scene.scheduler->statistics().residentBytes, 43 * one);
  // The spare threads go again.
  for (int wait = 0; wait < 1000 && scene.scheduler->statistics().threads > 2; ++wait)
  {
    std::this_thread::sleep_for(milliseconds(1));
  }
  EXPECT_EQ(scene.scheduler->statistics().threads, 2u);
}

TEST(LoadScheduler, EndsWithAReadThatHangs)
{
  auto reader = std::make_shared<MadeUpReader>();
  reader->closeGate();
  {
    Scene scene(1, 1000, 2, milliseconds(30));
    Residency hanging(reader, 100, scene.scheduler);
    hanging.request(wish(0, 3));
    reader->awaitReads(1);
    std::this_thread::sleep_for(milliseconds(60));
  }
  EXPECT_EQ(reader->order().size(), 1u);
  reader->openGate();
  while (reader.use_count() > 1) // the thread drops what it holds
  {
    std::this_thread::sleep_for(milliseconds(1));
  }
}

TEST(LoadScheduler, AFileThatIsGoneIsToldOfOnceAndFailsEachNode)
{
  class Vanished final : public NodeReader
  {
  public:
    Result<FetchedNode> fetch(NodeIndex node, const ColumnSelection&) const override
    {
      return makeError(
        Error::Kind::Unreadable, "cannot read 'x' at byte " + std::to_string(100 * node));
    }
    Result<NodeColumns> decode(const FetchedNode&) const override { return NodeColumns(); }
    std::size_t decodedBytes(NodeIndex, std::uint32_t, const ColumnSelection&) const override
    {
      return 100;
    }
    std::size_t storedBytes(NodeIndex, const ColumnSelection&) const override { return 100; }
  };
  Scene scene(1);
  Residency vanished(std::make_shared<Vanished>(), 100, scene.scheduler);
  vanished.request(wish(0, 10));
  scene.stores[0]->request(wish(0, 10));
  vanished.waitUntilIdle();
  scene.waitUntilIdle();
  EXPECT_EQ(scene.stores[0]->arrivals(), 10u);
  for (NodeIndex n = 0; n < 10; ++n)
  {
    EXPECT_EQ(vanished.state(n), State::Failed);
  }
  EXPECT_EQ(vanished.statistics().failed, 10u);
  const std::vector<Error> errors = vanished.takeErrors();
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].what.find("cannot read 'x' at byte"), std::string::npos);
}

TEST(LoadScheduler, AWaitThatHasAnEndEnds)
{
  Scene scene(1);
  scene.readers[0]->closeGate();
  scene.stores[0]->request(wish(0, 1));
  scene.readers[0]->awaitReads(1);
  scene.stores[0]->waitForArrival(0, milliseconds(20));
  EXPECT_EQ(scene.stores[0]->arrivals(), 0u);
  scene.readers[0]->openGate();
  scene.stores[0]->waitForArrival(0, std::chrono::seconds(20));
  EXPECT_EQ(scene.stores[0]->arrivals(), 1u);
}

TEST(LoadScheduler, SharesAreInProportionToSize)
{
  Scene scene(4); // 100, 200, 300, 400 points
  EXPECT_DOUBLE_EQ(scene.stores[0]->shareOfAll(), 0.1);
  EXPECT_DOUBLE_EQ(scene.stores[3]->shareOfAll(), 0.4);
  scene.stores[3].reset();
  EXPECT_DOUBLE_EQ(scene.stores[2]->shareOfAll(), 0.5);
}

TEST(LoadScheduler, TheProcessHasOneAndItsBudgetIsSetOnce)
{
  const std::size_t before = LoadScheduler::processBudgetBytes();
  LoadScheduler::setProcessBudgetBytes(12345);
  {
    const auto one = LoadScheduler::ofProcess();
    EXPECT_EQ(LoadScheduler::ofProcess(), one);
    EXPECT_EQ(one->budget()->limit(), 12345u);
    Residency residency(std::make_shared<MadeUpReader>(), 100, one);
    EXPECT_EQ(residency.budgetBytes(), 12345u);
    LoadScheduler::setProcessBudgetBytes(23456);
    EXPECT_EQ(residency.budgetBytes(), 23456u);
  }
  EXPECT_EQ(LoadScheduler::ofProcess()->budget()->limit(), 23456u); // a new one, the same budget
  LoadScheduler::setProcessBudgetBytes(before);
}

} // namespace pointfront
