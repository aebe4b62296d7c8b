#include "GpuPool.h"

#include "GpuAccount.h"

#include <algorithm>
#include <cstddef>

namespace pointfront
{
namespace
{

constexpr std::uint32_t fewestSlots = 8; ///< nothing is given back below it: 32 K points
/// Slots kept beyond what may be drawn, so that turning back and forth uploads nothing: a quarter.
constexpr std::uint32_t cacheShare = 4;

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
  memory_.leave();
  if (memory_.account())
  {
    memory_.account()->leave(*this);
  }
}

void GpuPool::enter(std::shared_ptr<GpuAccount> account)
{
  if (memory_.account() == account)
  {
    return;
  }
  if (memory_.account())
  {
    memory_.account()->leave(*this);
  }
  memory_.enter(std::move(account));
  memory_.account()->join(*this);
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
  GpuStreams wanted;
  for (const LayerStreams& layer : streams_)
  {
    wanted.add(layer.streams());
  }
  memory_.setStreams(wanted);
}

void GpuPool::beginFrame(const Limits& limits)
{
  ++frame_;
  const bool less = limits.bytes > 0 && (limits_.bytes == 0 || limits.bytes < limits_.bytes);
  lowered_ = less && memory_.windowBytes() > limits.bytes;
  limits_ = limits;
  memory_.setLimit(limits.bytes);
  limits_.views = std::max(1u, limits.views);
  const std::uint64_t slots = std::min<std::uint64_t>(gpuSlotsOf(limits.points), 1u << 24);
  slotLimit_ = limits.points == 0 ? 0 : static_cast<std::uint32_t>(slots + slots / cacheShare + 1);
  memory_.account()->draw(*this, lowered_);
}

void GpuPool::leaveScreen()
{
  frame_ += limits_.views;
}

const GpuPool::Entry* GpuPool::find(NodeIndex node) const
{
  const auto found = entries_.find(node);
  return found == entries_.end() || found->second.points == 0 ? nullptr : &found->second;
}

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
  if (slotLimit_ != 0 && memory_.slotCount() / 2 > std::max(slotLimit_, fewestSlots))
  {
    while (memory_.blocks().back().first() >= std::max(slotLimit_, fewestSlots) && giveBack())
    {
    }
  }
  while (memory_.exceeds() && (giveBack() || (trim() && giveBack())))
  {
  }
  if (!memory_.exceeds())
  {
    return;
  }
  memory_.account()->reclaim(memory_.windowBytes() - limits_.bytes, *this);
  // The frame draws more than there may be: a front comes down by some moves a frame in motion.
  for (auto item = draw.rbegin(); item != draw.rend() && memory_.bytes() > limits_.bytes; ++item)
  {
    const auto farthest = entries_.find((*item)->node->node);
    if (farthest != entries_.end())
    {
      memory_.give(farthest->second.slots);
      entries_.erase(farthest);
    }
    while (memory_.exceeds() && giveBack())
    {
    }
  }
}

/// Where styles want streams and there are none; where they do not fit beside the others, all
/// begins anew.
void GpuPool::addStreams()
{
  const std::int64_t more = memory_.missingBytes();
  if (more > 0 && memory_.exceeds(more))
  {
    release();
  }
  if (!memory_.addStreams())
  {
    release(); // and what the frame draws comes again, as far as there is room
  }
}

/// Below the limit: more memory. At the limit: what is not drawn gives way; if all is drawn, more.
bool GpuPool::makeFree(std::uint64_t slots)
{
  while (memory_.freeCount() < slots)
  {
    const std::uint64_t missing = slots - memory_.freeCount();
    const bool below = slotLimit_ != 0 && memory_.slotCount() < slotLimit_;
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
      memory_.give(entry->second.slots);
      entries_.erase(entry);
      return true;
    }
  }
  return false;
}

/// Slots of points that are no longer drawn of nodes that are. False if there are none.
bool GpuPool::trim()
{
  const std::size_t before = memory_.freeCount();
  for (auto& [node, entry] : entries_)
  {
    const std::uint64_t wanted = gpuSlotsOf(entry.wanted);
    while (entry.slots.size() > wanted)
    {
      memory_.give(entry.slots.back());
      entry.slots.pop_back();
    }
    const auto most = static_cast<std::uint32_t>(entry.slots.size() * slotPoints);
    entry.points = std::min(entry.points, most);
    for (std::uint32_t& filled : entry.filled)
    {
      filled = std::min(filled, most);
    }
  }
  return memory_.freeCount() > before;
}

bool GpuPool::grow(std::uint64_t slots)
{
  return memory_.grow(
    slots, [this](std::int64_t bytes) { memory_.account()->reclaim(bytes, *this); });
}

bool GpuPool::giveBack()
{
  if (memory_.blocks().empty())
  {
    return false;
  }
  while (memory_.freeCount() < memory_.blocks().back().slots())
  {
    if (!evictOne())
    {
      return false;
    }
  }
  memory_.closeLast();
  for (auto& [node, entry] : entries_)
  {
    for (std::uint32_t& slot : entry.slots)
    {
      slot = memory_.isInLast(slot) ? memory_.moveOut(slot) : slot;
    }
  }
  memory_.dropLast();
  return true;
}

const GpuPool::Entry* GpuPool::bring(
  const NodeColumns& node, std::uint32_t count, const FramePlan& plan, std::int64_t& bytesLeft)
{
  Entry& entry = entries_[node.node];
  entry.frame = frame_;
  entry.layer = node.layer;
  const auto wanted = std::min(count, static_cast<std::uint32_t>(node.size()));
  entry.wanted = std::max(entry.wanted, wanted);
  // A point comes with all that it is drawn by: without, it would be drawn now and once more later.
  std::int64_t pointBytes = GpuSlotBytes::position;
  const LayerStreams& layer = streamsOf(node.layer);
  for (std::size_t number = 0; number < gpuStreamCount; ++number)
  {
    const auto stream = static_cast<GpuStream>(number);
    const bool comes = layer.has(stream) && layer.coveredBy(node, stream);
    pointBytes += comes ? GpuSlotBytes::value : 0;
  }
  if (entry.points < wanted && bytesLeft >= pointBytes)
  {
    const auto affordable = static_cast<std::uint32_t>(
      std::min<std::int64_t>(bytesLeft / pointBytes, wanted - entry.points));
    uploadPositions(node, entry, entry.points + affordable);
    bytesLeft -= static_cast<std::int64_t>(affordable) * GpuSlotBytes::position;
  }
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
      const std::size_t block = memory_.blockOf(slot);
      const std::uint32_t inBlock = slot - memory_.blocks()[block].first();
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
  while (entry.slots.size() * slotPoints < end && memory_.freeCount() > 0)
  {
    entry.slots.push_back(memory_.take());
  }
  end = std::min(end, static_cast<std::uint32_t>(entry.slots.size() * slotPoints));
  forSlots(entry.slots, entry.points, end,
    [&](std::uint32_t slot, std::uint32_t offset, std::uint32_t first, std::uint32_t points)
    {
      memory_.blockWith(slot).writePositions(slot, offset, points, node.positions.data() + first);
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
      memory_.blockWith(slot).writeValues(
        stream, slot, offset, points, staging_.data() + (first - filled));
      uploaded_ += static_cast<std::uint64_t>(points * GpuSlotBytes::value);
    });
  filled = end;
}

void GpuPool::release()
{
  memory_.release();
  entries_.clear();
  idle_.clear();
}

} // namespace pointfront
