#include "GpuPool.h"

#include <vtk_glew.h>

#include <algorithm>
#include <cstddef>

namespace pointfront
{
namespace
{

constexpr std::int64_t positionBytes = sizeof(glm::u32vec3);
constexpr std::int64_t valueBytes = sizeof(std::uint32_t);
constexpr std::uint32_t firstSlots = 8; // 32 K points, 512 KiB: a scene may have many pools
/// Slots kept beyond what may be drawn, so that turning back and forth uploads nothing: a quarter.
constexpr std::uint32_t cacheShare = 4;

/// gl_VertexID is a signed 32-bit integer.
constexpr std::uint32_t mostSlots = 0x7fffffffu / GpuPool::slotPoints;

std::uint32_t makeBuffer(std::int64_t bytes)
{
  GLuint buffer = 0;
  glGenBuffers(1, &buffer);
  glBindBuffer(GL_COPY_WRITE_BUFFER, buffer);
  glBufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr, GL_DYNAMIC_DRAW);
  glBindBuffer(GL_COPY_WRITE_BUFFER, 0);
  return buffer;
}

/// A larger buffer with the same beginning in place of `buffer`.
void enlarge(std::uint32_t& buffer, std::int64_t from, std::int64_t to)
{
  const std::uint32_t larger = makeBuffer(to);
  glBindBuffer(GL_COPY_READ_BUFFER, buffer);
  glBindBuffer(GL_COPY_WRITE_BUFFER, larger);
  glCopyBufferSubData(
    GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, 0, 0, static_cast<GLsizeiptr>(from));
  glBindBuffer(GL_COPY_READ_BUFFER, 0);
  glBindBuffer(GL_COPY_WRITE_BUFFER, 0);
  glDeleteBuffers(1, &buffer);
  buffer = larger;
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

void GpuPool::setColouring(const PointColouring& colouring)
{
  if (colouring == colouring_)
  {
    return;
  }
  colouring_ = colouring;
  for (auto& [node, entry] : entries_)
  {
    entry.values = 0;
  }
}

void GpuPool::beginFrame(std::uint64_t mostPoints, std::uint32_t views)
{
  ++frame_;
  views_ = std::max(1u, views);
  const auto slots = static_cast<std::uint32_t>(
    std::min<std::uint64_t>((mostPoints + slotPoints - 1) / slotPoints, 1u << 24));
  slotLimit_ = mostPoints == 0 ? 0 : slots + slots / cacheShare + 1;
  if (slotLimit_ != 0 && slotCount_ / 2 > std::max(slotLimit_, firstSlots))
  {
    shrink();
  }
}

const GpuPool::Entry* GpuPool::find(NodeIndex node) const
{
  const auto found = entries_.find(node);
  return found == entries_.end() || found->second.points == 0 ? nullptr : &found->second;
}

const GpuPool::Entry* GpuPool::bring(
  const NodeColumns& node, std::uint32_t count, const Attribute* attribute, std::int64_t& bytesLeft)
{
  Entry& entry = entries_[node.node];
  entry.frame = frame_;
  const auto wanted = std::min(count, static_cast<std::uint32_t>(node.size()));
  if (entry.points < wanted && bytesLeft > 0)
  {
    const auto affordable =
      static_cast<std::uint32_t>(std::min<std::int64_t>(bytesLeft / positionBytes + 1, wanted));
    uploadPositions(node, entry, std::min(wanted, entry.points + affordable));
    bytesLeft -= static_cast<std::int64_t>(affordable) * positionBytes;
  }
  if (attribute && entry.values < std::min(wanted, entry.points) && bytesLeft > 0 &&
      colouring_.coveredBy(node))
  {
    const std::uint32_t end = std::min(wanted, entry.points);
    bytesLeft -= static_cast<std::int64_t>(end - entry.values) * valueBytes;
    uploadValues(node, *attribute, entry, end);
  }
  return entry.points == 0 ? nullptr : &entry;
}

void GpuPool::uploadPositions(const NodeColumns& node, Entry& entry, std::uint32_t end)
{
  while (entry.slots.size() * slotPoints < end)
  {
    std::uint32_t slot = 0;
    if (!takeSlot(slot))
    {
      end = std::min(end, static_cast<std::uint32_t>(entry.slots.size() * slotPoints));
      break;
    }
    entry.slots.push_back(slot);
  }
  glBindBuffer(GL_COPY_WRITE_BUFFER, positions_);
  forSlots(entry.slots, entry.points, end,
    [&](std::uint32_t slot, std::uint32_t offset, std::uint32_t first, std::uint32_t points)
    {
      const auto at = (static_cast<std::int64_t>(slot) * slotPoints + offset) * positionBytes;
      glBufferSubData(GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(at),
        static_cast<GLsizeiptr>(points * positionBytes), node.positions.data() + first);
      uploaded_ += static_cast<std::uint64_t>(points * positionBytes);
    });
  glBindBuffer(GL_COPY_WRITE_BUFFER, 0);
  entry.points = std::max(entry.points, end);
}

void GpuPool::uploadValues(
  const NodeColumns& node, const Attribute& attribute, Entry& entry, std::uint32_t end)
{
  allocateValues();
  staging_.clear();
  colouring_.encode(node, attribute, entry.values, end - entry.values, staging_);
  glBindBuffer(GL_COPY_WRITE_BUFFER, values_);
  forSlots(entry.slots, entry.values, end,
    [&](std::uint32_t slot, std::uint32_t offset, std::uint32_t first, std::uint32_t points)
    {
      const auto at = (static_cast<std::int64_t>(slot) * slotPoints + offset) * valueBytes;
      glBufferSubData(GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(at),
        static_cast<GLsizeiptr>(points * valueBytes), staging_.data() + (first - entry.values));
      uploaded_ += static_cast<std::uint64_t>(points * valueBytes);
    });
  glBindBuffer(GL_COPY_WRITE_BUFFER, 0);
  entry.values = end;
}

bool GpuPool::takeSlot(std::uint32_t& slot)
{
  if (free_.empty())
  {
    // Below the limit: more memory. At the limit: what is not drawn gives way; if all is drawn,
    // more.
    if ((slotLimit_ != 0 && slotCount_ < slotLimit_) || !evictOne())
    {
      grow();
    }
  }
  if (free_.empty())
  {
    return false;
  }
  slot = free_.back();
  free_.pop_back();
  return true;
}

bool GpuPool::evictOne()
{
  auto oldest = entries_.end();
  for (auto entry = entries_.begin(); entry != entries_.end(); ++entry)
  {
    if (entry->second.frame + views_ <= frame_ && !entry->second.slots.empty() &&
        (oldest == entries_.end() || entry->second.frame < oldest->second.frame))
    {
      oldest = entry;
    }
  }
  if (oldest == entries_.end())
  {
    return false;
  }
  free_.insert(free_.end(), oldest->second.slots.begin(), oldest->second.slots.end());
  entries_.erase(oldest);
  return true;
}

/// Into smaller buffers, as far as what is on the screen allows.
void GpuPool::shrink()
{
  const auto used = [this] { return slotCount_ - static_cast<std::uint32_t>(free_.size()); };
  while (used() > slotLimit_ && evictOne())
  {
  }
  const std::uint32_t slots = std::max({slotLimit_, firstSlots, used()});
  if (slotCount_ / 2 <= slots)
  {
    return;
  }
  const auto moved = [&](std::uint32_t& buffer, std::int64_t bytes)
  {
    const std::int64_t slotBytes = bytes * slotPoints;
    const std::uint32_t smaller = makeBuffer(slots * slotBytes);
    glBindBuffer(GL_COPY_READ_BUFFER, buffer);
    glBindBuffer(GL_COPY_WRITE_BUFFER, smaller);
    std::int64_t to = 0;
    for (const auto& [node, entry] : entries_)
    {
      for (const std::uint32_t slot : entry.slots)
      {
        glCopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER,
          static_cast<GLintptr>(slot * slotBytes), static_cast<GLintptr>(to * slotBytes),
          static_cast<GLsizeiptr>(slotBytes));
        ++to;
      }
    }
    glBindBuffer(GL_COPY_READ_BUFFER, 0);
    glBindBuffer(GL_COPY_WRITE_BUFFER, 0);
    glDeleteBuffers(1, &buffer);
    buffer = smaller;
  };
  moved(positions_, positionBytes);
  if (values_ != 0)
  {
    moved(values_, valueBytes);
  }
  std::uint32_t next = 0; // in the same order
  for (auto& [node, entry] : entries_)
  {
    for (std::uint32_t& slot : entry.slots)
    {
      slot = next++;
    }
  }
  free_.clear();
  for (std::uint32_t slot = slots; slot-- > next;)
  {
    free_.push_back(slot);
  }
  slotCount_ = slots;
}

void GpuPool::makeRoom(std::uint64_t slots, bool copying)
{
  if (slots <= slotCount_)
  {
    return;
  }
  const std::uint64_t next = slotCount_ == 0
    ? firstSlots
    : std::min<std::uint64_t>(slotLimit_, slotCount_ + slotCount_ / 2);
  const auto wanted =
    static_cast<std::uint32_t>(std::min<std::uint64_t>(std::max(slots, next), mostSlots));
  if (!copying && views_ == 1)
  {
    release();
  }
  growTo(wanted);
}

void GpuPool::grow()
{
  std::uint32_t slots = slotCount_ == 0 ? firstSlots : slotCount_ + slotCount_ / 2;
  if (slotLimit_ != 0 && slotCount_ < slotLimit_)
  {
    slots = std::min(slots, slotLimit_);
  }
  growTo(std::min(slots, mostSlots));
}

void GpuPool::growTo(std::uint32_t slots)
{
  if (slots <= slotCount_)
  {
    return;
  }
  const std::int64_t before = static_cast<std::int64_t>(slotCount_) * slotPoints;
  const std::int64_t after = static_cast<std::int64_t>(slots) * slotPoints;
  if (positions_ == 0)
  {
    positions_ = makeBuffer(after * positionBytes);
  }
  else
  {
    enlarge(positions_, before * positionBytes, after * positionBytes);
  }
  if (values_ != 0)
  {
    enlarge(values_, before * valueBytes, after * valueBytes);
  }
  for (std::uint32_t slot = slots; slot-- > slotCount_;)
  {
    free_.push_back(slot); // the lowest is taken first
  }
  slotCount_ = slots;
}

void GpuPool::allocateValues()
{
  if (values_ == 0)
  {
    values_ = makeBuffer(static_cast<std::int64_t>(slotCount_) * slotPoints * valueBytes);
  }
}

std::int64_t GpuPool::bytes() const
{
  const std::int64_t points = static_cast<std::int64_t>(slotCount_) * slotPoints;
  return (positions_ != 0 ? points * positionBytes : 0) + (values_ != 0 ? points * valueBytes : 0);
}

void GpuPool::release()
{
  if (positions_ != 0)
  {
    glDeleteBuffers(1, &positions_);
  }
  if (values_ != 0)
  {
    glDeleteBuffers(1, &values_);
  }
  positions_ = values_ = slotCount_ = 0;
  entries_.clear();
  free_.clear();
}

} // namespace pointfront
