#pragma once

#include "pointfront/Trees/Sampler.h"

#include <cstdint>
#include <vector>

namespace pointfront
{

/// Chooses exactly so many points, spread over all: a maximal Poisson-disk sample (SubsetSampler)
/// at a distance that gives a few more, thinned evenly along the Morton curve; what is missing
/// (equal points, mostly) is filled up evenly from the others. Depends on the positions and their
/// order only.
/// Threads  one instance, one thread.
class ExactSampler
{
public:
  /// `points` in Morton order, at least `wanted`; `chosen`: at which places of `points` those are,
  /// ascending. `occupancy` is that of the points.
  void choose(const RecordSpan& records, const std::vector<std::uint32_t>& points,
    const CellOccupancy& occupancy, std::uint64_t wanted, std::vector<std::uint32_t>& chosen);

private:
  SubsetSampler sampler_;
};

} // namespace pointfront
