// How a pool comes by slots: it drops what is not drawn, grows, and gives blocks back.
#include "GpuPool.h"

#include "GpuAccount.h"

#include <algorithm>
#include <cstddef>

namespace pointfront
{
namespace
{

constexpr std::uint32_t fewestSlots = 8; ///< nothing is given back below it: 32 K points
/// A pool grows by an eighth of what it has, a small one by what it wants.
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

bool GpuPool::makeRoom(const DrawList& draw)
{
  if (lowered_)
  {
    leaveScreen(); // other views, too, bring theirs again
  }
  mark(draw);
  keepWithin(draw);
  addStreams();
  std::uint64_t missing = 0;
  for (const PlanItem* item : draw)
  {
    const std::uint64_t wanted = gpuSlotsOf(item->last);
    const auto found = entries_.find(item->node->node);
    const std::uint64_t there = found == entries_.end() ? 0 : found->second.slots.size();
    missing += wanted - std::min(wanted, there);
  }
  return makeFree(missing);
}

/// Marks the nodes of this frame as drawn.
void GpuPool::mark(const DrawList& draw)
{
  for (const PlanItem* item : draw)
  {
    const auto found = entries_.find(item->node->node);
    if (found != entries_.end())
    {
      Entry& entry = found->second;
      const bool others = entry.frame + limits_.views > frame_; // another view draws it as well
      entry.wanted = others ? std::max(entry.wanted, item->last) : item->last;
      entry.frame = frame_;
    }
  }
}

void GpuPool::keepWithin(const DrawList& draw)
{
  if (slotLimit_ != 0 && slotCount() / 2 > std::max(slotLimit_, fewestSlots))
  {
    while (blocks_.back().first() >= std::max(slotLimit_, fewestSlots) && giveBack())
    {
    }
  }
  while (tooMuch(0) && (giveBack() || (trim() && giveBack())))
  {
  }
  if (!tooMuch(0))
  {
    return;
  }
  account_->reclaim(account_->bytes() - limits_.bytes, *this);
  // The frame draws more than there may be: a front comes down by some moves a frame in motion.
  for (auto item = draw.rbegin(); item != draw.rend() && bytes_ > limits_.bytes; ++item)
  {
    const auto farthest = entries_.find((*item)->node->node);
    if (farthest != entries_.end())
    {
      free_.insert(free_.end(), farthest->second.slots.begin(), farthest->second.slots.end());
      entries_.erase(farthest);
    }
    while (tooMuch(0) && giveBack())
    {
    }
  }
}

/// Where styles want streams and there are none; where they do not fit beside the others, all
/// begins anew.
void GpuPool::addStreams()
{
  std::int64_t more = 0;
  for (const GpuBlock& block : blocks_)
  {
    const int streams = block.missing(wanted_) - block.unwanted(wanted_);
    more += streams * std::int64_t(block.slots()) * slotPoints * GpuSlotBytes::value;
  }
  if (more > 0 && tooMuch(more))
  {
    release();
  }
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
  if (!std::all_of(blocks_.begin(), blocks_.end(), whole))
  {
    refused_ = true;
    release(); // and what the frame draws comes again, as far as there is room
  }
}

/// Below the limit: more memory. At the limit: what is not drawn gives way; if all is drawn, more.
bool GpuPool::makeFree(std::uint64_t slots)
{
  while (free_.size() < slots)
  {
    const std::uint64_t missing = slots - free_.size();
    const bool below = slotLimit_ != 0 && slotCount() < slotLimit_;
    if (!(below && grow(missing)) && !evictOne() && !grow(missing) && !trim())
    {
      return false;
    }
  }
  return true;
}

bool GpuPool::isIdle(const Entry& entry) const
{
  return entry.frame + limits_.views <= frame_ && !entry.slots.empty();
}

void GpuPool::listIdle()
{
  for (const auto& [node, entry] : entries_)
  {
    if (isIdle(entry))
    {
      idle_.emplace_back(entry.frame, node);
    }
  }
  std::sort(idle_.begin(), idle_.end(),
    [](const auto& a, const auto& b)
    { return a.first != b.first ? a.first > b.first : a.second < b.second; });
}

/// The list may be older than this frame: what became idle since was drawn after all that is in it,
/// and what was drawn again is passed over.
bool GpuPool::evictOne()
{
  if (evictListed())
  {
    return true;
  }
  listIdle();
  return evictListed();
}

bool GpuPool::evictListed()
{
  while (!idle_.empty())
  {
    const auto [frame, node] = idle_.back();
    idle_.pop_back();
    const auto entry = entries_.find(node);
    if (entry != entries_.end() && entry->second.frame == frame && isIdle(entry->second))
    {
      free_.insert(free_.end(), entry->second.slots.begin(), entry->second.slots.end());
      entries_.erase(entry);
      return true;
    }
  }
  return false;
}

/// Slots of points that are no longer drawn of nodes that are. False if there are none.
bool GpuPool::trim()
{
  const std::size_t before = free_.size();
  for (auto& [node, entry] : entries_)
  {
    const std::uint64_t wanted = gpuSlotsOf(entry.wanted);
    while (entry.slots.size() > wanted)
    {
      free_.push_back(entry.slots.back());
      entry.slots.pop_back();
    }
    const auto most = static_cast<std::uint32_t>(entry.slots.size() * slotPoints);
    entry.points = std::min(entry.points, most);
    for (std::uint32_t& filled : entry.filled)
    {
      filled = std::min(filled, most);
    }
  }
  return free_.size() > before;
}

/// By a block, towards `slots` more; false if the budget of bytes, or the GPU, has no room for it.
bool GpuPool::grow(std::uint64_t slots)
{
  const std::int64_t slotBytes = GpuSlotBytes::of(wanted_.count());
  const std::uint64_t wanted =
    std::max<std::uint64_t>(slotCount() / growthShare, std::min(slots, mostSmallSlots));
  auto size = static_cast<std::int64_t>(powerBelow(std::min(wanted, mostBlockSlots)));
  if (tooMuch(size * slotBytes))
  {
    account_->reclaim(account_->bytes() + size * slotBytes - limits_.bytes, *this);
    size = std::min(size, (limits_.bytes - account_->bytes()) / slotBytes);
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

bool GpuPool::giveBack()
{
  if (blocks_.empty())
  {
    return false;
  }
  while (free_.size() < blocks_.back().slots())
  {
    if (!evictOne())
    {
      return false;
    }
  }
  dropLast();
  return true;
}

/// Its nodes move to free slots of the other blocks, of which there are enough.
void GpuPool::dropLast()
{
  GpuBlock& last = blocks_.back();
  const auto outside = std::partition(
    free_.begin(), free_.end(), [&](std::uint32_t slot) { return slot < last.first(); });
  free_.erase(outside, free_.end());
  for (auto& [node, entry] : entries_)
  {
    for (std::uint32_t& slot : entry.slots)
    {
      if (slot >= last.first())
      {
        const std::uint32_t to = free_.back();
        free_.pop_back();
        blocks_[blockOf(to)].copy(last, slot, to);
        slot = to;
      }
    }
  }
  charge(-last.bytes());
  last.release();
  blocks_.pop_back();
}

} // namespace pointfront
