#include "pointfront/Residency/StoreNodes.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

namespace pointfront
{

void StoreNodes::beginBatch(std::size_t bytes, std::size_t most,
  const std::shared_ptr<ReadStop>& stop, std::vector<Task>& tasks)
{
  Batch batch{ {}, stop };
  batch.nodes.reserve(most);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    batches_.reserve(batches_.size() + 1);
  }
  std::optional<Task> task = begin();
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<LoadRequest> near;
  auto nearest = near.cbegin();
  std::size_t sum = 0;
  bool rereads = false;
  while (task)
  {
    if (batch.nodes.empty() && task->node != noNode && !task->reread)
    {
      near = waiting_.near(task->node, bytes);
      nearest = near.cbegin();
    }
    sum += task->bytes;
    rereads = rereads || task->reread;
    batch.nodes.push_back(task->node);
    const bool rows = task->node == noNode;
    tasks.push_back(std::move(*task));
    task.reset();
    if (rows)
    {
      return;
    }
    if (sum >= bytes || tasks.size() >= most)
    {
      break;
    }
    if (nearest != near.cend())
    {
      task = beginNode({ *nearest++, 1, false, false });
      continue;
    }
    const auto choice = choose();
    // A node that gives up old points for it is read by itself.
    task = choice && !choice->inPlaceOfOld ? beginNode(*choice) : std::nullopt;
  }
  if (!rereads && !batch.nodes.empty()) // those nodes are in memory, and so in no list of requests
  {
    batches_.push_back(std::move(batch));
  }
}

/// Under the lock. FRONT-9, for what is under way.
void StoreNodes::stopUnwanted(const std::vector<LoadRequest>& requests)
{
  batches_.erase(std::remove_if(batches_.begin(), batches_.end(),
                   [](const Batch& batch) { return batch.stop.expired(); }),
    batches_.end());
  if (batches_.empty())
  {
    return;
  }
  std::unordered_set<NodeIndex> wanted;
  for (const LoadRequest& request : requests)
  {
    wanted.insert(request.node);
  }
  for (const Batch& batch : batches_)
  {
    const std::shared_ptr<ReadStop> stop = batch.stop.lock();
    if (stop &&
      std::none_of(batch.nodes.begin(), batch.nodes.end(),
        [&wanted](NodeIndex node) { return wanted.count(node) > 0; }))
    {
      *stop = true;
    }
  }
}

/// Under the lock.
void StoreNodes::forgetCancelled(const Task& task)
{
  budget_->giveBack(task.bytes);
  ++cancelled_;
  ++arrivals_; // who wants it again asks again
  ++revision_;
  CachedNode& cached = cache_[task.node];
  if (!cached.points)
  {
    cache_.forget(task.node);
    return;
  }
  cached.stale = true;
  waiting_.readAgain(again(task.node, *cached.points, 0.0));
}

} // namespace pointfront
