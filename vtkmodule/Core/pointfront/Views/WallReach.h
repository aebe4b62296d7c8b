#pragma once

#include "pointfront/Front/View.h"
#include "pointfront/Style/StyleSheet.h"

#include <vector>

namespace pointfront
{

/// No wall below a point of the store is taller, store units; 0 where no style has walls. Where the
/// store does not know the range of its heights, it is as high as the store.
double tallestWall(const StoreDescription& store, const std::vector<LayerStyling>& layers);

/// A view whose frustum also has what lies up to `height` above it: nodes are chosen by where their
/// points are, and walls go down from there (LAYERS-7).
/// Exactness  conservative: of a point and all that is below it for `height`, a plane's distance is
///            the largest.
View withWallsFromAbove(View view, double height);

} // namespace pointfront
