#pragma once

#include "pointfront/Front/View.h"
#include "pointfront/Style/StyleSheet.h"

#include <vector>

namespace pointfront
{

/// The height that no wall below a point of the store exceeds, store units; 0 if no style has
/// walls. If the store does not know the range of its heights, it is the height of the store.
double tallestWall(const StoreDescription& store, const std::vector<LayerStyling>& layers);

/// A view whose frustum also contains everything up to `height` above it. Nodes are chosen by the
/// places of their points, and walls go down from there (LAYERS-7).
/// Exactness  conservative: of a point and all that is below it for `height`, a plane's distance is
///            the largest.
View withWallsFromAbove(View view, double height);

} // namespace pointfront
