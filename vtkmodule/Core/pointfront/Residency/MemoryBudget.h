#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>

namespace pointfront
{

/// Bytes taken out of a hard limit, all or nothing, and the wish to know when some came back.
/// Outlives whoever reserves: memory that is still held elsewhere stays on the account.
/// Threads  all functions from any thread; no other lock is taken inside.
class MemoryBudget
{
public:
  explicit MemoryBudget(std::size_t limitBytes);

  /// True when the bytes fit: they are taken then.
  bool reserve(std::size_t bytes);
  void giveBack(std::size_t bytes);
  /// A lower limit takes nothing away: no reservation succeeds until enough was given back.
  void setLimit(std::size_t bytes);

  std::size_t limit() const { return limit_; }
  std::size_t used() const { return used_; }
  std::size_t usedMax() const { return usedMax_; }
  bool fits(std::size_t bytes) const;

  /// Every change that someone may wait for has a number: read it, look at what matters, and wait
  /// for the next one. A change between the look and the wait ends the wait at once.
  std::uint64_t changes() const;
  void announceChange();
  void waitForChange(std::uint64_t seen) const;

private:
  std::atomic<std::size_t> limit_;
  std::atomic<std::size_t> used_{ 0 };
  std::atomic<std::size_t> usedMax_{ 0 };
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::uint64_t changes_ = 0;
};

} // namespace pointfront
