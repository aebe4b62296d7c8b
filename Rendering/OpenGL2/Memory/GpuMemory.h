#pragma once

#include "GpuBlock.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace pointfront
{

class GpuAccount;

/// GPU memory of one cloud in one GL context: equal slots in blocks of vertex buffers, and which of
/// them are free. Blocks come and go, so growing copies nothing and takes no extra memory. The
/// clouds of a window share its budget of bytes (GpuAccount).
/// Threads  one thread, that of the GL context, which must be current where buffers change.
class GpuMemory
{
public:
  /// Moves its bytes to the account of another window.
  void enter(std::shared_ptr<GpuAccount> account);
  const std::shared_ptr<GpuAccount>& account() const { return account_; }
  /// Takes its bytes out of the account: the context is gone, and its buffers with it.
  void leave();

  /// Sets the budget of the window in bytes; 0: no limit.
  void setLimit(std::int64_t bytes) { limit_ = bytes; }
  std::int64_t limit() const { return limit_; }
  /// Whether the window would have more than its budget with `more` bytes.
  bool exceeds(std::int64_t more = 0) const;
  std::int64_t bytes() const { return bytes_; }
  std::int64_t windowBytes() const; ///< bytes of all clouds of the window
  /// True once after the GPU had less memory than the budgets allow.
  bool takeRefused() { return std::exchange(refused_, false); }

  /// Sets the streams that blocks have, and gives back those that blocks no longer need.
  void setStreams(const GpuStreams& wanted);
  /// Bytes of the streams that blocks lack, less those that they do not need.
  std::int64_t missingBytes() const;
  /// Makes the streams that blocks lack; false if the GPU has no room for them.
  bool addStreams();

  const std::vector<GpuBlock>& blocks() const { return blocks_; }
  /// Number of the block that has a slot.
  std::size_t blockOf(std::uint32_t slot) const;
  const GpuBlock& blockWith(std::uint32_t slot) const { return blocks_[blockOf(slot)]; }
  std::uint32_t slotCount() const { return blocks_.empty() ? 0 : blocks_.back().end(); }

  std::size_t freeCount() const { return free_.size(); }
  /// Takes a free slot; there is one.
  std::uint32_t take();
  void give(std::uint32_t slot) { free_.push_back(slot); }
  void give(const std::vector<std::uint32_t>& slots);

  /// Adds a block towards `slots` more slots. It calls `reclaim` with the bytes that it lacks, for
  /// others to give back. False if the budget of bytes, or the GPU, has no room for a block.
  bool grow(std::uint64_t slots, const std::function<void(std::int64_t)>& reclaim);
  /// Drops the last block: its slots are no longer free, moveOut() gives those in use another place
  /// in the other blocks, which have enough, and dropLast() gives the buffers back.
  void closeLast();
  bool isInLast(std::uint32_t slot) const { return slot >= blocks_.back().first(); }
  std::uint32_t moveOut(std::uint32_t slot);
  void dropLast();
  /// Gives all buffers back.
  void release();

private:
  void charge(std::int64_t bytes);

  std::shared_ptr<GpuAccount> account_;
  GpuStreams wanted_;
  std::vector<GpuBlock> blocks_; ///< each goes on where the one before ends
  std::vector<std::uint32_t> free_; ///< slots
  std::int64_t limit_ = 0;
  std::int64_t bytes_ = 0;
  bool refused_ = false;
};

} // namespace pointfront
