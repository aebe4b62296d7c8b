#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>

namespace pointfront
{

/// Bytes taken out of a hard limit, all or nothing, and the wish to know when some came back.
/// A budget may be a part of a larger one (a store's of the process's): what is reserved fits both.
/// Outlives whoever reserves: memory that is still held elsewhere stays on the account.
/// Threads  all functions from any thread; no other lock is taken inside.
class MemoryBudget
{
public:
  static constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();

  explicit MemoryBudget(std::size_t limitBytes, std::shared_ptr<MemoryBudget> whole = nullptr);

  /// True when the bytes fit: they are taken then.
  bool reserve(std::size_t bytes);
  void giveBack(std::size_t bytes);
  /// A lower limit takes nothing away: no reservation succeeds until enough was given back.
  void setLimit(std::size_t bytes);

  /// Of this part and of the whole: the lower one.
  std::size_t limit() const;
  std::size_t ownLimit() const { return limit_; }
  std::size_t used() const { return used_; }
  std::size_t usedMax() const { return usedMax_; }
  /// Whether `bytes` could be reserved once `returned` bytes were given back.
  bool fits(std::size_t bytes, std::size_t returned = 0) const;

  /// Every change that someone may wait for has a number, one row for the whole and its parts: read
  /// it, look at what matters, and wait for the next one. A change between the look and the wait
  /// ends the wait at once.
  std::uint64_t changes() const;
  void announceChange();
  void waitForChange(std::uint64_t seen) const;
  /// The same, at most until `end`.
  void waitForChange(std::uint64_t seen, std::chrono::steady_clock::time_point end) const;

private:
  const std::shared_ptr<MemoryBudget> whole_; ///< null: this is the whole
  std::atomic<std::size_t> limit_;
  std::atomic<std::size_t> used_{ 0 };
  std::atomic<std::size_t> usedMax_{ 0 };
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::uint64_t changes_ = 0;
};

} // namespace pointfront
