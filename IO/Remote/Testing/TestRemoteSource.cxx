#include "ReadPatience.h"
#include "RemoteOpener.h"
#include "SmallServer.h"

#include "pointfront/Disk/ByteSource.h"
#include "pointfront/Disk/ByteTraffic.h"
#include "pointfront/Disk/StopOfReads.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace pointfront
{
namespace
{
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

std::string words(std::size_t size)
{
  std::string text(size, ' ');
  for (std::size_t i = 0; i < size; ++i)
  {
    text[i] = static_cast<char>('a' + i * 7919 % 26);
  }
  return text;
}

/// Waits until it holds, ten seconds at most.
template <typename Holds>
bool comes(const Holds& holds)
{
  const Clock::time_point end = Clock::now() + std::chrono::seconds(10);
  while (!holds() && Clock::now() < end)
  {
    std::this_thread::sleep_for(milliseconds(1));
  }
  return holds();
}
} // namespace

TEST(RemoteSource, AStopEndsTheTransfers)
{
  SmallServer server(words(1 << 20));
  addRemoteOpeners();
  const Result<std::shared_ptr<const ByteSource>> source = openBytes(server.address(), { 4096, 0 });
  ASSERT_TRUE(source) << source.error().what;
  std::vector<std::byte> bytes(40960);
  std::vector<ByteRange> ranges;
  for (std::size_t i = 0; i < 4; ++i)
  {
    ranges.push_back({ 200000 * (i + 1), 10240, bytes.data() + 10240 * i });
  }
  milliseconds best{ 10000 };
  for (unsigned round = 1; round <= 5 && best > milliseconds(100); ++round) // it may be busy
  {
    server.silent = true;
    const unsigned before = server.requests;
    ReadStop stop{ false };
    Result<void> done;
    Clock::time_point ended;
    std::thread reader(
      [&]
      {
        done = (*source)->readUntil(stop, ranges.data(), ranges.size());
        ended = Clock::now();
      });
    EXPECT_TRUE(comes([&] { return server.requests == before + 4; }));
    const Clock::time_point asked = Clock::now();
    stop = true;
    reader.join();
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().kind, Error::Kind::Cancelled) << done.error().what;
    best = std::min(best, std::chrono::duration_cast<milliseconds>(ended - asked));
    EXPECT_TRUE(comes([&] { return server.left >= 4 * round; })); // none goes on unseen
    server.silent = false;
  }
  EXPECT_LE(best, milliseconds(100)); // ten seconds before
  EXPECT_TRUE((*source)->read(ranges.data(), ranges.size()));
}

TEST(RemoteSource, EndsThatAreHeldAreNotAskedForAgain)
{
  const std::string file = words(100000);
  SmallServer server(file);
  const RemoteOpener opener(RemoteOptions{});
  const auto source = opener.open(server.address(), { 8192, 10000 });
  ASSERT_TRUE(source) << source.error().what;
  const auto read = [&](std::size_t offset, std::size_t size)
  {
    const std::uint64_t before = ByteTraffic::ofProcess().bytes;
    const Result<RawBytes> bytes = (*source)->readAt(offset, size);
    EXPECT_TRUE(bytes && std::memcmp(bytes->data.get(), file.data() + offset, size) == 0) << offset;
    return ByteTraffic::ofProcess().bytes - before;
  };
  EXPECT_EQ(read(100, 8000), 0u);
  EXPECT_EQ(read(90500, 9500), 0u);
  EXPECT_EQ(read(100, 20000), 20100u - 8192u);
  EXPECT_LE(read(50000, 50000), 40000u + 4096u);
  EXPECT_LE(read(0, 100000), 100000u - 8192u - 10000u + 4096u); // 100000 before
}

/// A server need not know ranges that count from the end. It gives the whole file, which may be
/// more than is taken.
TEST(RemoteSource, TheEndOfAFileCanBeCountedFromItsFront)
{
  const std::string file = words(1 << 20);
  for (const std::uint64_t whole : { std::uint64_t(64) << 20, std::uint64_t(1) << 16 })
  {
    SmallServer server(file);
    server.countsFromFront = true;
    RemoteOptions options;
    options.wholeAtMost = whole;
    const RemoteOpener opener(options);
    for (const std::size_t head : { std::size_t(4096), std::size_t(0) })
    {
      const auto source = opener.open(server.address(std::to_string(head)), { head, 10000 });
      ASSERT_TRUE(source) << source.error().what;
      for (const std::size_t offset : { file.size() - 9000, std::size_t(500000) })
      {
        const Result<RawBytes> bytes = (*source)->readAt(offset, 9000);
        ASSERT_TRUE(bytes) << bytes.error().what;
        EXPECT_EQ(std::memcmp(bytes->data.get(), file.data() + offset, 9000), 0) << offset;
      }
    }
  }
}

/// The tail begins in the middle of a block of the cache, which keeps whole ones only.
TEST(RemoteSource, WhatTheTailHasInPartIsThereOffline)
{
  const std::string file = words(100000);
  SmallServer server(file);
  addRemoteOpeners();
  const std::filesystem::path folder =
    std::filesystem::path(testing::TempDir()) / ("pointfront-tail-" + std::to_string(::getpid()));
  const std::string settings = "#far:cache_size=1G&cache=" + folder.string();
  const auto read = [&](const std::string& more)
  {
    const auto source = openBytes(server.address() + settings + more, { 4096, 10000 });
    EXPECT_TRUE(source) << source.error().what;
    for (const std::size_t offset : { 85920u, 86000u, 90000u })
    {
      const Result<RawBytes> bytes = source ? (*source)->readAt(offset, 9000) : source.error();
      EXPECT_TRUE(bytes) << offset << ": " << bytes.error().what;
      EXPECT_TRUE(bytes && std::memcmp(bytes->data.get(), file.data() + offset, 9000) == 0);
    }
  };
  read("");
  const unsigned before = server.requests;
  read("&offline=1");
  EXPECT_EQ(server.requests, before);
  std::filesystem::remove_all(folder);
}

TEST(RemoteOpener, AStopEndsAnOpening)
{
  SmallServer server(words(1 << 16));
  const RemoteOpener opener(RemoteOptions{});
  milliseconds best{ 10000 };
  for (int round = 0; round < 5 && best > milliseconds(100); ++round) // the machine may be busy
  {
    const std::string address = server.address(std::to_string(round));
    server.silent = true;
    const unsigned before = server.requests;
    std::atomic<bool> stopped{ false };
    Error::Kind kind = Error::Kind::NotFound;
    Clock::time_point ended;
    std::thread opening(
      [&]
      {
        const StopOfReads stop([&stopped] { return stopped.load(); });
        const StopOfReads inner([] { return false; });
        const auto opened = opener.open(address, { 4096, 0 });
        ended = Clock::now();
        kind = opened ? kind : opened.error().kind;
      });
    EXPECT_TRUE(comes([&] { return server.requests == before + 1; }));
    bool waiterOpened = false;
    std::thread waiter([&] { waiterOpened = bool(opener.open(address, { 4096, 0 })); });
    server.silent = false; // the first request stays without an answer
    const Clock::time_point asked = Clock::now();
    stopped = true;
    opening.join();
    waiter.join();
    EXPECT_EQ(kind, Error::Kind::Cancelled);
    EXPECT_TRUE(waiterOpened); // nobody has stopped it
    best = std::min(best, std::chrono::duration_cast<milliseconds>(ended - asked));
  }
  EXPECT_LE(best, milliseconds(100)); // 60 seconds before
}

TEST(RemoteOpener, SeveralWhoOpenOneAddressGetOneSource)
{
  SmallServer server(words(1 << 16));
  server.pause = milliseconds(50);
  const RemoteOpener opener(RemoteOptions{});
  std::vector<std::shared_ptr<const ByteSource>> sources(8);
  std::vector<std::thread> threads;
  for (auto& source : sources)
  {
    threads.emplace_back(
      [&]
      {
        const auto opened = opener.open(server.address(), { 4096, 0 });
        source = opened ? *opened : nullptr;
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  EXPECT_EQ(server.requests, 1u);
  ASSERT_TRUE(sources.front());
  for (const auto& source : sources)
  {
    EXPECT_EQ(source, sources.front());
  }
}

TEST(RemoteOpener, ADeadServerIsWaitedForOnce)
{
  SmallServer server(words(1 << 16));
  server.silent = true;
  RemoteOptions options;
  options.timeLimit = milliseconds(500);
  const RemoteOpener opener(options);
  const Clock::time_point begin = Clock::now();
  const auto first = opener.open(server.address("0"), { 4096, 0 });
  ASSERT_FALSE(first);
  EXPECT_GE(Clock::now() - begin, milliseconds(500));
  for (int tile = 1; tile < 1000; ++tile)
  {
    const auto opened = opener.open(server.address(std::to_string(tile)), { 4096, 0 });
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().kind, Error::Kind::Unreadable);
    EXPECT_NE(opened.error().what.find('/' + std::to_string(tile)), std::string::npos);
  }
  EXPECT_LT(Clock::now() - begin, std::chrono::seconds(5)); // 500 before
  server.silent = false;
  EXPECT_TRUE(comes([&] { return bool(opener.open(server.address("1"), { 4096, 0 })); }));
}

TEST(RemoteOpener, AFailureIsThatOfTheNextMoment)
{
  SmallServer server(words(1 << 16));
  server.refuses = true;
  RemoteOptions options;
  options.retries = 1;
  const RemoteOpener opener(options);
  const auto first = opener.open(server.address("0"), { 4096, 0 });
  const unsigned asked = server.requests;
  const auto again = opener.open(server.address("0"), { 4096, 0 });
  ASSERT_FALSE(first || again);
  EXPECT_EQ(first.error().what, again.error().what);
  EXPECT_EQ(server.requests, asked);
  server.refuses = false;
  // It answers, so its other files are asked for.
  EXPECT_TRUE(opener.open(server.address("1"), { 4096, 0 }));
  EXPECT_TRUE(comes([&] { return bool(opener.open(server.address("0"), { 4096, 0 })); }));
}

TEST(RemoteSource, AFileThatWasReplacedIsOpenedAnew)
{
  SmallServer server(words(1 << 20));
  const RemoteOpener opener(RemoteOptions{});
  const auto source = opener.open(server.address(), { 4096, 0 });
  ASSERT_TRUE(source);
  server.state = 2;
  std::byte byte;
  const Result<void> read = (*source)->readAt(500000, &byte, 1);
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().what.find("has changed on its server"), std::string::npos);
  EXPECT_FALSE((*source)->isStillNamed());
  auto again = opener.open(server.address(), { 4096, 0 });
  ASSERT_FALSE(again); // who opens it in several steps hears of the change
  EXPECT_EQ(again.error().what, read.error().what);
  EXPECT_TRUE(comes(
    [&]
    {
      again = opener.open(server.address(), { 4096, 0 });
      return bool(again);
    }));
  ASSERT_TRUE(again);
  EXPECT_NE(*again, *source);
  EXPECT_TRUE((*again)->readAt(500000, &byte, 1));
}

namespace
{
/// Forks; whether the child says true within 20 seconds. Then it may wait for a lock of a thread
/// which is not there.
template <typename Work>
bool childSays(const Work& work)
{
  const ::pid_t child = ::fork();
  if (child == 0)
  {
    ::alarm(20);
    ::_exit(work() ? 0 : 1);
  }
  int status = -1;
  return ::waitpid(child, &status, 0) == child && status == 0;
}

/// Does the work again and again on threads of its own, while it exists.
class Busy
{
public:
  explicit Busy(const std::function<void()>& work)
  {
    for (int t = 0; t < 2; ++t)
    {
      threads_.emplace_back(
        [this, work]
        {
          while (!over_)
          {
            work();
          }
        });
    }
  }
  ~Busy()
  {
    over_ = true;
    for (std::thread& thread : threads_)
    {
      thread.join();
    }
  }

private:
  std::atomic<bool> over_{ false };
  std::vector<std::thread> threads_;
};

/// In a process that has opened no address yet.
bool forksWhileTheFirstOneOpens(std::chrono::microseconds pause)
{
  SmallServer server(words(1 << 16));
  const Busy busy(
    [&server]
    {
      addRemoteOpeners();
      static_cast<void>(openBytes(server.address("file?sig=secret"), { 4096, 0 }));
    });
  std::this_thread::sleep_for(pause);
  return childSays(
    [&server]
    {
      addRemoteOpeners();
      return bool(openBytes(server.address("child?sig=secret"), { 4096, 0 }));
    });
}
} // namespace

TEST(RemoteOpener, AForkWhileTheFirstAddressOpens)
{
  testing::FLAGS_gtest_death_test_style = "threadsafe"; // a process anew for each
  for (int round = 0; round < 32; ++round)
  {
    EXPECT_EXIT(::_exit(forksWhileTheFirstOneOpens(std::chrono::microseconds(10 * round)) ? 0 : 1),
      testing::ExitedWithCode(0), "");
  }
}

TEST(RemoteSource, AChildOfForkReadsWhatItsParentHasOpened)
{
  SmallServer server(words(1 << 20));
  const RemoteOpener opener(RemoteOptions{});
  const auto source = opener.open(server.address(), { 4096, 0 });
  ASSERT_TRUE(source);
  const auto read = [&]
  {
    std::byte byte;
    return bool((*source)->readAt(500000, &byte, 1));
  };
  const Busy busy(read);
  for (int round = 0; round < 10; ++round)
  {
    ASSERT_TRUE(childSays(read));
  }
}

TEST(RemoteOpener, AChildOfForkOpensAddressesToo)
{
  SmallServer server(words(1 << 16));
  const RemoteOpener opener(RemoteOptions{});
  const Busy busy( // it holds the tables' locks most of the time
    [&] {
      static_cast<void>(opener.open(server.address(), { 4096, 0 }));
    });
  for (int round = 0; round < 5; ++round)
  {
    ASSERT_TRUE(childSays([&] { return bool(opener.open(server.address("child"), { 4096, 0 })); }));
  }
}

TEST(ReadPatience, LastsWhileBytesCome)
{
  const Clock::time_point begin = Clock::now();
  ReadPatience patience(milliseconds(2000), begin);
  EXPECT_FALSE(patience.over(begin + milliseconds(1999)));
  EXPECT_TRUE(patience.over(begin + milliseconds(2000)));
  patience.note(2047, begin + milliseconds(1500)); // less than 1 KiB a second
  EXPECT_TRUE(patience.over(begin + milliseconds(2000)));
  patience.note(2048, begin + milliseconds(1600));
  EXPECT_FALSE(patience.over(begin + milliseconds(3599)));
  EXPECT_TRUE(patience.over(begin + milliseconds(3600)));
  patience.extend(milliseconds(500));
  EXPECT_FALSE(patience.over(begin + milliseconds(4000)));
  patience.note(4095, begin + milliseconds(4000));
  EXPECT_TRUE(patience.over(begin + milliseconds(4100)));
}

} // namespace pointfront
