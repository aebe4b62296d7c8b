#pragma once

#include "PixelRectangle.h"
#include "RasterItems.h"

namespace pointfront
{

/// The part of the viewport that the items can show anything in, from the boxes of their nodes and
/// how large their splats can be: all that is outside stays as it is. All of the viewport where a
/// node comes near the eye, or its splats are of any size.
/// Exactness  no splat is cut by an edge that is not the viewport's, so that pictures of that part
///            have the bits that pictures of all have.
PixelRectangle shownRectangle(const RasterItems& items);

} // namespace pointfront
