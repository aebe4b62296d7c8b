#pragma once

#include "pointfront/Plan/PlanParts.h"

#include <vector>

namespace pointfront
{

/// The parts of a plan that any of the processes behind `plan.exchange` has: the same list on all
/// of them, in the order of partsOf(). A part that others alone have is without batches here.
/// Exchange  a part keeps it where any process blends splats in it; elsewhere it has none.
/// Empty     if the processes do not agree in the number of lenses: none of them exchanges then.
std::vector<PlanPart> partsOfAll(const FramePlan& plan);

} // namespace pointfront
