#pragma once

#include "pointfront/Disk/ByteSource.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace pointfront
{

/// The lanes of far sources, one for each server. Several batches of reads are under way on a lane
/// at a time: as many as its source takes. No lane holds up another, nor the disks' (DiskLane).
/// Bounds    8 batches on a lane and 32 on all lanes together, since each holds a thread.
/// Threads   none of its own: the owner locks.
class FarLanes
{
public:
  using Clock = std::chrono::steady_clock;
  using Ticket = std::uint64_t;

  static constexpr std::size_t mostOnALane = 8;
  static constexpr std::size_t mostOnAll = 32;

  /// `store`: any pointer that identifies the store. `stop` is kept until the batch leaves.
  Ticket enter(const void* store, std::uint64_t server, std::shared_ptr<ReadStop> stop);
  void leave(Ticket ticket);

  /// Whether another batch may begin on the server's lane.
  bool open(std::uint64_t server, const ReadCost& cost) const;
  std::size_t count() const { return batches_.size(); }
  std::size_t count(const void* store) const;
  /// Tells all batches of a store, or all that there are, that nobody wants them any more.
  void stop(const void* store) const;
  void stopAll() const;

private:
  struct Batch
  {
    Ticket ticket;
    const void* store;
    std::uint64_t server;
    std::shared_ptr<ReadStop> stop;
  };

  std::vector<Batch> batches_;
  Ticket next_ = 0;
};

} // namespace pointfront
