#pragma once

#include "PixelRectangle.h"
#include "RasterItems.h"

namespace pointfront
{

/// The part of the viewport in which the items can show anything, from the boxes of their nodes and
/// the sizes of their splats. Pixels outside stay as they are. It is the whole viewport if a node
/// comes near the eye, or if splats have any size.
/// Exactness  no splat is cut by an edge that is not the viewport's, so that pictures of that part
///            have the bits that pictures of all have.
PixelRectangle shownRectangle(const RasterItems& items);

/// With the pixels that filling holes looks at, if the plan's are filled.
PixelRectangle withHoles(const PixelRectangle& place, const FramePlan& plan);

} // namespace pointfront
