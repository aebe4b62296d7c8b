#pragma once

#include "ReadPatience.h"
#include "RemoteOptions.h"

#include "pointfront/Base/Result.h"
#include "pointfront/Threads/OfProcess.h"

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// The facts of a far file that must not change while it is open.
struct RemoteIdentity
{
  std::string tag; ///< ETag, as the server writes it; empty: it gives none
  std::string changed; ///< Last-Modified
  std::uint64_t bytes = 0;
  bool replaced = false; ///< an answer was of another file
  std::chrono::seconds unchangedFor{ 0 }; ///< the server's promise, from its first answer on
};

/// Bytes of a far file that are wanted, and what has come of them.
struct WantedBytes
{
  std::uint64_t offset = 0; ///< offset of the first byte; for a tail it is known afterwards
  std::uint64_t size = 0; ///< for a tail longer than the file: cut down afterwards
  bool tail = false; ///< the last `size` bytes
  std::vector<std::byte> bytes;
  bool complete = false;
  bool whole = false; ///< the server gave the whole file instead
};

/// Asks the server of a file for parts of it, again where that may help, and follows redirections.
/// It lets no byte pass that may be another file's.
/// Secrets   headers and signatures go to the origin of the request alone, never to one that it is
///           redirected to.
/// Threads   all functions from any thread; a child of fork() goes on with it.
class Conversation
{
public:
  Conversation(std::string name, Request request, const RemoteOptions& options)
    : name_(std::move(name))
    , request_(std::move(request))
    , options_(options)
  {
  }

  /// All parts, or an error. After Cancelled, which comes soon after `cancelled` or StopOfReads,
  /// some parts may be there, or the beginnings of some. Without a known identity, that of the
  /// first answer is taken.
  Result<void> fetch(std::vector<WantedBytes>& wanted, std::optional<RemoteIdentity>& identity,
    const std::atomic<bool>& cancelled) const;
  /// The line of the TransferLoop.
  std::string line() const { return request_.address.origin(); }
  const std::string& name() const { return name_; }
  std::string place() const { return request_.address.place(); }

private:
  /// The verdict on one answer.
  enum class Verdict
  {
    Good, ///< something has come
    Again, ///< try again, after a pause
    Redirected ///< try again at once
  };
  struct Redirection
  {
    std::mutex mutex; ///< guards all that follows
    std::optional<Address> elsewhere; ///< where the address was redirected to
    /// How long the redirections up to there promise to last: a name that leads elsewhere tomorrow
    /// is another file, whatever the file that it leads to promises.
    std::chrono::seconds lastsFor = std::chrono::seconds::max();
    unsigned inSequence = 0;
  };
  /// One question for each part that is missing.
  struct Round
  {
    bool news = false; ///< something has come
    bool again = false; ///< something did not, and may later
    std::chrono::milliseconds askedPause{ 0 }; ///< by the server
    std::string reason;
  };
  Result<Round> ask(const std::vector<WantedBytes*>& missing,
    std::optional<RemoteIdentity>& identity, ReadPatience& patience,
    const std::atomic<bool>& cancelled) const;
  HttpQuestion questionFor(
    const WantedBytes& wanted, const std::optional<RemoteIdentity>& identity) const;
  Result<Verdict> judge(
    HttpAnswer& answer, WantedBytes& wanted, std::optional<RemoteIdentity>& identity) const;
  Result<Verdict> judgeStatus(
    HttpAnswer& answer, WantedBytes& wanted, std::optional<RemoteIdentity>& identity) const;
  Result<Verdict> takePart(
    HttpAnswer& answer, WantedBytes& wanted, std::optional<RemoteIdentity>& identity) const;
  Result<Verdict> takeWhole(
    HttpAnswer& answer, WantedBytes& wanted, std::optional<RemoteIdentity>& identity) const;
  Result<Verdict> countFromFront(
    const HttpAnswer& answer, WantedBytes& wanted, std::optional<RemoteIdentity>& identity) const;
  Result<void> compare(
    const HttpAnswer& answer, std::uint64_t bytes, std::optional<RemoteIdentity>& identity) const;
  Result<Verdict> redirect(const HttpAnswer& answer) const;
  Redirection& redirection() const;
  Address placeNow() const; ///< where the next question goes
  Error changed(std::optional<RemoteIdentity>& identity) const;
  static bool isForNow(long status); ///< a server that has too much to do
  Error refused(const HttpAnswer& answer) const;
  Error elsewhereUnknown(const HttpAnswer& answer) const;
  Error withoutParts() const;
  Error failed(Error::Kind kind, const std::string& what) const;

  const std::string name_;
  const Request request_;
  const RemoteOptions options_;
  mutable OfProcess<Redirection> redirection_;
};

} // namespace pointfront
