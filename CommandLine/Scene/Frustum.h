#pragma once

#include "Camera.h"

#include "pointfront/Base/Bounds.h"
#include "pointfront/Front/View.h"
#include "pointfront/Plan/FrameCamera.h"

#include <array>

namespace pointfront
{

/// Nearest and farthest depth that is drawn, so that nothing of the box in front of the eye is cut:
/// as vtkRenderer::ResetCameraClippingRange() has it, so that both back ends show the same. The
/// nearest is at least a thousandth of the farthest.
std::array<double, 2> clippingRange(const Camera& camera, const Bounds& bounds);

/// The camera of a frame that shows the box.
FrameCamera frameCameraOf(const Camera& camera, const Bounds& bounds, int width, int height);

/// The frustum as fronts need it.
View viewOf(const FrameCamera& camera);
/// The same for rows [bottom, top) of the viewport: what lies in another part of the picture is out
/// of sight. Errors in pixels are those of the whole.
View viewOfRows(const FrameCamera& camera, int bottom, int top);

} // namespace pointfront
