#include "GpuPool.h"

#include "GpuAccount.h"

#include <algorithm>
#include <cstddef>

namespace pointfront
{
namespace
{

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
