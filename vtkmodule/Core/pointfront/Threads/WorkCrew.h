#pragma once

#include "pointfront/Base/Progress.h"
#include "pointfront/Base/Result.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

namespace pointfront
{

/// The threads of one build: runs a piece of work on all of them, stops all at the first Error
/// or when the user cancels, and tells the user how far the work is.
class WorkCrew
{
public:
  explicit WorkCrew(ProgressFunction progress)
    : WorkCrew(1, std::move(progress))
  {
  }
  WorkCrew(unsigned threads, ProgressFunction progress);

  unsigned threads() const { return threads_; }
  /// Between two run().
  void setThreads(unsigned threads) { threads_ = threads; }

  /// Calls `work` once for each thread and waits for all. The first Error stops the others at
  /// their next stopped(); running out of memory is an Error too.
  Result<void> run(const std::function<Result<void>()>& work);

  /// Enters a phase: `weight` is its share of the whole operation, all shares sum up to 1.
  void beginPhase(const char* name, std::uint64_t total, double weight);
  /// Hands a sentence to the user's function at once; between two run().
  void tell(const std::string& notice);
  /// Begins the phase again: its work so far was in vain.
  void repeatPhase() { done_ = 0; }
  /// Adds to what is done; from any thread. May call the user's function.
  void advance(std::uint64_t points);
  /// True once the work is to be given up: an Error, or the user cancelled.
  bool stopped() const { return stop_.load(std::memory_order_relaxed); }
  /// The reason, when stopped().
  Result<void> outcome() const;
  void fail(const Error& error);
  double secondsElapsed() const;

private:
  void report(bool always, const std::string& notice = {});

  unsigned threads_;
  ProgressFunction progress_;
  std::chrono::steady_clock::time_point start_;
  std::atomic<bool> stop_{ false };
  std::atomic<std::uint64_t> done_{ 0 };
  mutable std::mutex errorMutex_;
  std::optional<Error> error_;
  std::mutex reportMutex_; // guards what follows
  const char* phase_ = "";
  std::uint64_t total_ = 0;
  double fractionBefore_ = 0.0;
  double weight_ = 0.0;
  double lastReport_ = -1.0;
};

} // namespace pointfront
