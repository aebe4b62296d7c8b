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

/// An account of bytes under a hard limit. A reservation takes all of its bytes or none, and a
/// thread can wait until bytes come back. A budget may be a part of a larger one (a store's budget
/// is part of the process's): a reservation fits both. It outlives its users: memory that is still
/// held elsewhere stays on the account.
/// Threads  all functions from any thread; no other lock is taken inside.
class MemoryBudget
{
public:
  static constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();

  explicit MemoryBudget(std::size_t limitBytes, std::shared_ptr<MemoryBudget> whole = nullptr);

  /// Takes the bytes if they fit; true when it did.
  bool reserve(std::size_t bytes);
  void giveBack(std::size_t bytes);
  /// A lower limit takes no reserved bytes away: no reservation succeeds until enough bytes were
  /// given back.
  void setLimit(std::size_t bytes);

  /// The lower one of the limits of this part and of the whole.
  std::size_t limit() const;
  std::size_t ownLimit() const { return limit_; }
  std::size_t used() const { return used_; }
  std::size_t usedMax() const { return usedMax_; }
  /// Whether `bytes` could be reserved once `returned` bytes were given back.
  bool fits(std::size_t bytes, std::size_t returned = 0) const;

  /// Every change that a thread may wait for has a number; the whole and its parts count together.
  /// Read the number, look at the state, and wait for the next number. A change between the look
  /// and the wait ends the wait at once.
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
