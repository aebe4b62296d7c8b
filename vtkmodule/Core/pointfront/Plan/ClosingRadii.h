#pragma once

#include "pointfront/Plan/FramePlan.h"

#include <vector>

namespace pointfront
{

/// Makes the closing radii of a plan's items agree with each other.
/// Levels  splats of a node are as large as those of the finer nodes drawn among them are on the
///         whole: not as far-away coarse ones, nor as a few strays.
/// Layers  where another layer's nodes lie in the same place and are denser, splats are at most
///         twice as large as theirs: a few points of one class among many of another are no surface
///         of their own.
/// Time    n log n of the items; for those of layers that are sparser than most, n each.
void matchNeighbours(std::vector<DrawBatch>& batches, const QuantisationGrid& grid);

} // namespace pointfront
