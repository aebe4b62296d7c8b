#pragma once

#include "pointfront/Style/FrameShading.h"

#include <vector>

class vtkRenderer;

namespace pointfront
{

/// A renderer's lights as deferred lighting uses them: intensity times diffuse colour, from one
/// direction each. A positional light shines from the direction in which the camera's focal point
/// sees it, without cone and attenuation. Never empty: lights that are all off are a black one.
/// Threads  the renderer's, while it draws.
std::vector<FrameLight> lightsOf(vtkRenderer* renderer);

} // namespace pointfront
