#pragma once

#include "pointfront/Plan/FramePlan.h"
#include "pointfront/Style/FrameLens.h"

namespace pointfront
{

/// False if no splat of the node, drawn in that style, reaches a pixel that the lens can cover.
/// Splats outside of the viewport may count as inside.
bool mayReach(
  const FramePlan& plan, const PlanItem& item, const ResolvedStyle& style, const FrameLens& lens);

} // namespace pointfront
