#include "Address.h"
#include "Credentials.h"
#include "RandomRounds.h"
#include "RemoteOpener.h"
#include "TextMutation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <arpa/inet.h>
#include <atomic>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <netinet/in.h>
#include <string>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace pointfront
{
namespace
{
constexpr std::size_t fileBytes = 300000;

char byteAt(std::size_t at)
{
  return static_cast<char>('a' + at * 7919 % 26);
}

test::TextMutation mutationOf(unsigned seed)
{
  return { seed,
    { "-1", "18446744073709551615", "99999999999999999999", "*", "bytes ", "/", "", "0", "\t",
      "gzip", "W/\"", "206", "304", "100", "\xff", "chunked" } };
}

/// Answers each request with the bytes that it asks for below headers that are mutated, and closes.
class HostileServer
{
public:
  HostileServer()
  {
    ::setenv("POINTFRONT_CACHE", "off", 1);
    ::setenv("no_proxy", "*", 1);
    socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in here = {};
    here.sin_family = AF_INET;
    here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ::bind(socket_, reinterpret_cast<sockaddr*>(&here), sizeof here);
    ::listen(socket_, 64);
    socklen_t size = sizeof here;
    ::getsockname(socket_, reinterpret_cast<sockaddr*>(&here), &size);
    origin_ = "http://127.0.0.1:" + std::to_string(ntohs(here.sin_port));
    serving_ = std::thread([this] { serve(); });
  }
  ~HostileServer()
  {
    ::shutdown(socket_, SHUT_RDWR);
    serving_.join();
    ::close(socket_);
  }
  HostileServer(const HostileServer&) = delete;
  HostileServer& operator=(const HostileServer&) = delete;

  const std::string& origin() const { return origin_; }
  std::atomic<unsigned> seed{ 0 }; ///< another one is another mutation; 0: none

private:
  void serve()
  {
    for (int connection = ::accept(socket_, nullptr, nullptr); connection >= 0;
         connection = ::accept(socket_, nullptr, nullptr))
    {
      std::string request;
      char piece[4096];
      ssize_t size = 1;
      while (size > 0 && request.find("\r\n\r\n") == std::string::npos)
      {
        size = ::recv(connection, piece, sizeof piece, 0);
        request.append(piece, static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
      }
      const std::string answer = answerTo(request);
      ::send(connection, answer.data(), answer.size(), MSG_NOSIGNAL);
      ::close(connection);
    }
  }
  std::string answerTo(const std::string& request)
  {
    std::size_t first = 0;
    std::size_t last = 0;
    const std::size_t at = request.find("Range: bytes=");
    if (at == std::string::npos ||
      std::sscanf(request.c_str() + at, "Range: bytes=%zu-%zu", &first, &last) != 2)
    {
      return {};
    }
    last = std::min(last, fileBytes - 1);
    std::vector<std::string> lines = { "HTTP/1.1 206 part", "ETag: \"a\"",
      "Last-Modified: Thu, 01 Jan 2026 00:00:00 GMT",
      "Content-Length: " + std::to_string(last - first + 1),
      "Content-Range: bytes " + std::to_string(first) + "-" + std::to_string(last) + "/" +
        std::to_string(fileBytes) };
    if (seed > 0)
    {
      test::TextMutation mutation = mutationOf(seed);
      std::string& line = lines[mutation.below(lines.size())];
      // A line more, or none, would be another place of the body, which nobody could tell from it.
      line = mutation.of(line) + ' ';
      std::replace_if(
        line.begin(), line.end(), [](char c) { return c == '\r' || c == '\n'; }, ' ');
    }
    std::string answer;
    for (const std::string& line : lines)
    {
      answer += line + "\r\n";
    }
    answer += "\r\n";
    for (std::size_t i = first; i <= last; ++i)
    {
      answer += byteAt(i);
    }
    return answer;
  }

  int socket_ = -1;
  std::string origin_;
  std::thread serving_;
};

/// Whether the source gives the bytes of the file there; errors are no wrong bytes.
bool isRightOrError(const ByteSource& source, std::uint64_t offset, std::size_t size)
{
  const Result<RawBytes> bytes = source.readAt(offset, size);
  for (std::size_t i = 0; bytes && i < size; ++i)
  {
    if (static_cast<char>(bytes->data.get()[i]) != byteAt(static_cast<std::size_t>(offset) + i))
    {
      return false;
    }
  }
  return true;
}

RemoteOptions impatient()
{
  RemoteOptions options;
  options.timeLimit = std::chrono::milliseconds(500);
  options.firstPause = std::chrono::milliseconds(1);
  options.retries = 1;
  return options;
}
} // namespace

TEST(MutatedAnswers, GiveTheBytesOfTheFileOrAnError)
{
  HostileServer server;
  unsigned opened = 0;
  const unsigned rounds = test::randomRounds(200);
  for (unsigned seed = 1; seed <= rounds; ++seed)
  {
    const RemoteOpener opener(impatient()); // it asks a server that gave no answer again
    const std::string address = server.origin() + "/" + std::to_string(seed);
    server.seed = seed % 2 == 0 ? seed : 0; // an opening, or what is read afterwards
    const auto source = opener.open(address, { 4096, 0 });
    server.seed = seed;
    if (source)
    {
      ++opened;
      EXPECT_TRUE(isRightOrError(**source, 0, 4000)) << seed;
      EXPECT_TRUE(isRightOrError(**source, 100000, 20000)) << seed;
    }
    else
    {
      EXPECT_NE(source.error().what.find(address), std::string::npos) << source.error().what;
    }
  }
  EXPECT_GT(opened, rounds / 4); // the machine may be busy
}

TEST(MutatedAnswers, ARangeIsReadAsItIsWrittenOrNotAtAll)
{
  unsigned taken = 0;
  const unsigned rounds = test::randomRounds(4000);
  for (unsigned seed = 1; seed <= rounds; ++seed)
  {
    const std::string text = mutationOf(seed).of("bytes 4096-20479/300000");
    if (const auto range = ContentRange::parse(text); range && !range->empty)
    {
      ++taken;
      EXPECT_LE(range->first, range->last) << text;
      EXPECT_LT(range->last, range->total) << text;
    }
  }
  EXPECT_GT(taken, 0u);
}

TEST(MutatedAnswers, AddressesAndWhatIsSaidOfServers)
{
  unsigned taken = 0;
  const unsigned rounds = test::randomRounds(4000);
  for (unsigned seed = 1; seed <= rounds; ++seed)
  {
    test::TextMutation mutation = mutationOf(seed);
    const std::string text =
      mutation.of("https://me:pass@host:81/a/b.pfront?sig=1&v=2#far:offline=1&timeout=5");
    if (const Result<Address> address = Address::parse(text))
    {
      ++taken;
      const Result<Address> again = Address::parse(address->textWithSettings());
      ASSERT_TRUE(again) << text;
      EXPECT_EQ(again->textWithSettings(), address->textWithSettings()) << text;
      EXPECT_EQ(again->publicForm(), address->publicForm()) << text;
      static_cast<void>(address->redirected(mutation.of("../c?d")));
      static_cast<void>(address->place());
    }
    const std::string said = mutation.of("[https://h.example]\nA-Header: SECRET\n"
                                         "~0123456789abcdef https://h.example/a?sig=SECRET");
    if (const Result<void> learnt = learnCredentials(said); !learnt)
    {
      EXPECT_EQ(learnt.error().what.find("SECRET"), std::string::npos) << said;
    }
  }
  EXPECT_GT(taken, rounds / 4);
}

} // namespace pointfront
