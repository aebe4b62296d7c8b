#pragma once

#include "pointfront/Plan/FramePlan.h"
#include "pointfront/Style/FrameLens.h"

namespace pointfront
{

/// False: no splat of the node reaches a pixel that the lens can cover, when it is drawn in that
/// style. What is outside of the viewport may count as inside.
bool mayReach(
  const FramePlan& plan, const PlanItem& item, const ResolvedStyle& style, const FrameLens& lens);

} // namespace pointfront
