#pragma once

#include "pointfront/Base/Error.h"
#include "pointfront/Store/MissingRows.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <vector>

namespace pointfront
{

/// Parts of a node table that are read when somebody looks into them, by their numbers: tiles of a
/// list, pages of a foreign hierarchy. Once read they stay.
/// Order    the part that was asked for first is read first, several at a time where the table says
///          so. At most 64 wait; who does not get what it asked for asks again.
/// Faults   each part's once.
/// Threads  all functions from any thread. No lock is held while a part is read.
class WantedParts final : public MissingRows
{
public:
  /// Called when a part has ended, well or not.
  using Ended = std::function<void(std::size_t part)>;
  struct Reading
  {
    /// How many parts are read together if this is the first of them.
    std::function<std::size_t(std::size_t part)> atOnce;
    /// Reads the parts, and tells of each that it has ended. Returns the bytes read.
    std::function<std::size_t(const std::vector<std::size_t>& parts, const Ended& ended)> read;
  };
  explicit WantedParts(Reading reading)
    : reading_(std::move(reading))
  {
  }

  void want(std::size_t part);
  void noteFault(std::size_t part, const Error& error);
  /// True when the last of the readers has gone: what is being read is wanted by nobody.
  bool abandoned() const { return left_; }

  bool waiting() const override { return any_; }
  std::size_t readNext() override;
  void attach(const void* reader, std::function<void()> tell) override;
  void detach(const void* reader) override;

  /// The answers of a Hierarchy of these parts.
  std::uint64_t arrivals() const { return arrivals_; }
  bool wait(std::uint64_t seen, std::chrono::steady_clock::time_point end);
  std::optional<Error> fault() const;
  std::vector<Error> takeFaults();

private:
  /// Who looks into others looks again when these are here, and may have gone elsewhere meanwhile.
  static constexpr std::size_t most = 64;

  const Reading reading_;
  std::atomic<std::uint64_t> arrivals_{ 0 };
  std::atomic<bool> any_{ false }; ///< !wanted_.empty(); written under the lock
  std::atomic<bool> left_{ false };

  std::mutex mutex_; ///< guards what follows
  std::condition_variable changed_;
  std::vector<std::size_t> wanted_; ///< the oldest first
  std::vector<std::size_t> beingRead_;
  std::map<const void*, std::function<void()>> readers_;

  mutable std::mutex faultMutex_; ///< guards what follows
  std::set<std::size_t> lost_; ///< whose fault was noted
  std::optional<Error> firstFault_;
  std::vector<Error> newFaults_;
};

} // namespace pointfront
