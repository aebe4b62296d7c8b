#include "pointfront/Residency/ReleasePlan.h"

#include <algorithm>
#include <tuple>

namespace pointfront
{

void ReleasePlan::count(
  std::uint32_t store, NodeIndex node, std::size_t bytes, std::uint32_t levels)
{
  if (levels > 0)
  {
    const std::uint32_t counted = std::min(levels, farthestCounted);
    bytesAt_[counted] += bytes;
    candidates_.push_back({ counted, store, node, bytes });
  }
}

std::vector<ReleasePlan::Candidate> ReleasePlan::farthest(std::size_t bytes)
{
  std::uint32_t last = farthestCounted;
  std::size_t beyond = 0;
  while (last > 1 && beyond + bytesAt_[last] < bytes)
  {
    beyond += bytesAt_[last--];
  }
  std::vector<Candidate> chosen;
  for (const Candidate& candidate : candidates_)
  {
    if (candidate.levels >= last)
    {
      chosen.push_back(candidate);
    }
  }
  std::sort(chosen.begin(), chosen.end(),
    [](const Candidate& a, const Candidate& b)
    { return std::tie(b.levels, a.store, b.node) < std::tie(a.levels, b.store, a.node); });
  std::size_t sum = 0;
  std::size_t taken = 0;
  while (taken < chosen.size() && sum < bytes)
  {
    sum += chosen[taken++].bytes;
  }
  chosen.resize(taken);
  return chosen;
}

} // namespace pointfront
