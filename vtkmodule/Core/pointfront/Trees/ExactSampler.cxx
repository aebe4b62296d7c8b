#include "pointfront/Trees/ExactSampler.h"

#include <algorithm>
#include <numeric>

namespace pointfront
{
namespace
{
/// A fixed, well mixed function (the finaliser of SplitMix64).
std::uint64_t mixed(std::uint64_t v)
{
  v = (v + 0x9e3779b97f4a7c15ull) * 0xbf58476d1ce4e5b9ull;
  v = (v ^ (v >> 27)) * 0x94d049bb133111ebull;
  return v ^ (v >> 31);
}

/// A place in each of `count` runs of equal length, which are all of `places`; ascending.
std::vector<std::size_t> spread(std::size_t places, std::uint64_t count)
{
  std::vector<std::size_t> spread(count);
  for (std::uint64_t i = 0; i < count; ++i)
  {
    const std::uint64_t begin = i * places / count;
    const std::uint64_t end = (i + 1) * places / count;
    spread[i] = begin + mixed(i) % (end - begin);
  }
  return spread;
}

/// Gives up `count` of them.
void thin(std::vector<std::uint32_t>& chosen, std::uint64_t count)
{
  std::vector<std::size_t> dropped = spread(chosen.size(), count);
  dropped.push_back(chosen.size());
  auto left = chosen.begin() + static_cast<std::ptrdiff_t>(dropped.front());
  for (std::size_t i = 0; i + 1 < dropped.size(); ++i)
  {
    left = std::copy(chosen.begin() + static_cast<std::ptrdiff_t>(dropped[i]) + 1,
      chosen.begin() + static_cast<std::ptrdiff_t>(dropped[i + 1]), left);
  }
  chosen.erase(left, chosen.end());
}

/// Adds `count` of the other ones of `points`.
void fill(std::vector<std::uint32_t>& chosen, std::size_t points, std::uint64_t count)
{
  std::vector<std::uint32_t> others;
  others.reserve(points - chosen.size());
  auto next = chosen.begin();
  for (std::uint32_t i = 0; i < points; ++i)
  {
    if (next != chosen.end() && *next == i)
    {
      ++next;
      continue;
    }
    others.push_back(i);
  }
  const auto middle = static_cast<std::ptrdiff_t>(chosen.size());
  for (const std::size_t place : spread(others.size(), count))
  {
    chosen.push_back(others[place]);
  }
  std::inplace_merge(chosen.begin(), chosen.begin() + middle, chosen.end());
}
} // namespace

void ExactSampler::choose(const RecordSpan& records, const std::vector<std::uint32_t>& points,
  const CellOccupancy& occupancy, std::uint64_t wanted, std::vector<std::uint32_t>& chosen)
{
  if (wanted == 0 || wanted >= points.size())
  {
    chosen.resize(wanted == 0 ? 0 : points.size());
    std::iota(chosen.begin(), chosen.end(), 0u);
    return;
  }
  SamplingRule rule;
  rule.nodePoints = static_cast<std::uint32_t>(wanted);
  SamplingDistance distance = samplingDistance(occupancy, UINT64_MAX, -1, rule);
  // That is for at most as many; a quarter of an octave less gives up to half as many again.
  distance.quarters = std::max(0, distance.quarters - 1);
  sampler_.choose(records, points, distance, chosen);
  if (chosen.size() > wanted)
  {
    thin(chosen, chosen.size() - wanted);
  }
  else if (chosen.size() < wanted)
  {
    fill(chosen, points.size(), wanted - chosen.size());
  }
}

} // namespace pointfront
