#include "GpuBlock.h"

#include <vtk_glew.h>

namespace pointfront
{
namespace
{

std::uint32_t makeBuffer(std::int64_t bytes)
{
  GLuint buffer = 0;
  glGenBuffers(1, &buffer);
  glBindBuffer(GL_COPY_WRITE_BUFFER, buffer);
  glBufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr, GL_DYNAMIC_DRAW);
  glBindBuffer(GL_COPY_WRITE_BUFFER, 0);
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
  glBufferSubData(GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(at),
    static_cast<GLsizeiptr>(bytes), data);
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

GpuBlock::GpuBlock(std::uint32_t first, std::uint32_t slots, bool values)
    : first_(first), slots_(slots),
      positions_(makeBuffer(std::int64_t(slots) * gpuSlotPoints * GpuSlotBytes::position))
{
  if (values)
  {
    addValues();
  }
}

void GpuBlock::release()
{
  deleteBuffer(positions_);
  deleteBuffer(values_);
}

void GpuBlock::addValues()
{
  values_ = makeBuffer(std::int64_t(slots_) * gpuSlotPoints * GpuSlotBytes::value);
}

void GpuBlock::dropValues() { deleteBuffer(values_); }

void GpuBlock::writePositions(
  std::uint32_t slot, std::uint32_t offset, std::uint32_t count, const void* steps) const
{
  const std::int64_t point = std::int64_t(slot - first_) * gpuSlotPoints + offset;
  write(positions_, point * GpuSlotBytes::position, count * GpuSlotBytes::position, steps);
}

void GpuBlock::writeValues(
  std::uint32_t slot, std::uint32_t offset, std::uint32_t count, const void* values) const
{
  const std::int64_t point = std::int64_t(slot - first_) * gpuSlotPoints + offset;
  write(values_, point * GpuSlotBytes::value, count * GpuSlotBytes::value, values);
}

void GpuBlock::copy(const GpuBlock& other, std::uint32_t from, std::uint32_t to) const
{
  copySlot(other.positions_, from - other.first_, positions_, to - first_, GpuSlotBytes::position);
  if (values_ != 0 && other.values_ != 0)
  {
    copySlot(other.values_, from - other.first_, values_, to - first_, GpuSlotBytes::value);
  }
}

} // namespace pointfront
