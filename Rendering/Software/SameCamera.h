#pragma once

#include "pointfront/Plan/FrameCamera.h"

namespace pointfront
{

/// Points land on the same pixels: a picture of the one camera may be gone on with for the other.
inline bool sameCamera(const FrameCamera& a, const FrameCamera& b)
{
  return a.storeToView == b.storeToView && a.viewToClip == b.viewToClip &&
    a.reference == b.reference && a.referenceInView == b.referenceInView &&
    a.parallel == b.parallel && a.width == b.width && a.height == b.height;
}

} // namespace pointfront
