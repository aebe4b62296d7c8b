#include "pointfront/Trees/PrefixOrder.h"

#include <utility>

namespace pointfront
{
namespace
{
/// Below that many points a batch is not worth a split of its own.
constexpr std::size_t smallestBatch = 4;

/// A fixed, well mixed function of a position (the finaliser of MurmurHash3).
std::uint64_t hashOf(const TreePosition& p)
{
  std::uint64_t h = (std::uint64_t(p.x) << 32 | p.y) ^ (p.z * 0x9e3779b97f4a7c15ull);
  h ^= h >> 33;
  h *= 0xff51afd7ed558ccdull;
  h ^= h >> 33;
  h *= 0xc4ceb9fe1a85ec53ull;
  h ^= h >> 33;
  return h;
}
} // namespace

std::vector<std::uint32_t> prefixOrder(
  const RecordSpan& records, const std::vector<std::uint32_t>& indices)
{
  std::vector<NumberedHash> points(indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i)
  {
    points[i] = { indices[i], static_cast<std::uint32_t>(hashOf(records.position(indices[i]))) };
  }
  return prefixBatches(std::move(points));
}

std::vector<std::uint32_t> prefixBatches(std::vector<NumberedHash> points)
{
  std::vector<std::uint32_t> ordered(points.size());
  // Numbers and hashes move together: a hash is made once, and read where it is needed.
  std::vector<NumberedHash> coarse = std::move(points);
  std::size_t end = ordered.size(); // the places before it are still free
  for (unsigned round = 0; coarse.size() > smallestBatch; ++round)
  {
    const std::size_t pairs = coarse.size() / 2;
    std::uint32_t* batch = ordered.data() + (end - pairs);
    for (std::size_t i = 0; i < pairs; ++i)
    {
      // A fresh bit of the hash each round, so that the picks of two rounds are independent.
      const std::size_t picked = (coarse[2 * i].hash >> (round & 31u)) & 1u;
      batch[i] = coarse[2 * i + (1 - picked)].index;
      coarse[i] = coarse[2 * i + picked];
    }
    if (coarse.size() % 2 == 1)
    {
      coarse[pairs] = coarse.back();
    }
    coarse.resize(coarse.size() - pairs);
    end -= pairs;
  }
  for (std::size_t i = 0; i < coarse.size(); ++i)
  {
    ordered[i] = coarse[i].index;
  }
  return ordered;
}

} // namespace pointfront
