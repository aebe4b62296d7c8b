#include "pointfront/Disk/ReadAhead.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <new>
#include <numeric>

namespace pointfront
{
namespace
{
using namespace std::chrono_literals;

std::vector<std::byte> recordsOf(std::uint32_t part)
{
  return std::vector<std::byte>(part + 1, std::byte(part));
}

/// A pool on a disk: which parts were asked of it, in which order.
class Disk
{
public:
  ReadAhead::Records load(std::uint32_t part)
  {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      begun_.push_back(part);
      changed_.notify_all();
    }
    if (part == broken_)
    {
      return makeError(Error::Kind::Unreadable, "part " + std::to_string(part));
    }
    if (part == tooLarge_)
    {
      throw std::bad_alloc();
    }
    return recordsOf(part);
  }
  ReadAhead::Load loader()
  {
    return [this](std::uint32_t part) { return load(part); };
  }
  /// Waits until so many were begun; false if that does not happen.
  bool awaitBegun(std::size_t count)
  {
    std::unique_lock<std::mutex> lock(mutex_);
    return changed_.wait_for(lock, 10s, [&] { return begun_.size() >= count; });
  }
  std::vector<std::uint32_t> begun()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return begun_;
  }

  std::uint32_t broken_ = UINT32_MAX;
  std::uint32_t tooLarge_ = UINT32_MAX;

private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::uint32_t> begun_;
};

std::vector<std::uint32_t> backwards(std::uint32_t count)
{
  std::vector<std::uint32_t> order(count);
  std::iota(order.rbegin(), order.rend(), 0u);
  return order;
}

TEST(ReadAhead, GivesEachPartWhatIsItsOwn)
{
  for (const ReadAheadPlan plan :
    { ReadAheadPlan{ 0, 1 }, { 1, 1 }, { 3, 1 }, { 4, 3 }, { 1000, 2 } })
  {
    Disk disk;
    const std::vector<std::uint32_t> order = backwards(100);
    ReadAhead parts(order, disk.loader(), plan);
    for (const std::uint32_t part : order)
    {
      const auto records = parts.take(part);
      ASSERT_TRUE(records);
      EXPECT_EQ(*records, recordsOf(part));
    }
    EXPECT_EQ(disk.begun().size(), order.size()); // each was read once
    EXPECT_GE(parts.seconds(), 0.0);
  }
}

TEST(ReadAhead, BeginsInOrderAndNotFurtherThanAllowed)
{
  Disk disk;
  const std::vector<std::uint32_t> order = backwards(20);
  ReadAhead parts(order, disk.loader(), { 4, 1 });
  ASSERT_TRUE(disk.awaitBegun(4)); // before any was asked for
  std::this_thread::sleep_for(30ms);
  EXPECT_EQ(disk.begun(), std::vector<std::uint32_t>(order.begin(), order.begin() + 4));
  ASSERT_TRUE(parts.take(order[0]));
  ASSERT_TRUE(disk.awaitBegun(5));
  std::this_thread::sleep_for(30ms);
  EXPECT_EQ(disk.begun(), std::vector<std::uint32_t>(order.begin(), order.begin() + 5));
}

TEST(ReadAhead, NothingIsReadBeforeItIsTakenWithoutMemoryForIt)
{
  Disk disk;
  ReadAhead parts(backwards(5), disk.loader(), { 0, 2 });
  std::this_thread::sleep_for(30ms);
  EXPECT_TRUE(disk.begun().empty());
  EXPECT_TRUE(parts.take(4));
  EXPECT_EQ(disk.begun(), std::vector<std::uint32_t>{ 4 });
}

TEST(ReadAhead, AnErrorIsThatOfItsPart)
{
  for (const std::size_t ahead : { 0u, 3u })
  {
    Disk disk;
    disk.broken_ = 2;
    disk.tooLarge_ = 1;
    const std::vector<std::uint32_t> order = backwards(5);
    ReadAhead parts(order, disk.loader(), { ahead, 2 });
    EXPECT_TRUE(parts.take(4));
    EXPECT_TRUE(parts.take(3));
    const auto broken = parts.take(2);
    ASSERT_FALSE(broken);
    EXPECT_EQ(broken.error().what, "part 2");
    const auto tooLarge = parts.take(1);
    ASSERT_FALSE(tooLarge);
    EXPECT_EQ(tooLarge.error().kind, Error::Kind::NoMemory);
    EXPECT_TRUE(parts.take(0));
  }
}

/// A build that was cancelled: what was read for it is dropped, and no more is begun.
TEST(ReadAhead, EndsWithWhatItHasBegun)
{
  Disk disk;
  {
    ReadAhead parts(backwards(1000), disk.loader(), { 8, 2 });
    ASSERT_TRUE(parts.take(999));
  }
  const std::size_t begun = disk.begun().size();
  EXPECT_LE(begun, 9u);
  std::this_thread::sleep_for(20ms);
  EXPECT_EQ(disk.begun().size(), begun);
}

TEST(ReadAhead, ManyTakeWhileManyRead)
{
  Disk disk;
  const std::vector<std::uint32_t> order = backwards(2000);
  ReadAhead parts(order, disk.loader(), { 3, 3 });
  std::atomic<std::size_t> next{ 0 };
  std::atomic<int> wrong{ 0 };
  const auto work = [&]
  {
    for (std::size_t i = next++; i < order.size(); i = next++)
    {
      const auto records = parts.take(order[i]);
      wrong += records && *records == recordsOf(order[i]) ? 0 : 1;
    }
  };
  std::vector<std::thread> takers;
  for (int i = 0; i < 4; ++i)
  {
    takers.emplace_back(work);
  }
  for (std::thread& taker : takers)
  {
    taker.join();
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(disk.begun().size(), order.size());
}

} // namespace
} // namespace pointfront
