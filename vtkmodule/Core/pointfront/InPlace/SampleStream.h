#pragma once

#include <cstdint>

namespace pointfront
{

/// A subset of a file's points by random step: of every 2^logStep points that follow each other in
/// the file (a stratum) one, at a place that a fixed hash picks. Steps lie between 1 and twice the
/// mean, so there is no pattern to beat with the scan lines, as an equidistant step has.
/// Why strata  whether a point belongs to a stream follows from its number alone, in a few cycles.
///             So a leaf knows what its ancestors hold without any list of it, and no point is
///             held twice.
/// Source      Kovac 2009, section 3.1 (points are chosen with a random step).
/// Threads     pure. The numbers are part of the format of side files: never change the hash.
struct SampleStream
{
  unsigned logStep = 0; ///< 0 to 40; 0: every point

  /// Number of the point that stands for this stratum. May lie beyond the file's end in the last
  /// stratum: that one has no point then.
  std::uint64_t sample(std::uint64_t stratum) const
  {
    const std::uint64_t mask = (std::uint64_t(1) << logStep) - 1;
    return (stratum << logStep) + (mixed(stratum ^ (std::uint64_t(logStep + 1) << 56)) & mask);
  }
  bool contains(std::uint64_t point) const { return sample(point >> logStep) == point; }

  /// A fixed, well mixed function of a number (the finaliser of SplitMix64).
  static std::uint64_t mixed(std::uint64_t value)
  {
    value += 0x9e3779b97f4a7c15ull;
    value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9ull;
    value = (value ^ (value >> 27)) * 0x94d049bb133111ebull;
    return value ^ (value >> 31);
  }
};

} // namespace pointfront
