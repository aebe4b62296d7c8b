#pragma once

#include "pointfront/Base/Bounds.h"
#include "pointfront/Plan/FramePlan.h"
#include "pointfront/Store/Hierarchy.h"

#include <cstdint>
#include <vector>

namespace pointfront
{

/// A node of the same view that another process draws (sort-last rendering), or that is drawn when
/// the view is complete.
struct NodeElsewhere
{
  NodeIndex node = noNode;
  NodeIndex parent = noNode;
  std::uint16_t layer = 0;
  std::uint32_t points = 0; ///< that are drawn
  float closingRadius = 0.0f; ///< as PlanItem's, before it is matched
  bool unfinished = false;
  Bounds box; ///< world units
};

/// Makes the closing radii of a plan's items agree with each other, and with those of what is drawn
/// elsewhere; of a node that is in both lists the latter counts.
/// Levels  splats of a node are as large as those of the finer nodes drawn among them are on the
///         whole: not as far-away coarse ones, nor as a few strays.
/// Layers  where another layer's nodes lie in the same place and are denser, splats are at most
///         twice as large as theirs: a few points of one class among many of another are no surface
///         of their own.
/// Time    n log n of the items; for those of layers that are sparser than most, n each.
void matchNeighbours(
  std::vector<DrawBatch>& batches, const std::vector<NodeElsewhere>& elsewhere = {});

} // namespace pointfront
