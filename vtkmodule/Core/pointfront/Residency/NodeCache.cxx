#include "pointfront/Residency/NodeCache.h"

namespace pointfront
{
const CachedNode* NodeCache::find(NodeIndex node) const
{
  const auto found = nodes_.find(node);
  return found != nodes_.end() ? &found->second : nullptr;
}

CachedNode* NodeCache::find(NodeIndex node)
{
  const auto found = nodes_.find(node);
  return found != nodes_.end() ? &found->second : nullptr;
}

void NodeCache::insert(NodeIndex node, NodeColumns points, std::size_t bytes)
{
  remove(node);
  CachedNode& cached = nodes_[node];
  const auto leaveAccount = [budget = budget_, bytes](const NodeColumns* gone)
  {
    delete gone;
    budget->giveBack(bytes);
  };
  cached.points =
    std::shared_ptr<const NodeColumns>(new NodeColumns(std::move(points)), leaveAccount);
  cached.bytes = bytes;
  bytes_ += bytes;
  ++count_;
}

std::shared_ptr<const NodeColumns> NodeCache::remove(NodeIndex node)
{
  CachedNode* cached = find(node);
  if (cached == nullptr || cached->points == nullptr)
  {
    return nullptr;
  }
  bytes_ -= cached->bytes;
  --count_;
  cached->bytes = 0;
  return std::move(cached->points);
}

} // namespace pointfront
