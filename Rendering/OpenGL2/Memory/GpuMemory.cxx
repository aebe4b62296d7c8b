#include "GpuMemory.h"

#include "GpuAccount.h"

#include <algorithm>

namespace pointfront
{
namespace
{

/// Memory grows by an eighth of its slots; where these are few, by the number that is wanted.
constexpr std::uint32_t growthShare = 8;
constexpr std::uint64_t mostSmallSlots = 8;
constexpr std::uint64_t mostBlockSlots = 4096; ///< 256 MiB

/// The largest power of two that is not larger; 1 for 0.
std::uint64_t powerBelow(std::uint64_t value)
{
  std::uint64_t power = 1;
  while (power <= value / 2)
  {
    power *= 2;
  }
  return power;
}

} // namespace

void GpuMemory::enter(std::shared_ptr<GpuAccount> account)
{
  leave();
  account_ = std::move(account);
  account_->charge(bytes_);
}

void GpuMemory::leave()
{
  if (account_)
  {
    account_->charge(-bytes_);
  }
}

void GpuMemory::charge(std::int64_t bytes)
{
  bytes_ += bytes;
  account_->charge(bytes);
}

bool GpuMemory::exceeds(std::int64_t more) const
{
  return limit_ > 0 && account_->bytes() + more > limit_;
}

std::int64_t GpuMemory::windowBytes() const
{
  return account_ ? account_->bytes() : 0;
}

void GpuMemory::setStreams(const GpuStreams& wanted)
{
  wanted_ = wanted;
  for (GpuBlock& block : blocks_)
  {
    if (block.unwanted(wanted_) > 0 && block.missing(wanted_) == 0)
    {
      charge(-block.bytes());
      block.setStreams(wanted_);
      charge(block.bytes());
    }
  }
}

std::int64_t GpuMemory::missingBytes() const
{
  std::int64_t more = 0;
  for (const GpuBlock& block : blocks_)
  {
    const int streams = block.missing(wanted_) - block.unwanted(wanted_);
    more += streams * std::int64_t(block.slots()) * gpuSlotPoints * GpuSlotBytes::value;
  }
  return more;
}

bool GpuMemory::addStreams()
{
  for (GpuBlock& block : blocks_)
  {
    if (block.missing(wanted_) > 0)
    {
      charge(-block.bytes());
      block.setStreams(wanted_);
      charge(block.bytes());
    }
  }
  const auto whole = [this](const GpuBlock& block) { return block.whole(wanted_); };
  const bool all = std::all_of(blocks_.begin(), blocks_.end(), whole);
  refused_ = refused_ || !all;
  return all;
}

std::size_t GpuMemory::blockOf(std::uint32_t slot) const
{
  const auto after = std::upper_bound(blocks_.begin(), blocks_.end(), slot,
    [](std::uint32_t wanted, const GpuBlock& block) { return wanted < block.first(); });
  return static_cast<std::size_t>(after - blocks_.begin()) - 1;
}

std::uint32_t GpuMemory::take()
{
  const std::uint32_t slot = free_.back();
  free_.pop_back();
  return slot;
}

void GpuMemory::give(const std::vector<std::uint32_t>& slots)
{
  free_.insert(free_.end(), slots.begin(), slots.end());
}

bool GpuMemory::grow(std::uint64_t slots, const std::function<void(std::int64_t)>& reclaim)
{
  const std::int64_t slotBytes = GpuSlotBytes::of(wanted_.count());
  const std::uint64_t wanted =
    std::max<std::uint64_t>(slotCount() / growthShare, std::min(slots, mostSmallSlots));
  auto size = static_cast<std::int64_t>(powerBelow(std::min(wanted, mostBlockSlots)));
  if (exceeds(size * slotBytes))
  {
    reclaim(account_->bytes() + size * slotBytes - limit_);
    size = std::min(size, (limit_ - account_->bytes()) / slotBytes);
  }
  if (size <= 0)
  {
    return false;
  }
  blocks_.emplace_back(slotCount(), static_cast<std::uint32_t>(size), wanted_);
  if (!blocks_.back().whole(wanted_))
  {
    refused_ = true;
    blocks_.back().release();
    blocks_.pop_back();
    return false;
  }
  charge(blocks_.back().bytes());
  for (std::uint32_t slot = blocks_.back().end(); slot-- > blocks_.back().first();)
  {
    free_.push_back(slot); // the lowest is taken first
  }
  return true;
}

void GpuMemory::closeLast()
{
  const std::uint32_t first = blocks_.back().first();
  const auto outside = std::partition(
    free_.begin(), free_.end(), [first](std::uint32_t slot) { return slot < first; });
  free_.erase(outside, free_.end());
}

std::uint32_t GpuMemory::moveOut(std::uint32_t slot)
{
  const std::uint32_t to = take();
  blocks_[blockOf(to)].copy(blocks_.back(), slot, to);
  return to;
}

void GpuMemory::dropLast()
{
  charge(-blocks_.back().bytes());
  blocks_.back().release();
  blocks_.pop_back();
}

void GpuMemory::release()
{
  for (GpuBlock& block : blocks_)
  {
    charge(-block.bytes());
    block.release();
  }
  blocks_.clear();
  free_.clear();
}

} // namespace pointfront
