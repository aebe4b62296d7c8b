// Many stores on one scheduler: random requests, cancels, failures, columns, budgets, hanging
// reads, and stores that come and go. Made for ThreadSanitizer; without it, it checks budgets,
// accounts, and that nothing is lost.

#include "pointfront/Residency/LoadScheduler.h"
#include "pointfront/Residency/Residency.h"

#include "MadeUpReader.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <random>
#include <thread>

namespace pointfront
{
namespace
{

using test::MadeUpReader;

struct Store
{
  std::shared_ptr<MadeUpReader> reader;
  std::unique_ptr<Residency> residency;
};

class Soak
{
public:
  Soak(std::uint32_t seed, std::size_t budgetNodes)
    : random_(seed)
  {
    LoadSchedulerOptions options;
    budget_ = budgetNodes * MadeUpReader(200).trueBytes(0, { 0, 1 });
    options.budgetBytes = budget_;
    options.threads = 3;
    options.overdueAfter = std::chrono::milliseconds(2);
    scheduler_ = std::make_shared<LoadScheduler>(options);
    for (int s = 0; s < 12; ++s)
    {
      stores_.push_back(makeStore());
    }
  }

  std::uint32_t below(std::uint32_t end) { return static_cast<std::uint32_t>(random_() % end); }

  Store makeStore()
  {
    Store store;
    store.reader = std::make_shared<MadeUpReader>(200);
    store.reader->varyBy = 30;
    store.reader->diskNumber = below(4);
    for (int broken = 0; broken < 4; ++broken)
    {
      store.reader->breakNode(below(100));
    }
    store.residency = std::make_unique<Residency>(store.reader, 100, scheduler_, 20000);
    return store;
  }

  void step()
  {
    Store& store = stores_[below(12)];
    std::vector<LoadRequest> wanted;
    for (std::uint32_t r = below(25); r > 0; --r)
    {
      wanted.push_back({ below(100), double(below(50)), below(4) == 0 });
    }
    store.residency->request(wanted);
    const NodeIndex kept = below(100);
    store.residency->release([kept](NodeIndex n) { return n == kept ? 0u : 1u + n % 5; });
    held_[below(8)] = store.residency->find(below(100));
    switch (below(30))
    {
      case 0:
        store.residency->setColumns(below(2) == 0 ? ColumnSelection{ 1 } : ColumnSelection{ 0, 1 });
        break;
      case 1:
      {
        const auto old = store.reader;
        store = makeStore(); // the old one goes, perhaps in the middle of a read that hangs
        old->openGate();
        break;
      }
      case 2:
        store.reader->closeGate();
        break;
      case 3:
        store.residency->setBudgetBytes(budget_ / (1 + below(4)));
        break;
      default:
        store.reader->openGate();
    }
    EXPECT_LE(scheduler_->statistics().residentBytes, budget_);
  }

  void finish()
  {
    for (Store& store : stores_)
    {
      store.reader->openGate();
      store.residency->request({});
    }
    held_.assign(8, nullptr);
    std::size_t sum = 0;
    for (Store& store : stores_)
    {
      store.residency->waitUntilIdle();
      const ResidencyStatistics s = store.residency->statistics();
      EXPECT_EQ(s.loading, 0u);
      EXPECT_EQ(store.residency->takeErrors().size(), s.failed);
      sum += s.residentBytes;
    }
    const LoadSchedulerStatistics all = scheduler_->statistics();
    EXPECT_LE(all.residentBytesMax, budget_);
    EXPECT_EQ(all.stores, 12u);
    EXPECT_LE(all.threads, 3u + 8u);
    for (int wait = 0; wait < 2000 && scheduler_->statistics().residentBytes != sum; ++wait)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(1)); // removed stores hung
    }
    EXPECT_EQ(scheduler_->statistics().residentBytes, sum) << "nothing is lost on the account";
    // Every store still loads.
    for (Store& store : stores_)
    {
      store.residency->setBudgetBytes(budget_);
      store.residency->setColumns({});
      store.residency->request({ { 7, 1.0, false } });
      store.residency->release([](NodeIndex) { return 1u; });
      store.residency->waitUntilIdle();
      EXPECT_NE(store.residency->state(7), ResidencySnapshot::State::Absent);
    }
    stores_.clear();
    EXPECT_EQ(scheduler_->statistics().stores, 0u);
    EXPECT_EQ(scheduler_->statistics().residentBytes, 0u);
  }

  const LoadScheduler& scheduler() const { return *scheduler_; }
  std::size_t budget() const { return budget_; }

private:
  std::mt19937 random_;
  std::size_t budget_ = 0;
  std::shared_ptr<LoadScheduler> scheduler_;
  std::vector<Store> stores_;
  std::vector<std::shared_ptr<const NodeColumns>> held_{ 8 };
};

} // namespace

TEST(LoadSchedulerSoak, BudgetsAndAccountsHoldWhateverHappens)
{
  for (std::uint32_t seed = 1; seed <= 3; ++seed)
  {
    SCOPED_TRACE(seed);
    Soak soak(seed, 60);
    std::atomic<bool> done{ false };
    std::thread watcher(
      [&]
      {
        while (!done)
        {
          EXPECT_LE(soak.scheduler().statistics().residentBytes, soak.budget());
          std::this_thread::yield();
        }
      });
    for (int step = 0; step < 1500; ++step)
    {
      soak.step();
    }
    done = true;
    watcher.join();
    soak.finish();
  }
}

/// Two stores whose views together need more than the memory: what is needed stays, and at rest
/// nothing is read any more.
TEST(LoadSchedulerSoak, StoresDoNotThrashEachOther)
{
  LoadSchedulerOptions options;
  const auto reader = std::make_shared<MadeUpReader>(200);
  options.budgetBytes = 50 * reader->trueBytes(0, {});
  const auto scheduler = std::make_shared<LoadScheduler>(options);
  Residency one(reader, 100, scheduler);
  Residency two(reader, 100, scheduler);
  std::vector<LoadRequest> wanted;
  for (NodeIndex n = 0; n < 40; ++n)
  {
    wanted.push_back({ n, 40.0 - n, false });
  }
  const auto frame = [&]
  {
    for (Residency* store : { &one, &two })
    {
      store->request(wanted);
      store->release([](NodeIndex n) { return n < 40 ? 0u : 1u; });
    }
    one.waitUntilIdle();
    two.waitUntilIdle();
  };
  for (int f = 0; f < 20; ++f)
  {
    frame();
  }
  EXPECT_TRUE(one.exhausted());
  EXPECT_TRUE(two.exhausted());
  EXPECT_EQ(one.statistics().residentNodes + two.statistics().residentNodes, 50u);
  const std::uint64_t read = one.statistics().bytesRead + two.statistics().bytesRead;
  for (int f = 0; f < 20; ++f)
  {
    frame();
  }
  EXPECT_EQ(one.statistics().bytesRead + two.statistics().bytesRead, read);
  EXPECT_EQ(one.statistics().released + two.statistics().released, 0u);
}

} // namespace pointfront
