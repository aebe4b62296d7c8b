// Random requests, cancels, releases, failures, new columns and budgets against running loaders.
// Made for ThreadSanitizer; without it, it checks the budget and the account.

#include "pointfront/Residency/Residency.h"

#include "FrontScene.h"
#include "MadeUpReader.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <random>
#include <thread>

namespace pointfront
{

using test::MadeUpReader;

namespace
{

/// A number below `end`.
std::uint32_t below(std::uint32_t end, std::mt19937& random)
{
  return static_cast<std::uint32_t>(random() % end);
}

using HeldNodes = std::vector<std::shared_ptr<const NodeColumns>>;

/// Does to a residency, in any order, all that views, styles and the end of views do. Gives the
/// nodes that are drawn at the end.
HeldNodes doAnything(Residency& residency, std::mt19937& random)
{
  HeldNodes held(8);
  for (int step = 0; step < 600; ++step)
  {
    std::vector<LoadRequest> wanted;
    for (std::uint32_t r = below(30, random); r > 0; --r)
    {
      wanted.push_back({ below(200, random), double(below(50, random)), below(4, random) == 0 });
    }
    residency.request(wanted);
    const NodeIndex kept = below(200, random);
    residency.release([kept](NodeIndex n) { return n == kept ? 0u : 1u + n % 5; });
    held[below(8, random)] = residency.find(below(200, random));
    if (random() % 40 == 0)
    {
      residency.setColumns(random() % 2 == 0 ? ColumnSelection{ 1 } : ColumnSelection{ 0, 1 });
    }
    if (random() % 100 == 0)
    {
      residency.waitUntilIdle();
    }
  }
  return held;
}

std::size_t bytesInMemory(Residency& residency)
{
  std::size_t sum = 0;
  for (NodeIndex n = 0; n < 200; ++n)
  {
    if (const auto points = residency.find(n))
    {
      sum += points->bytes();
    }
  }
  return sum;
}

} // namespace

TEST(ResidencySoak, TheBudgetHoldsWhateverHappens)
{
  for (std::uint32_t seed = 1; seed <= 3; ++seed)
  {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const auto reader = std::make_shared<MadeUpReader>(400);
    reader->varyBy = 60;
    for (NodeIndex n = 0; n < 200; n += 17)
    {
      reader->breakNode(n);
    }
    ResidencyOptions options;
    options.budgetBytes = 40 * reader->trueBytes(6, { 0, 1 });
    options.loaderThreads = 3;
    Residency residency(reader, 200, options);
    std::atomic<std::uint64_t> told{ 0 };
    residency.setArrivalFunction([&] { ++told; });
    std::atomic<bool> done{ false };
    std::thread watcher(
      [&]
      {
        while (!done)
        {
          EXPECT_LE(residency.statistics().residentBytes, options.budgetBytes);
          residency.waitForArrival(residency.arrivals());
          std::this_thread::yield();
        }
      });
    HeldNodes held = doAnything(residency, random);
    done = true;
    residency.request({});
    residency.waitUntilIdle();
    watcher.join();
    const ResidencyStatistics s = residency.statistics();
    EXPECT_LE(s.residentBytesMax, options.budgetBytes);
    EXPECT_GT(s.released, 0u);
    EXPECT_GT(s.cancelled, 0u);
    EXPECT_GT(s.failed, 0u);
    EXPECT_EQ(told, residency.arrivals());
    EXPECT_EQ(residency.takeErrors().size(), s.failed);
    // With nobody holding on, the account is what is resident.
    held.clear();
    const std::size_t sum = bytesInMemory(residency);
    residency.waitUntilIdle();
    EXPECT_GT(sum, 0u);
    EXPECT_LE(sum, options.budgetBytes);
  }
}

TEST(ResidencySoak, AnotherThreadMayDropPointsAndTheEndMayComeAtAnyTime)
{
  const auto reader = std::make_shared<MadeUpReader>(200);
  for (int run = 0; run < 30; ++run)
  {
    ResidencyOptions options;
    options.budgetBytes = 6 * reader->trueBytes(0, {});
    options.loaderThreads = 2;
    auto residency = std::make_unique<Residency>(reader, 100, options);
    std::vector<LoadRequest> wanted;
    for (NodeIndex n = 0; n < 40; ++n)
    {
      wanted.push_back({ n, double(n), false });
    }
    residency->request(wanted);
    residency->waitForArrival(0);
    std::vector<std::shared_ptr<const NodeColumns>> held;
    for (NodeIndex n = 0; n < 40; ++n)
    {
      held.push_back(residency->find(n));
    }
    residency->release([](NodeIndex) { return 1u; });
    std::thread dropper([&] { held.clear(); });
    residency.reset();
    dropper.join();
  }
}

/// The front and the residency together: memory for a part of what a view needs.
TEST(ResidencySoak, AViewThatNeedsMoreThanTheMemorySettlesWithoutThrashing)
{
  test::TreeShape shape;
  shape.emptyChance = 0.0;
  shape.pointsMax = 200;
  const auto tree = test::randomTree(shape);
  const auto reader = std::make_shared<MadeUpReader>(200);
  ResidencyOptions options;
  options.budgetBytes = 150 * reader->trueBytes(0, {});
  Residency residency(reader, tree->nodeCount(), options);
  RenderFront front(tree);
  FrontLimits limits;
  limits.movesPerFrame = 500;
  for (int view = 0; view < 6; ++view)
  {
    const double angle = view * 1.1;
    const View camera = View::perspective({ 900 * std::cos(angle), 900 * std::sin(angle), 400 },
      { 0, 0, 0 }, { 0, 0, 1 }, 0.7, 0.1, 1e5, 800, 600);
    int updates = 0;
    const FrontDelta* delta = nullptr;
    do
    {
      delta = &front.update(camera, residency, limits);
      const std::uint64_t seen = residency.arrivals();
      residency.request(delta->requests);
      residency.release([&](NodeIndex n) { return front.distanceUnderFront(n); });
      residency.waitForArrival(seen);
      ASSERT_LT(++updates, 5000);
    } while (!delta->complete);
    EXPECT_TRUE(delta->limitedByMemory);
    EXPECT_GT(delta->errorPx, 1.0);
    EXPECT_GT(delta->draw.size(), 100u);
    // At rest nothing is read any more.
    residency.waitUntilIdle();
    const std::uint64_t read = residency.statistics().bytesRead;
    for (int u = 0; u < 20; ++u)
    {
      delta = &front.update(camera, residency, limits);
      residency.request(delta->requests);
      residency.release([&](NodeIndex n) { return front.distanceUnderFront(n); });
      residency.waitUntilIdle();
      EXPECT_TRUE(delta->complete);
    }
    EXPECT_EQ(residency.statistics().bytesRead, read);
    EXPECT_LE(residency.statistics().residentBytesMax, options.budgetBytes);
  }
}

} // namespace pointfront
