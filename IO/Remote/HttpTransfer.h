#pragma once

#include "pointfront/Base/Result.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// A range of a file as a server names it: "bytes 100-199/5000".
struct ContentRange
{
  std::uint64_t first = 0;
  std::uint64_t last = 0;
  std::uint64_t total = 0;
  bool empty = false; ///< "bytes */5000": nothing of it was in the file

  static std::optional<ContentRange> parse(const std::string& text);
};

/// How a request is signed for an object store.
struct Signature
{
  std::string region;
  std::string key;
  std::string secret;
};

/// One question to a server: who asks, which bytes, and where the bytes go.
struct HttpQuestion
{
  std::string url; ///< with its secrets
  std::vector<std::string> headers; ///< "Name: value"; may be secret
  std::string range; ///< "0-99", or "-500" for the last 500 bytes
  std::optional<Signature> signature;
  bool refusePrivate = false; ///< no address of this machine or its network
  std::uint64_t expected = 0; ///< bytes of a right answer: more than these end the transfer
  /// Whether a whole file (status 200) of at most so many bytes is an answer, too.
  std::uint64_t wholeAtMost = 0;
};

/// The outcome of a question.
struct HttpAnswer
{
  enum class Outcome
  {
    Answered, ///< status and headers are there; the body as far as it was wanted
    NoConnection, ///< name, connection, TLS: `text` says what; worth another try unless `final`
    Broken, ///< it ended, stalled or was reset on the way; worth another try
    TooMuch, ///< more bytes than the range, or headers without end
    Cancelled
  };
  Outcome outcome = Outcome::Cancelled;
  std::string asked; ///< the question's address, with its secrets
  bool final = false; ///< no use in trying again (an unknown name, a certificate)
  std::string text; ///< the library's text, without secrets
  long status = 0;
  std::map<std::string, std::string> headers; ///< names in small letters; the last of a name
  std::optional<ContentRange> range; ///< range of status 206 and 416
  std::string words; ///< the beginning of what a server says about a fault
  std::vector<std::byte> body; ///< body of status 206 and 200, as far as it came
  double firstByteSeconds = 0.0; ///< from the request, connected, to the first byte

  std::string header(const std::string& name) const
  {
    const auto found = headers.find(name);
    return found != headers.end() ? found->second : std::string();
  }
};

} // namespace pointfront
