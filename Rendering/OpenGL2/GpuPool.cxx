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
/// Slots kept beyond what may be drawn, so that turning back and forth uploads nothing: a quarter.
constexpr std::uint32_t cacheShare = 4;

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

/// Calls write(slot, offset in the slot, first point, count) for each slot that [begin, end) meets.
template <typename Write>
void forSlots(const std::vector<std::uint32_t>& slots, std::uint32_t begin, std::uint32_t end,
  const Write& write)
{
  while (begin < end)
  {
    const std::uint32_t offset = begin % GpuPool::slotPoints;
    const std::uint32_t count = std::min(GpuPool::slotPoints - offset, end - begin);
    write(slots[begin / GpuPool::slotPoints], offset, begin, count);
    begin += count;
  }
}

} // namespace

GpuPool::~GpuPool()
{
  if (account_)
  {
    charge(-bytes_);
    account_->leave(*this);
  }
}

void GpuPool::enter(std::shared_ptr<GpuAccount> account)
{
  if (account_ == account)
  {
    return;
  }
  if (account_)
  {
    account_->charge(-bytes_);
    account_->leave(*this);
  }
  account_ = std::move(account);
  account_->charge(bytes_);
  account_->join(*this);
}

void GpuPool::charge(std::int64_t bytes)
{
  bytes_ += bytes;
  account_->charge(bytes);
}

std::int64_t GpuPool::windowBytes() const
{
  return account_ ? account_->bytes() : 0;
}

bool GpuPool::tooMuch(std::int64_t more) const
{
  return limits_.bytes > 0 && account_->bytes() + more > limits_.bytes;
}

const LayerStreams& GpuPool::streamsOf(std::uint16_t layer) const
{
  static const LayerStreams positions;
  return layer < streams_.size() ? streams_[layer] : positions;
}

void GpuPool::setStreams(std::vector<LayerStreams> byLayer)
{
  std::swap(streams_, byLayer); // byLayer: those before
  for (auto& [node, entry] : entries_)
  {
    for (std::size_t stream = 0; stream < gpuStreamCount; ++stream)
    {
      const bool same = entry.layer < byLayer.size() &&
        streamsOf(entry.layer).fillsAs(byLayer[entry.layer], static_cast<GpuStream>(stream));
      entry.filled[stream] = same ? entry.filled[stream] : 0;
    }
  }
  wanted_ = {};
  for (const LayerStreams& layer : streams_)
  {
    wanted_.add(layer.streams());
  }
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

void GpuPool::beginFrame(const Limits& limits)
{
  ++frame_;
  const bool less = limits.bytes > 0 && (limits_.bytes == 0 || limits.bytes < limits_.bytes);
  lowered_ = less && account_->bytes() > limits.bytes;
  limits_ = limits;
  limits_.views = std::max(1u, limits.views);
  const std::uint64_t slots = std::min<std::uint64_t>(gpuSlotsOf(limits.points), 1u << 24);
  slotLimit_ = limits.points == 0 ? 0 : static_cast<std::uint32_t>(slots + slots / cacheShare + 1);
  account_->draw(*this, lowered_);
}

void GpuPool::leaveScreen()
{
  frame_ += limits_.views;
}

bool GpuPool::makeRoom(const DrawList& draw)
{
  if (lowered_)
  {
    leaveScreen(); // of other views, too: they bring theirs again
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

/// What this frame draws is on the screen.
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

/// What it has goes to free slots of the others, of which there are enough.
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

std::size_t GpuPool::blockOf(std::uint32_t slot) const
{
  const auto after = std::upper_bound(blocks_.begin(), blocks_.end(), slot,
    [](std::uint32_t wanted, const GpuBlock& block) { return wanted < block.first(); });
  return static_cast<std::size_t>(after - blocks_.begin()) - 1;
}

const GpuPool::Entry* GpuPool::find(NodeIndex node) const
{
  const auto found = entries_.find(node);
  return found == entries_.end() || found->second.points == 0 ? nullptr : &found->second;
}

const GpuPool::Entry* GpuPool::bring(
  const NodeColumns& node, std::uint32_t count, const FramePlan& plan, std::int64_t& bytesLeft)
{
  Entry& entry = entries_[node.node];
  entry.frame = frame_;
  entry.layer = node.layer;
  const auto wanted = std::min(count, static_cast<std::uint32_t>(node.size()));
  entry.wanted = std::max(entry.wanted, wanted);
  if (entry.points < wanted && bytesLeft > 0)
  {
    const auto affordable = static_cast<std::uint32_t>(
      std::min<std::int64_t>(bytesLeft / GpuSlotBytes::position + 1, wanted));
    uploadPositions(node, entry, std::min(wanted, entry.points + affordable));
    bytesLeft -= static_cast<std::int64_t>(affordable) * GpuSlotBytes::position;
  }
  const LayerStreams& layer = streamsOf(node.layer);
  const std::uint32_t end = std::min(wanted, entry.points);
  for (std::size_t number = 0; number < gpuStreamCount; ++number)
  {
    const auto stream = static_cast<GpuStream>(number);
    if (layer.has(stream) && entry.filled[number] < end && bytesLeft > 0 &&
      layer.coveredBy(node, stream))
    {
      bytesLeft -= static_cast<std::int64_t>(end - entry.filled[number]) * GpuSlotBytes::value;
      uploadStream(stream, node, plan, entry, end);
    }
  }
  return entry.points == 0 ? nullptr : &entry;
}

void GpuPool::addRuns(
  const Entry& entry, std::uint32_t first, std::uint32_t end, DrawRuns& runs) const
{
  forSlots(entry.slots, first, end,
    [&](std::uint32_t slot, std::uint32_t offset, std::uint32_t, std::uint32_t points)
    {
      const std::size_t block = blockOf(slot);
      const std::uint32_t inBlock = slot - blocks_[block].first();
      runs.add(block, static_cast<int>(inBlock * slotPoints + offset), static_cast<int>(points));
    });
}

bool GpuPool::isFilled(const Entry& entry, std::uint32_t count) const
{
  const LayerStreams& layer = streamsOf(entry.layer);
  bool all = entry.points >= count;
  for (std::size_t stream = 0; stream < gpuStreamCount; ++stream)
  {
    all = all && (!layer.has(static_cast<GpuStream>(stream)) || entry.filled[stream] >= count);
  }
  return all;
}

void GpuPool::uploadPositions(const NodeColumns& node, Entry& entry, std::uint32_t end)
{
  while (entry.slots.size() * slotPoints < end && !free_.empty())
  {
    entry.slots.push_back(free_.back());
    free_.pop_back();
  }
  end = std::min(end, static_cast<std::uint32_t>(entry.slots.size() * slotPoints));
  forSlots(entry.slots, entry.points, end,
    [&](std::uint32_t slot, std::uint32_t offset, std::uint32_t first, std::uint32_t points)
    {
      blocks_[blockOf(slot)].writePositions(slot, offset, points, node.positions.data() + first);
      uploaded_ += static_cast<std::uint64_t>(points * GpuSlotBytes::position);
    });
  entry.points = std::max(entry.points, end);
}

void GpuPool::uploadStream(
  GpuStream stream, const NodeColumns& node, const FramePlan& plan, Entry& entry, std::uint32_t end)
{
  std::uint32_t& filled = entry.filled[static_cast<std::size_t>(stream)];
  staging_.clear();
  streamsOf(node.layer).encode(stream, plan, node, filled, end - filled, staging_);
  forSlots(entry.slots, filled, end,
    [&](std::uint32_t slot, std::uint32_t offset, std::uint32_t first, std::uint32_t points)
    {
      blocks_[blockOf(slot)].writeValues(
        stream, slot, offset, points, staging_.data() + (first - filled));
      uploaded_ += static_cast<std::uint64_t>(points * GpuSlotBytes::value);
    });
  filled = end;
}

void GpuPool::release()
{
  for (GpuBlock& block : blocks_)
  {
    charge(-block.bytes());
    block.release();
  }
  blocks_.clear();
  entries_.clear();
  idle_.clear();
  free_.clear();
}

} // namespace pointfront
