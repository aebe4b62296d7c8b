#include "pointfront/Build/ExactSampler.h"

#include <algorithm>

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
} // namespace

/// Turns `count` of the flags that are `from`, one in each of as many runs of equal length.
void ExactSampler::change(std::vector<std::uint8_t>& chosen, std::uint8_t from, std::uint64_t count)
{
  ranks_.clear();
  for (std::size_t i = 0; i < chosen.size(); ++i)
  {
    if (chosen[i] == from)
    {
      ranks_.push_back(static_cast<std::uint32_t>(i));
    }
  }
  for (std::uint64_t i = 0; i < count; ++i)
  {
    const std::uint64_t begin = i * ranks_.size() / count;
    const std::uint64_t end = (i + 1) * ranks_.size() / count;
    chosen[ranks_[begin + mixed(i) % (end - begin)]] = 1 - from;
  }
}

void ExactSampler::choose(const RecordView& records, const std::vector<std::uint32_t>& points,
  const CellOccupancy& occupancy, std::uint64_t wanted, std::vector<std::uint8_t>& chosen)
{
  if (wanted == 0 || wanted >= points.size())
  {
    chosen.assign(points.size(), wanted == 0 ? 0 : 1);
    return;
  }
  SamplingRule rule;
  rule.nodePoints = static_cast<std::uint32_t>(wanted);
  SamplingDistance distance = samplingDistance(occupancy, UINT64_MAX, -1, rule);
  // That is for at most as many; a quarter of an octave less gives up to half as many again.
  distance.quarters = std::max(0, distance.quarters - 1);
  sampler_.choose(records, points, distance, chosen);
  const auto marked =
    static_cast<std::uint64_t>(std::count(chosen.begin(), chosen.end(), std::uint8_t(1)));
  if (marked > wanted)
  {
    change(chosen, 1, marked - wanted);
  }
  else if (marked < wanted)
  {
    change(chosen, 0, wanted - marked);
  }
}

} // namespace pointfront
