#include "pointfront/Residency/FarLanes.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace pointfront
{

FarLanes::Ticket FarLanes::enter(
  const void* store, std::uint64_t server, std::shared_ptr<ReadStop> stop)
{
  batches_.push_back({ next_, store, server, std::move(stop) });
  return next_++;
}

void FarLanes::leave(Ticket ticket)
{
  const auto batch = std::find_if(
    batches_.begin(), batches_.end(), [ticket](const Batch& b) { return b.ticket == ticket; });
  assert(batch != batches_.end());
  batches_.erase(batch);
}

bool FarLanes::open(std::uint64_t server, const ReadCost& cost) const
{
  const std::size_t depth = std::clamp<std::size_t>(cost.readsAtOnce, 1, mostOnALane);
  const auto under = std::count_if(batches_.begin(), batches_.end(),
    [server](const Batch& batch) { return batch.server == server; });
  return batches_.size() < mostOnAll && static_cast<std::size_t>(under) < depth;
}

std::size_t FarLanes::count(const void* store) const
{
  return static_cast<std::size_t>(std::count_if(batches_.begin(), batches_.end(),
    [store](const Batch& batch) { return batch.store == store; }));
}

void FarLanes::stop(const void* store) const
{
  for (const Batch& batch : batches_)
  {
    if (batch.store == store)
    {
      *batch.stop = true;
    }
  }
}

void FarLanes::stopAll() const
{
  for (const Batch& batch : batches_)
  {
    *batch.stop = true;
  }
}

} // namespace pointfront
