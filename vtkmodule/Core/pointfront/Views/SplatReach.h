#pragma once

#include "pointfront/Front/View.h"
#include "pointfront/Style/StyleSheet.h"

#include <vector>

namespace pointfront
{

/// The radius that no splat whose style says its size in world units exceeds; 0 if none says so.
double largestSplat(const std::vector<LayerStyling>& layers);

/// A view whose frustum also contains everything up to `radius` beside it. Nodes are chosen by the
/// places of their points, and a splat whose centre lies beside the view reaches into it.
View withSplatsFromAside(View view, double radius);

} // namespace pointfront
