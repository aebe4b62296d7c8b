#pragma once

#include "HttpTransfer.h"
#include "ReadPatience.h"

#include "pointfront/Disk/ByteSource.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// The requests of this process to servers so far.
struct RemoteStatistics
{
  std::uint64_t requests = 0;
  std::uint64_t bytes = 0; ///< bytes of bodies
  std::uint64_t retries = 0;
};

/// The network of a process: one thread that runs all transfers, over connections that are kept.
/// Lines     each origin (scheme, host, port) is a line. It learns round trip and bytes a second,
/// and
///           how many requests at once the server bears: more while they succeed (32 at most), half
///           of them when it refuses (429, 503) or resets.
/// Threads   all functions from any thread; run() waits on the caller's.
/// Fork      a child process has a loop of its own.
class TransferLoop
{
public:
  static TransferLoop& ofProcess();

  TransferLoop();
  ~TransferLoop();
  TransferLoop(const TransferLoop&) = delete;
  TransferLoop& operator=(const TransferLoop&) = delete;

  /// Asks all and waits for all answers, as long as `patience` lasts and neither `cancelled`
  /// nor StopOfReads is: a few hundredths of a second later the transfers are ended. Questions of
  /// one call go to one line, in their order. While none of them has begun, bytes of others on the
  /// line count.
  std::vector<HttpAnswer> run(const std::string& line, const std::vector<HttpQuestion>& questions,
    ReadPatience& patience, const std::atomic<bool>& cancelled);

  /// Whether the line's server has answered anything since then, be it a refusal.
  bool answeredSince(const std::string& line, std::chrono::steady_clock::time_point when) const;
  ReadCost cost(const std::string& line) const;
  /// The server has asked for patience: fewer at once.
  void noteRefusal(const std::string& line);
  void noteRetry();
  RemoteStatistics statistics() const;

private:
  struct Content;
  std::unique_ptr<Content> content_;
};

} // namespace pointfront
