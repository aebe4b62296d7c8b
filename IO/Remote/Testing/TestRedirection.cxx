// Files that their servers redirect to others.
#include "RemoteOpener.h"
#include "SmallServer.h"

#include "pointfront/Disk/ByteSource.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <filesystem>
#include <string>
#include <unistd.h>
#include <vector>

namespace pointfront
{
namespace
{
std::string redirectionTo(const std::string& target, const std::string& more = {})
{
  return "HTTP/1.1 302 there\r\nContent-Length: 0\r\nLocation: " + target + "\r\n" + more + "\r\n";
}

/// A cache of its own, which goes with the test.
class OwnCache
{
public:
  OwnCache() { std::filesystem::remove_all(folder_); }
  ~OwnCache() { std::filesystem::remove_all(folder_); }
  std::string settings() const { return "#far:cache_size=1G&cache=" + folder_; }

private:
  const std::string folder_ =
    testing::TempDir() + "/pointfront-redirected-" + std::to_string(::getpid());
};

/// Opens a file as a program does that has not opened it before. The number of requests.
unsigned requestsOf(SmallServer& server, const std::string& name, const OwnCache& cache)
{
  const unsigned before = server.requests;
  const auto source =
    RemoteOpener(RemoteOptions{}).open(server.address(name) + cache.settings(), { 4096, 0 });
  EXPECT_TRUE(source) << source.error().what;
  return server.requests - before;
}

constexpr const char* forAYear = "Cache-Control: max-age=31536000, immutable\r\n";
} // namespace

/// "latest" leads to a file that never changes, and tomorrow to another one.
TEST(Redirection, AFilesPromiseIsNotThatOfTheNameThatLeadsThere)
{
  SmallServer server(std::string(100000, 'x'));
  server.filesHeaders = forAYear;
  server.instead = [](const std::string& target, const std::string&)
  {
    return target == "/latest" ? redirectionTo("/v1")
      : target == "/fixed"     ? redirectionTo("/latest", forAYear)
      : target == "/moved"     ? redirectionTo("/v1", forAYear)
                               : std::string();
  };
  const OwnCache cache;
  for (const char* const name : { "latest", "fixed" })
  {
    EXPECT_GT(requestsOf(server, name, cache), 1u) << name;
    EXPECT_GT(requestsOf(server, name, cache), 1u) << name; // 0 before
  }
  for (const char* const name : { "v1", "moved" })
  {
    EXPECT_GT(requestsOf(server, name, cache), 0u) << name;
    EXPECT_EQ(requestsOf(server, name, cache), 0u) << name; // all on the way promise
  }
}

/// Head and tail are asked for at once, so two answers tell the same redirection.
TEST(Redirection, ARelativeNameCountsFromTheAddressThatWasAsked)
{
  const std::string file(100000, 'x');
  SmallServer server(file);
  server.instead = [](const std::string& target, const std::string&)
  {
    return target == "/a/latest" ? redirectionTo("v/one")
      : target == "/a/v/one"     ? std::string()
                                 : "HTTP/1.1 404 no\r\nContent-Length: 0\r\n\r\n";
  };
  const auto source =
    RemoteOpener(RemoteOptions{}).open(server.address("a/latest"), { 4096, 4096 });
  ASSERT_TRUE(source) << source.error().what;
}

/// A signed address that a name leads to runs out while several parts are asked for.
TEST(Redirection, ARedirectionThatRanOutIsAskedForAgain)
{
  SmallServer server(std::string(8 << 20, 'x'));
  std::atomic<int> signature{ 1 };
  server.instead = [&signature](const std::string& target, const std::string&)
  {
    const std::string now = "/signed?sig=" + std::to_string(signature);
    return target == "/name" ? redirectionTo(now)
      : target == now        ? std::string()
                             : "HTTP/1.1 403 no\r\nContent-Length: 0\r\n\r\n";
  };
  const auto source = RemoteOpener(RemoteOptions{}).open(server.address("name"), { 4096, 0 });
  ASSERT_TRUE(source) << source.error().what;
  std::vector<std::byte> bytes(40960);
  std::vector<ByteRange> ranges;
  for (std::size_t i = 0; i < 4; ++i)
  {
    ranges.push_back({ 2000000 * i + 50000, 10240, bytes.data() + 10240 * i });
  }
  ++signature;
  const Result<void> read = (*source)->read(ranges.data(), ranges.size());
  EXPECT_TRUE(read) << read.error().what;
}

} // namespace pointfront
