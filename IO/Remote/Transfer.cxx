#include "Transfer.h"

#include "CertificateFile.h"

#include "pointfront/Base/LetterCase.h"
#include "pointfront/Threads/ForkHold.h"

#include <algorithm>
#include <arpa/inet.h>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <netinet/in.h>
#include <new>
#include <string_view>
#include <sys/socket.h>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::size_t mostHeaderBytes = std::size_t(256) << 10;
constexpr std::size_t mostUnwantedBytes = std::size_t(64) << 10; ///< for a body without an answer
constexpr std::size_t mostWords = 4096; ///< its first bytes, which name the fault
constexpr std::uint64_t mostReservedBytes = std::uint64_t(8) << 20;
constexpr long connectSeconds = 10;
constexpr long stallSeconds = 10; ///< without a byte
constexpr const char* agent = "pointfront/0.1";

std::string trimmed(std::string_view text)
{
  while (!text.empty() && isAsciiSpace(text.front()))
  {
    text.remove_prefix(1);
  }
  while (!text.empty() && isAsciiSpace(text.back()))
  {
    text.remove_suffix(1);
  }
  return std::string(text);
}

/// Whether it is of this machine or its network: no server that the public reaches.
bool isPrivate(const sockaddr* address)
{
  const auto privateIPv4 = [](std::uint32_t host)
  {
    const std::uint32_t first = host >> 24;
    return first == 0 || first == 10 || first == 127 || (host >> 20) == 0xac1 ||
      (host >> 16) == 0xc0a8 || (host >> 16) == 0xa9fe || (host >> 22) == (0x64400000u >> 22);
  };
  if (address->sa_family == AF_INET)
  {
    sockaddr_in four;
    std::memcpy(&four, address, sizeof four);
    return privateIPv4(ntohl(four.sin_addr.s_addr));
  }
  if (address->sa_family == AF_INET6)
  {
    sockaddr_in6 six;
    std::memcpy(&six, address, sizeof six);
    const in6_addr& a = six.sin6_addr;
    if (IN6_IS_ADDR_V4MAPPED(&a))
    {
      std::uint32_t host = 0;
      std::memcpy(&host, a.s6_addr + 12, 4);
      return privateIPv4(ntohl(host));
    }
    return IN6_IS_ADDR_LOOPBACK(&a) || IN6_IS_ADDR_UNSPECIFIED(&a) || IN6_IS_ADDR_LINKLOCAL(&a) ||
      (a.s6_addr[0] & 0xfe) == 0xfc;
  }
  return true;
}

curl_socket_t openPublicSocket(void*, curlsocktype, curl_sockaddr* address)
{
  if (isPrivate(&address->addr))
  {
    return CURL_SOCKET_BAD;
  }
  return ::socket(address->family, address->socktype | SOCK_CLOEXEC, address->protocol);
}

// An exception must not pass through the library: what finds no memory ends the transfer.
std::size_t onHeader(char* data, std::size_t, std::size_t size, void* transfer)
{
  try
  {
    return static_cast<Transfer*>(transfer)->takeHeader({ data, size });
  }
  catch (const std::bad_alloc&)
  {
    return 0;
  }
}

std::size_t onBody(char* data, std::size_t, std::size_t size, void* transfer)
{
  try
  {
    return static_cast<Transfer*>(transfer)->takeBody(data, size);
  }
  catch (const std::bad_alloc&)
  {
    return 0;
  }
}

CURL* newEasy()
{
  const ForkHold hold; // the library has a lock for this
  return curl_easy_init();
}
} // namespace

Transfer::Transfer(std::string line, const HttpQuestion& question, HttpAnswer& answer)
  : line_(std::move(line))
  , question_(&question)
  , answer_(&answer)
  , easy_(newEasy())
{
  if (easy_ == nullptr)
  {
    throw std::bad_alloc();
  }
  prepare();
}

Transfer::~Transfer()
{
  curl_slist_free_all(headers_);
  curl_easy_cleanup(easy_);
}

std::size_t Transfer::takeHeader(std::string_view text)
{
  headerBytes_ += text.size();
  if (headerBytes_ > mostHeaderBytes)
  {
    tooMuch_ = true;
    return 0;
  }
  if (text.compare(0, 5, "HTTP/") == 0)
  {
    answer_->headers.clear(); // headers of a proxy, or of an interim answer
    return text.size();
  }
  const std::size_t colon = text.find(':');
  if (colon != std::string_view::npos)
  {
    answer_->headers[lowered(text.substr(0, colon))] = trimmed(text.substr(colon + 1));
  }
  return text.size();
}

std::size_t Transfer::takeBody(const char* data, std::size_t size)
{
  if (answer_->status == 0)
  {
    curl_easy_getinfo(easy_, CURLINFO_RESPONSE_CODE, &answer_->status);
  }
  const bool whole = answer_->status == 200 && question_->wholeAtMost > 0;
  const std::uint64_t most = whole ? question_->wholeAtMost : question_->expected;
  if (answer_->status != 206 && !whole)
  {
    unwanted_ += size;
    answer_->words.append(data, std::min(size, mostWords - answer_->words.size()));
    return unwanted_ <= mostUnwantedBytes ? size : 0;
  }
  if (answer_->body.empty())
  {
    answer_->body.reserve(static_cast<std::size_t>(
      std::max<std::uint64_t>(size, std::min(question_->expected, mostReservedBytes))));
  }
  if (answer_->body.size() + size > most)
  {
    tooMuch_ = true;
    return 0;
  }
  const auto* first = reinterpret_cast<const std::byte*>(data);
  answer_->body.insert(answer_->body.end(), first, first + size);
  received += size;
  return size;
}

void Transfer::prepare()
{
  const HttpQuestion& question = *question_;
  CURL* const easy = easy_;
  for (const std::string& header : question.headers)
  {
    headers_ = curl_slist_append(headers_, header.c_str());
  }
  curl_easy_setopt(easy, CURLOPT_URL, question.url.c_str());
  curl_easy_setopt(easy, CURLOPT_HTTPHEADER, headers_);
  curl_easy_setopt(easy, CURLOPT_RANGE, question.range.c_str());
  curl_easy_setopt(easy, CURLOPT_USERAGENT, agent);
  curl_easy_setopt(easy, CURLOPT_NOSIGNAL, 1L);
  curl_easy_setopt(easy, CURLOPT_FOLLOWLOCATION, 0L); // who asks decides where secrets go
  curl_easy_setopt(easy, CURLOPT_PROTOCOLS_STR, "http,https");
  curl_easy_setopt(easy, CURLOPT_CONNECTTIMEOUT, connectSeconds);
  curl_easy_setopt(easy, CURLOPT_LOW_SPEED_LIMIT, 1L);
  curl_easy_setopt(easy, CURLOPT_LOW_SPEED_TIME, stallSeconds);
  curl_easy_setopt(easy, CURLOPT_PIPEWAIT, 0L);
#if LIBCURL_VERSION_NUM >= 0x075700
  // A name that nobody resolves must not hold the other transfers when this one is given up.
  curl_easy_setopt(easy, CURLOPT_QUICK_EXIT, 1L);
#endif
  curl_easy_setopt(easy, CURLOPT_HTTP_VERSION, static_cast<long>(CURL_HTTP_VERSION_2TLS));
  curl_easy_setopt(easy, CURLOPT_HEADERFUNCTION, &onHeader);
  curl_easy_setopt(easy, CURLOPT_HEADERDATA, this);
  curl_easy_setopt(easy, CURLOPT_WRITEFUNCTION, &onBody);
  curl_easy_setopt(easy, CURLOPT_WRITEDATA, this);
  curl_easy_setopt(easy, CURLOPT_PRIVATE, this);
  curl_easy_setopt(easy, CURLOPT_ERRORBUFFER, message_);
  if (question.refusePrivate)
  {
    curl_easy_setopt(easy, CURLOPT_OPENSOCKETFUNCTION, &openPublicSocket);
    curl_easy_setopt(easy, CURLOPT_FRESH_CONNECT, 1L); // none that was opened without the check
  }
  if (const std::string file = certificateFile(); !file.empty())
  {
    curl_easy_setopt(easy, CURLOPT_CAINFO, file.c_str());
  }
  if (question.signature)
  {
    const Signature& s = *question.signature;
    curl_easy_setopt(easy, CURLOPT_AWS_SIGV4, ("aws:amz:" + s.region + ":s3").c_str());
    curl_easy_setopt(easy, CURLOPT_USERNAME, s.key.c_str());
    curl_easy_setopt(easy, CURLOPT_PASSWORD, s.secret.c_str());
  }
}

void Transfer::conclude(CURLcode code)
{
  HttpAnswer& answer = *answer_;
  using Outcome = HttpAnswer::Outcome;
  curl_easy_getinfo(easy_, CURLINFO_RESPONSE_CODE, &answer.status);
  double connected = 0.0;
  double first = 0.0;
  curl_easy_getinfo(easy_, CURLINFO_PRETRANSFER_TIME, &connected);
  curl_easy_getinfo(easy_, CURLINFO_STARTTRANSFER_TIME, &first);
  answer.firstByteSeconds = std::max(0.0, first - connected);
  if (const std::string text = answer.header("content-range"); !text.empty())
  {
    answer.range = ContentRange::parse(text);
  }
  const bool wordsCut = unwanted_ > mostUnwantedBytes && answer.status != 0;
  if (tooMuch_)
  {
    answer.outcome = Outcome::TooMuch;
    return;
  }
  if (code == CURLE_OK || wordsCut)
  {
    answer.outcome = Outcome::Answered;
    return;
  }
  // The library's own words name the host at most.
  const bool early = code == CURLE_COULDNT_RESOLVE_HOST || code == CURLE_COULDNT_RESOLVE_PROXY ||
    code == CURLE_COULDNT_CONNECT || code == CURLE_SSL_CONNECT_ERROR ||
    code == CURLE_PEER_FAILED_VERIFICATION || code == CURLE_SSL_CACERT_BADFILE ||
    code == CURLE_UNSUPPORTED_PROTOCOL || code == CURLE_URL_MALFORMAT;
  answer.text = early && message_[0] != '\0' ? message_ : curl_easy_strerror(code);
  if (code == CURLE_SSL_CACERT_BADFILE)
  {
    answer.text += " (install ca-certificates, or name a file of authorities in SSL_CERT_FILE)";
  }
  answer.final = code == CURLE_PEER_FAILED_VERIFICATION || code == CURLE_SSL_CACERT_BADFILE ||
    code == CURLE_UNSUPPORTED_PROTOCOL || code == CURLE_URL_MALFORMAT ||
    (code == CURLE_COULDNT_CONNECT && question_->refusePrivate);
  answer.outcome = early ? Outcome::NoConnection : Outcome::Broken;
}

void Transfer::giveUp()
{
  conclude(CURLE_ABORTED_BY_CALLBACK);
  answer_->outcome = HttpAnswer::Outcome::Cancelled;
  answer_->text.clear();
}

std::optional<ContentRange> ContentRange::parse(const std::string& text)
{
  ContentRange range;
  if (text.compare(0, 6, "bytes ") != 0)
  {
    return std::nullopt;
  }
  const char* at = text.c_str() + 6;
  const auto number = [&at](std::uint64_t& value)
  {
    if (std::isdigit(static_cast<unsigned char>(*at)) == 0)
    {
      return false;
    }
    char* end = nullptr;
    errno = 0;
    value = std::strtoull(at, &end, 10);
    at = end;
    return errno == 0;
  };
  if (*at == '*')
  {
    ++at;
    range.empty = true;
  }
  else if (!number(range.first) || *at++ != '-' || !number(range.last))
  {
    return std::nullopt;
  }
  if (*at++ != '/' || !number(range.total) || *at != '\0')
  {
    return std::nullopt;
  }
  const bool sound = range.empty || (range.first <= range.last && range.last < range.total);
  return sound ? std::optional<ContentRange>(range) : std::nullopt;
}

} // namespace pointfront
