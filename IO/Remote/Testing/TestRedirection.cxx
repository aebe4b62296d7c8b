// Files that their servers redirect to others.
#include "RemoteOpener.h"
#include "SmallServer.h"

#include "pointfront/Disk/ByteSource.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
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

namespace
{
/// Why a file cannot be had of a server that answers so; "s3": by its name in a bucket.
std::string whyOf(const std::string& answer, bool s3 = true)
{
  SmallServer server("x");
  server.instead = [&answer](const std::string&, const std::string&) { return answer; };
  const std::string endpoint = server.address("");
  ::setenv("AWS_ENDPOINT_URL", endpoint.c_str(), 1);
  ::setenv("AWS_NO_SIGN_REQUEST", "YES", 1);
  const auto source =
    RemoteOpener(RemoteOptions{})
      .open(s3 ? "s3://bucket/x.pfront" : server.address("x.pfront"), { 4096, 0 });
  ::unsetenv("AWS_ENDPOINT_URL");
  ::unsetenv("AWS_NO_SIGN_REQUEST");
  return source ? "it opens" : source.error().what;
}

std::string answerOf(const std::string& line, const std::string& words = {})
{
  return "HTTP/1.1 " + line + "\r\nContent-Length: " + std::to_string(words.size()) + "\r\n\r\n" +
    words;
}
} // namespace

TEST(Redirection, ABucketOfAnotherRegionIsTold)
{
  const std::string moved = "301 x\r\nx-amz-bucket-region: eu-west-1";
  EXPECT_NE(whyOf(answerOf(moved)).find("set AWS_REGION=eu-west-1"), std::string::npos);
  EXPECT_NE(whyOf(answerOf("301 x")).find("set AWS_REGION="), std::string::npos);
  const std::string plain = whyOf(answerOf(moved), false);
  EXPECT_NE(plain.find("eu-west-1"), std::string::npos) << plain;
  EXPECT_EQ(plain.find("AWS_"), std::string::npos) << plain;
  const std::string nowhere = whyOf(answerOf("302 x"), false);
  EXPECT_NE(nowhere.find("does not say to where"), std::string::npos) << nowhere;
}

TEST(Redirection, AStoresFaultSaysWhatToDo)
{
  const std::string region = "<Error><Code>AuthorizationHeaderMalformed</Code><Message>the region "
                             "is wrong</Message><Region>eu-west-1</Region></Error>";
  const std::string wrong = whyOf(answerOf("400 x", region));
  EXPECT_NE(wrong.find("set AWS_REGION=eu-west-1"), std::string::npos) << wrong;
  const std::string past = whyOf(answerOf("400 x", "<Error><Code>ExpiredToken</Code></Error>"));
  EXPECT_NE(past.find("AWS_SESSION_TOKEN"), std::string::npos) << past;
  const std::string other = whyOf(answerOf("400 x", "<html>no"));
  EXPECT_NE(other.find("the server answers 400"), std::string::npos) << other;
}

} // namespace pointfront
