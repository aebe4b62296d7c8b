#include "pointfront/Residency/NodeCache.h"

#include <algorithm>
#include <array>

namespace pointfront
{
namespace
{

/// More levels than any tree has: what nobody wants at all may come with any number.
constexpr std::uint32_t farthestCounted = 255;

} // namespace

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
  cached.points = std::shared_ptr<const NodeColumns>(
    new NodeColumns(std::move(points)), leaveAccount);
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

std::vector<NodeIndex> NodeCache::farthest(std::size_t bytes, const Distance& distance) const
{
  struct Candidate
  {
    std::uint32_t distance;
    NodeIndex node;
    std::size_t bytes;
  };
  std::array<std::size_t, farthestCounted + 1> bytesAt{};
  std::vector<Candidate> candidates;
  for (const auto& [node, cached] : nodes_)
  {
    if (cached.points != nullptr && !cached.loading)
    {
      const std::uint32_t levels = std::min(distance(node), farthestCounted);
      if (levels > 0)
      {
        bytesAt[levels] += cached.bytes;
        candidates.push_back({ levels, node, cached.bytes });
      }
    }
  }
  std::uint32_t last = farthestCounted;
  std::size_t beyond = 0;
  while (last > 1 && beyond + bytesAt[last] < bytes)
  {
    beyond += bytesAt[last--];
  }
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(),
                     [last](const Candidate& c) { return c.distance < last; }),
    candidates.end());
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b)
    { return a.distance != b.distance ? a.distance > b.distance : a.node > b.node; });
  std::vector<NodeIndex> chosen;
  std::size_t sum = 0;
  for (const Candidate& candidate : candidates)
  {
    if (sum >= bytes)
    {
      break;
    }
    sum += candidate.bytes;
    chosen.push_back(candidate.node);
  }
  return chosen;
}

} // namespace pointfront
