#include "ReadPatience.h"
#include "RemoteOpener.h"
#include "SmallServer.h"

#include "pointfront/Disk/ByteSource.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <thread>
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
  server.silent = true;
  const unsigned before = server.requests;
  ReadStop stop{ false };
  std::vector<std::byte> bytes(40960);
  std::vector<ByteRange> ranges;
  for (std::size_t i = 0; i < 4; ++i)
  {
    ranges.push_back({ 200000 * (i + 1), 10240, bytes.data() + 10240 * i });
  }
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
  // A tenth of a second, and what a busy machine takes besides; it took ten seconds before.
  EXPECT_LT(ended - asked, milliseconds(500));
  EXPECT_TRUE(comes([&] { return server.left >= 4; })); // none goes on unseen
  server.silent = false;
  EXPECT_TRUE((*source)->read(ranges.data(), ranges.size()));
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
