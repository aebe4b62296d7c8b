#include "GpuBlock.h"

#include "OpenGLFunctions.h"

namespace pointfront
{
namespace
{

/// 0 where the GPU has no room for it.
std::uint32_t makeBuffer(std::int64_t bytes)
{
  GLuint buffer = 0;
  glGenBuffers(1, &buffer);
  glBindBuffer(GL_COPY_WRITE_BUFFER, buffer);
  glBufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr, GL_DYNAMIC_DRAW);
  GLint64 there = 0;
  glGetBufferParameteri64v(GL_COPY_WRITE_BUFFER, GL_BUFFER_SIZE, &there);
  glBindBuffer(GL_COPY_WRITE_BUFFER, 0);
  if (there != bytes)
  {
    glGetError(); // GL_OUT_OF_MEMORY is ours; the next who asks must not take it for theirs
    glDeleteBuffers(1, &buffer);
    return 0;
  }
  return buffer;
}

void deleteBuffer(std::uint32_t& buffer)
{
  if (buffer != 0)
  {
    glDeleteBuffers(1, &buffer);
    buffer = 0;
  }
}

void write(std::uint32_t buffer, std::int64_t at, std::int64_t bytes, const void* data)
{
  glBindBuffer(GL_COPY_WRITE_BUFFER, buffer);
  glBufferSubData(
    GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(at), static_cast<GLsizeiptr>(bytes), data);
  glBindBuffer(GL_COPY_WRITE_BUFFER, 0);
}

void copySlot(std::uint32_t from, std::int64_t fromSlot, std::uint32_t to, std::int64_t toSlot,
  std::int64_t pointBytes)
{
  const std::int64_t bytes = gpuSlotPoints * pointBytes;
  glBindBuffer(GL_COPY_READ_BUFFER, from);
  glBindBuffer(GL_COPY_WRITE_BUFFER, to);
  glCopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER,
    static_cast<GLintptr>(fromSlot * bytes), static_cast<GLintptr>(toSlot * bytes),
    static_cast<GLsizeiptr>(bytes));
  glBindBuffer(GL_COPY_READ_BUFFER, 0);
  glBindBuffer(GL_COPY_WRITE_BUFFER, 0);
}

} // namespace

GpuBlock::GpuBlock(std::uint32_t first, std::uint32_t slots, const GpuStreams& streams)
  : first_(first)
  , slots_(slots)
  , positions_(makeBuffer(std::int64_t(slots) * gpuSlotPoints * GpuSlotBytes::position))
{
  // Drivers that reserve addresses only may grant a stream where they refused the positions.
  if (positions_ != 0)
  {
    setStreams(streams);
  }
}

void GpuBlock::release()
{
  deleteBuffer(positions_);
  setStreams({});
}

std::int64_t GpuBlock::bytes() const
{
  return slots_ * GpuSlotBytes::of(unwanted({}));
}

int GpuBlock::missing(const GpuStreams& wanted) const
{
  int count = 0;
  for (std::size_t stream = 0; stream < gpuStreamCount; ++stream)
  {
    count += wanted.wanted[stream] && streams_[stream] == 0;
  }
  return count;
}

int GpuBlock::unwanted(const GpuStreams& wanted) const
{
  int count = 0;
  for (std::size_t stream = 0; stream < gpuStreamCount; ++stream)
  {
    count += !wanted.wanted[stream] && streams_[stream] != 0;
  }
  return count;
}

void GpuBlock::setStreams(const GpuStreams& wanted)
{
  for (std::size_t stream = 0; stream < gpuStreamCount; ++stream)
  {
    if (!wanted.wanted[stream])
    {
      deleteBuffer(streams_[stream]);
    }
    else if (streams_[stream] == 0)
    {
      streams_[stream] = makeBuffer(std::int64_t(slots_) * gpuSlotPoints * GpuSlotBytes::value);
    }
  }
}

void GpuBlock::writePositions(
  std::uint32_t slot, std::uint32_t offset, std::uint32_t count, const void* steps) const
{
  const std::int64_t point = std::int64_t(slot - first_) * gpuSlotPoints + offset;
  write(positions_, point * GpuSlotBytes::position, count * GpuSlotBytes::position, steps);
}

void GpuBlock::writeValues(GpuStream stream, std::uint32_t slot, std::uint32_t offset,
  std::uint32_t count, const void* values) const
{
  const std::int64_t point = std::int64_t(slot - first_) * gpuSlotPoints + offset;
  write(buffer(stream), point * GpuSlotBytes::value, count * GpuSlotBytes::value, values);
}

void GpuBlock::copy(const GpuBlock& other, std::uint32_t from, std::uint32_t to) const
{
  const std::uint32_t source = from - other.first_;
  copySlot(other.positions_, source, positions_, to - first_, GpuSlotBytes::position);
  for (std::size_t stream = 0; stream < gpuStreamCount; ++stream)
  {
    if (streams_[stream] != 0 && other.streams_[stream] != 0)
    {
      copySlot(other.streams_[stream], source, streams_[stream], to - first_, GpuSlotBytes::value);
    }
  }
}

} // namespace pointfront
