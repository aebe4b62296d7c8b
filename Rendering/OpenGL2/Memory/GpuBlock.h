#pragma once

#include "pointfront/Style/GpuStreams.h"
#include "pointfront/Views/GpuSlotBytes.h"

#include <array>
#include <cstdint>

namespace pointfront
{

/// Some slots of a GpuPool in vertex buffers of their own: positions, and those streams that are
/// wanted.
/// Units    a vertex is 12 bytes of position (three unsigned grid steps) and 4 bytes a stream.
/// Threads  that of the GL context, which must be current.
class GpuBlock
{
public:
  GpuBlock(std::uint32_t first, std::uint32_t slots, const GpuStreams& streams);
  /// Gives the buffers back; no other function does.
  void release();

  std::uint32_t first() const { return first_; } ///< slot of the pool
  std::uint32_t slots() const { return slots_; }
  std::uint32_t end() const { return first_ + slots_; }
  std::uint32_t positionBuffer() const { return positions_; }
  /// 0: none
  std::uint32_t buffer(GpuStream stream) const
  {
    return streams_[static_cast<std::size_t>(stream)];
  }
  std::int64_t bytes() const;

  /// Streams that are wanted and not there; those that are there and not wanted.
  int missing(const GpuStreams& wanted) const;
  int unwanted(const GpuStreams& wanted) const;
  /// The GPU had room for its positions and for all wanted streams.
  bool whole(const GpuStreams& wanted) const { return positions_ != 0 && missing(wanted) == 0; }
  /// Makes missing buffers, as far as the GPU has room, and gives unwanted ones back.
  void setStreams(const GpuStreams& wanted);

  // Writes `count` points from point `offset` on of a slot of the pool.
  void writePositions(
    std::uint32_t slot, std::uint32_t offset, std::uint32_t count, const void* steps) const;
  void writeValues(GpuStream stream, std::uint32_t slot, std::uint32_t offset, std::uint32_t count,
    const void* values) const;
  /// Copies slot `from` of another block into slot `to` of this block.
  void copy(const GpuBlock& other, std::uint32_t from, std::uint32_t to) const;

private:
  std::uint32_t first_;
  std::uint32_t slots_;
  std::uint32_t positions_ = 0; ///< GL buffers
  std::array<std::uint32_t, gpuStreamCount> streams_{};
};

} // namespace pointfront
