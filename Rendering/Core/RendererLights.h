#pragma once

#include "pointfront/Plan/FrameCamera.h"
#include "pointfront/Style/FrameShading.h"

#include <vector>

class vtkRenderer;

namespace pointfront
{

/// A renderer's lights as deferred lighting uses them: intensity times diffuse colour. Positional
/// lights have their place, attenuation and, below 90 degrees, their cone, as in VTK's shaders.
/// Never empty: lights that are all off are a black one.
/// `camera`  of the frame; its view space is that of the lights.
/// Threads   the renderer's, while it draws.
std::vector<FrameLight> lightsOf(vtkRenderer* renderer, const FrameCamera& camera);

} // namespace pointfront
