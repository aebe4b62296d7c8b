#include "pointfront/Residency/RequestQueue.h"

#include <algorithm>

namespace pointfront
{

bool RequestQueue::sooner(const LoadRequest& a, const LoadRequest& b) const
{
  if (a.optional != b.optional)
  {
    return b.optional;
  }
  if (a.priority != b.priority)
  {
    return a.priority > b.priority;
  }
  const std::uint64_t sinceA = since_.at(a.node);
  const std::uint64_t sinceB = since_.at(b.node);
  return sinceA != sinceB ? sinceA < sinceB : a.node < b.node;
}

RequestQueue::Change RequestQueue::replace(const std::vector<LoadRequest>& wanted)
{
  ++calls_;
  Change change;
  std::unordered_map<NodeIndex, std::uint64_t> since;
  since.reserve(wanted.size());
  requests_.clear();
  for (const LoadRequest& request : wanted)
  {
    const auto before = since_.find(request.node);
    const bool isNew = before == since_.end();
    if (since.emplace(request.node, isNew ? calls_ : before->second).second)
    {
      change.added += isNew;
      requests_.push_back(request);
    }
  }
  change.cancelled = static_cast<std::uint32_t>(since_.size() - (since.size() - change.added));
  since_ = std::move(since);
  std::sort(requests_.begin(), requests_.end(),
    [this](const LoadRequest& a, const LoadRequest& b) { return sooner(a, b); });
  return change;
}

bool RequestQueue::add(const LoadRequest& request)
{
  const bool isNew = since_.emplace(request.node, ++calls_).second;
  if (!isNew)
  {
    requests_.erase(std::find_if(requests_.begin(), requests_.end(),
      [&](const LoadRequest& r) { return r.node == request.node; }));
  }
  const auto place = std::lower_bound(requests_.begin(), requests_.end(), request,
    [this](const LoadRequest& a, const LoadRequest& b) { return sooner(a, b); });
  requests_.insert(place, request);
  return isNew;
}

bool RequestQueue::cancel(NodeIndex node)
{
  if (since_.erase(node) == 0)
  {
    return false;
  }
  requests_.erase(std::find_if(
    requests_.begin(), requests_.end(), [&](const LoadRequest& r) { return r.node == node; }));
  return true;
}

void RequestQueue::clear()
{
  requests_.clear();
  since_.clear();
}

} // namespace pointfront
