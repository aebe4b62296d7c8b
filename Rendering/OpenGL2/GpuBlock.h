#pragma once

#include "pointfront/Views/GpuSlotBytes.h"

#include <cstdint>

namespace pointfront
{

/// Some slots of a GpuPool in vertex buffers of their own: positions, and values where they are
/// wanted.
/// Units    a vertex is 12 bytes of position (three unsigned grid steps) and 4 bytes of value.
/// Threads  that of the GL context, which must be current.
class GpuBlock
{
public:
  GpuBlock(std::uint32_t first, std::uint32_t slots, bool values);
  /// Gives the buffers back; nothing else does.
  void release();

  std::uint32_t first() const { return first_; } ///< slot of the pool
  std::uint32_t slots() const { return slots_; }
  std::uint32_t end() const { return first_ + slots_; }
  std::uint32_t positionBuffer() const { return positions_; }
  std::uint32_t valueBuffer() const { return values_; } ///< 0: none
  std::int64_t bytes() const { return slots_ * GpuSlotBytes::of(values_ != 0); }

  void addValues();
  void dropValues();

  // Of `count` points from point `offset` on of a slot of the pool.
  void writePositions(
    std::uint32_t slot, std::uint32_t offset, std::uint32_t count, const void* steps) const;
  void writeValues(
    std::uint32_t slot, std::uint32_t offset, std::uint32_t count, const void* values) const;
  /// All of slot `from` of another block into slot `to` of this.
  void copy(const GpuBlock& other, std::uint32_t from, std::uint32_t to) const;

private:
  std::uint32_t first_;
  std::uint32_t slots_;
  std::uint32_t positions_ = 0; ///< GL buffers
  std::uint32_t values_ = 0;
};

} // namespace pointfront
