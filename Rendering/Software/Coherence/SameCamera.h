#pragma once

#include "pointfront/Plan/FrameCamera.h"

namespace pointfront
{

/// Whether points land on the same pixels with both cameras, so that a picture of one camera can be
/// continued with the other.
inline bool sameCamera(const FrameCamera& a, const FrameCamera& b)
{
  return a.storeToView == b.storeToView && a.viewToClip == b.viewToClip &&
    a.reference == b.reference && a.referenceInView == b.referenceInView &&
    a.parallel == b.parallel && a.width == b.width && a.height == b.height &&
    a.pictureHeight == b.pictureHeight;
}

} // namespace pointfront
